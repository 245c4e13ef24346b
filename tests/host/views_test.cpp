// Axes and meanings: a car in its vehicle frame, a road in the world's.
#include "scene/views.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gltf_files.h"
#include "loaded.h"

namespace {

using files::expectNear;
using files::kRounding;
using files::load;
using files::TempFolder;

host::CarView car() { return host::carView(load(files::wholeCar())); }

TEST(Views, framesAreRightHandedTurns) {
  expectNear(glm::vec3(host::vehicleFromGltf() * glm::vec4(1, 2, 3, 1)), {3, 1, 2});
  expectNear(glm::vec3(host::worldFromGltf() * glm::vec4(1, 2, 3, 1)), {1, -3, 2});
  EXPECT_FLOAT_EQ(glm::determinant(host::vehicleFromGltf()), 1.0F);
  EXPECT_FLOAT_EQ(glm::determinant(host::worldFromGltf()), 1.0F);
}

TEST(CarView, paneStandsUprightAndFacesForward) {
  const host::CarView view = car();
  ASSERT_EQ(view.panes.size(), 1U);
  const host::PaneView& pane = view.panes[0];
  EXPECT_EQ(pane.name, "windscreen");
  EXPECT_EQ(pane.glass, host::GlassSurface::Dirty);
  ASSERT_EQ(pane.indices.size(), 6U);
  for (const glm::vec3& p : pane.positions_m) EXPECT_NEAR(p.x, 2.0F, kRounding);
  for (const glm::vec3& n : pane.normals) expectNear(n, {1, 0, 0});
  // The first corner: glTF (-0.75, -0.4, 0) above (0, 1, 2).
  expectNear(pane.positions_m[0], {2.0F, -0.75F, 0.6F});
  const glm::vec3 face = glm::cross(pane.positions_m[pane.indices[1]] - pane.positions_m[pane.indices[0]],
                                    pane.positions_m[pane.indices[2]] - pane.positions_m[pane.indices[0]]);
  EXPECT_GT(face.x, 0.0F);
}

TEST(CarView, mirroredPaneStillFacesAsItsNormals) {
  files::Gltf g = files::wholeCar();
  g.json["nodes"][3]["scale"] = {-1, 1, 1};
  const host::PaneView pane = host::carView(load(g)).panes.at(0);
  const glm::vec3 face = glm::cross(pane.positions_m[pane.indices[1]] - pane.positions_m[pane.indices[0]],
                                    pane.positions_m[pane.indices[2]] - pane.positions_m[pane.indices[0]]);
  EXPECT_GT(glm::dot(face, pane.normals[0]), 0.0F);
}

TEST(CarView, shelterHasEachCornerOnce) {
  const host::CarView view = car();
  ASSERT_EQ(view.shelters.size(), 1U);
  EXPECT_EQ(view.shelters[0].name, "cabin");
  ASSERT_EQ(view.shelters[0].points_m.size(), 8U);
  for (const glm::vec3& p : view.shelters[0].points_m) {
    EXPECT_NEAR(std::abs(p.x - 2.0F), 1.0F, kRounding);
    EXPECT_NEAR(std::abs(p.y), 1.0F, kRounding);
    EXPECT_NEAR(std::abs(p.z - 1.0F), 0.5F, kRounding);
  }
}

TEST(CarView, wiperLiesOnItsPane) {
  const host::CarView view = car();
  ASSERT_EQ(view.wipers.size(), 1U);
  const host::WiperView& wiper = view.wipers[0];
  EXPECT_EQ(wiper.name, "left");
  EXPECT_EQ(wiper.pane_index, 0);
  expectNear(wiper.pivot_m, {2.0F, 0.5F, 1.0F});
  expectNear(wiper.axis, {1, 0, 0});            // the node's +y: out of the glass, forward
  expectNear(wiper.rest_direction, {0, 1, 0});  // the node's +x: to the left
  EXPECT_FLOAT_EQ(wiper.arm_m, 0.5F);
  EXPECT_FLOAT_EQ(wiper.blade_m, 0.6F);
  EXPECT_NEAR(wiper.blade_angle_rad, 1.5707963F, kRounding);
  EXPECT_NEAR(wiper.sweep_rad, -1.7453293F, kRounding);
}

TEST(CarView, turnedWiperNodeCarriesItsBladeAlongTheSweep) {
  const host::Scene scene = load(files::wholeCar());
  const host::WiperView wiper = host::carView(scene).wipers.at(0);
  for (const float angle_rad : {0.0F, 0.4F, -1.2F}) {
    std::vector<host::Pose> poses = scene.restPoses();
    host::turnNode(scene, wiper.node, {0.0F, 1.0F, 0.0F}, angle_rad, poses);
    const auto blade = static_cast<std::size_t>(scene.findNode("blade"));
    const glm::vec3 drawn_m((host::vehicleFromGltf() * scene.sceneFromNode(poses)[blade])[3]);
    const glm::vec3 arm = glm::angleAxis(angle_rad, wiper.axis) * wiper.rest_direction;
    expectNear(drawn_m, wiper.pivot_m + wiper.arm_m * arm);
  }
}

TEST(CarView, eyeLampsWheelsAndMirrorAreInTheVehicleFrame) {
  const host::CarView view = car();
  EXPECT_TRUE(view.eye.given);
  expectNear(view.eye.position_m, {1.0F, 0.4F, 1.2F});
  EXPECT_NEAR(view.eye.pitch_rad, -0.05235988F, kRounding);
  EXPECT_NEAR(view.eye.fov_rad, 1.2217305F, kRounding);
  ASSERT_EQ(view.lamps.size(), 2U);
  EXPECT_EQ(view.lamps[0].role, host::LightRole::Head);
  EXPECT_EQ(view.lamps[0].light, 0);
  expectNear(view.lamps[0].direction, {1, 0, 0});  // turned half round y: -z becomes +z, the front
  EXPECT_EQ(view.lamps[1].role, host::LightRole::Brake);
  EXPECT_EQ(view.lamps[1].light, -1);
  expectNear(view.lamps[1].position_m, {-1, 0, 1});
  ASSERT_EQ(view.wheels.size(), 1U);
  EXPECT_TRUE(view.wheels[0].steers);
  expectNear(view.wheels[0].hub_m, {2.5F, 0.8F, 0.3F});
  expectNear(view.wheels[0].axle, {0, 1, 0});
  ASSERT_TRUE(view.steering_wheel);
  expectNear(view.steering_wheel->axis, {-1, 0, 0});
  EXPECT_FLOAT_EQ(view.steering_wheel->ratio, 14.0F);
  ASSERT_EQ(view.mirrors.size(), 1U);
  expectNear(view.mirrors[0].normal, {-1, 0, 0});  // turned half round: looks back
  expectNear(view.mirrors[0].centre_m, {0, 0, 2});
  EXPECT_FALSE(view.mirrors[0].wet);
  const host::PaneView& face = view.mirrors[0].face;
  EXPECT_EQ(face.uv.size(), face.positions_m.size());
  ASSERT_GE(face.indices.size(), 3U);
  const auto p = [&](std::size_t k) { return face.positions_m[face.indices[k]]; };
  expectNear(glm::normalize(glm::cross(p(1) - p(0), p(2) - p(0))), view.mirrors[0].normal);
}

TEST(CarView, camerasOfTheCarsOwnAreInTheVehicleFrame) {
  files::Gltf g = files::wholeCar();
  g.json["nodes"][5]["extras"]["rainglass"] = {{"type", "camera"}, {"name", "lens"}, {"yaw_deg", 90},
                                               {"pitch_deg", -9},  {"fov_deg", 100}, {"inside", true}};
  const host::CarView view = host::carView(load(g));
  EXPECT_FALSE(view.eye.given);
  ASSERT_EQ(view.cameras.size(), 1U);
  EXPECT_EQ(view.cameras[0].name, "lens");
  expectNear(view.cameras[0].position_m, {1.0F, 0.4F, 1.2F});
  EXPECT_NEAR(view.cameras[0].yaw_rad, 1.5707963F, kRounding);
  EXPECT_NEAR(view.cameras[0].pitch_rad, -0.15707963F, kRounding);
  EXPECT_NEAR(view.cameras[0].fov_rad, 1.7453293F, kRounding);
  EXPECT_TRUE(view.cameras[0].inside);
}

TEST(CarView, needlesAndDigitsTellWhatTheyShow) {
  files::Gltf g = files::wholeCar();
  g.json["nodes"][5]["extras"]["rainglass"] = {
      {"type", "needle"}, {"shows", "engine_rpm"}, {"full", 8000}, {"sweep_deg", -180}};
  g.json["nodes"][9]["extras"]["rainglass"] = {{"type", "digit"}, {"shows", "speed_kmh"}, {"place", 2}};
  const host::CarView view = host::carView(load(g));
  ASSERT_EQ(view.needles.size(), 1U);
  EXPECT_EQ(view.needles[0].node, 5);
  EXPECT_EQ(view.needles[0].scale.shows, host::Reading::Engine_rpm);
  EXPECT_FLOAT_EQ(view.needles[0].scale.full, 8000.0F);
  EXPECT_NEAR(view.needles[0].scale.sweep_rad, -3.1415927F, kRounding);
  ASSERT_EQ(view.digits.size(), 1U);
  EXPECT_EQ(view.digits[0].node, 9);
  EXPECT_EQ(view.digits[0].drum.shows, host::Reading::Speed_kmh);
  EXPECT_EQ(view.digits[0].drum.place, 2);
}

TEST(CarView, carWithoutExtrasHasADefaultEyeAndNoGlass) {
  files::Gltf g = files::wholeCar();
  for (auto& node : g.json["nodes"]) node.erase("extras");
  const host::CarView view = host::carView(load(g));
  EXPECT_TRUE(view.panes.empty() && view.wipers.empty() && view.shelters.empty() && view.lamps.empty());
  EXPECT_FALSE(view.eye.given);
  expectNear(view.eye.position_m, {0.0F, 0.0F, 1.2F});
}

TEST(RoadView, routeAndSheltersAreInTheWorldFrame) {
  const host::RoadView view = host::roadView(load(files::wholeCar()));
  ASSERT_TRUE(view.route);
  EXPECT_TRUE(view.route->closed);
  ASSERT_EQ(view.route->points_m.size(), 3U);
  expectNear(view.route->points_m[1], {10, 0, 1});
  expectNear(view.route->points_m[2], {20, 5, 0});
  ASSERT_EQ(view.shelters.size(), 1U);
  EXPECT_NEAR(view.shelters[0].points_m.front().z, 0.5F, kRounding);
}

}  // namespace
