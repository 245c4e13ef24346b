// The models that come with the project carry what the demo needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/views.h"

namespace {

host::Scene model(const char* name) {
  return host::loadScene(std::string(RG_SOURCE_DIR) + "/models/" + name);
}

glm::vec3 lowest(const std::vector<glm::vec3>& points) {
  glm::vec3 low = points.front();
  for (const glm::vec3& p : points) low = glm::min(low, p);
  return low;
}

glm::vec3 highest(const std::vector<glm::vec3>& points) {
  glm::vec3 high = points.front();
  for (const glm::vec3& p : points) high = glm::max(high, p);
  return high;
}

TEST(Models, carHasAWipedWindscreenInFrontOfItsDriver) {
  const host::Scene scene = model("car.glb");
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
  const host::CarView car = host::carView(scene);
  const auto pane =
      std::find_if(car.panes.begin(), car.panes.end(), [](const auto& p) { return p.name == "windscreen"; });
  ASSERT_NE(pane, car.panes.end());
  ASSERT_TRUE(car.eye.given);
  const glm::vec3 size_m = highest(pane->positions_m) - lowest(pane->positions_m);
  EXPECT_GT(lowest(pane->positions_m).x, car.eye.position_m.x);
  EXPECT_GT(size_m.y, 1.2F);
  for (const glm::vec3& normal : pane->normals) {
    EXPECT_GT(normal.x, 0.0F) << "the wet side looks forward and up";
    EXPECT_GT(normal.z, 0.0F);
  }
  EXPECT_GE(car.wipers.size(), 2U);
  EXPECT_EQ(car.wheels.size(), 4U);
}

TEST(Models, carsWipersTurnAboutTheGlassAndUpwards) {
  const host::CarView car = host::carView(model("car.glb"));
  for (const host::WiperView& wiper : car.wipers) {
    const glm::vec3 far = glm::angleAxis(wiper.sweep_rad / 2.0F, wiper.axis) * wiper.rest_direction;
    EXPECT_GT(far.z, wiper.rest_direction.z) << wiper.name << " goes up the glass";
    const host::PaneView& pane = car.panes.at(static_cast<std::size_t>(wiper.pane_index));
    float nearest_m = 1e9F;
    for (const glm::vec3& p : pane.positions_m)
      nearest_m = std::min(nearest_m, glm::distance(p, wiper.pivot_m));
    EXPECT_LT(nearest_m, 0.15F) << wiper.name << " is pivoted at its pane";
  }
}

TEST(Models, driversEyeIsInTheDryCabin) {
  const host::CarView car = host::carView(model("car.glb"));
  ASSERT_FALSE(car.shelters.empty());
  const glm::vec3 low = lowest(car.shelters[0].points_m);
  const glm::vec3 high = highest(car.shelters[0].points_m);
  EXPECT_TRUE(glm::all(glm::lessThan(low, car.eye.position_m)) &&
              glm::all(glm::lessThan(car.eye.position_m, high)));
}

TEST(Models, rainFallsOnTheMirrorsOutside) {
  const host::CarView car = host::carView(model("car.glb"));
  ASSERT_FALSE(car.shelters.empty());
  const float side_m = highest(car.shelters[0].points_m).y;
  EXPECT_EQ(car.mirrors.size(), 3U);
  for (const host::MirrorView& mirror : car.mirrors)
    EXPECT_EQ(mirror.wet, std::abs(mirror.centre_m.y) > side_m) << mirror.name;
}

TEST(Models, mirrorsShowTheDriverTheRoadBehind) {
  const host::CarView car = host::carView(model("car.glb"));
  ASSERT_EQ(car.mirrors.size(), 3U);
  for (const host::MirrorView& mirror : car.mirrors) {
    const glm::vec3 seen = glm::reflect(glm::normalize(mirror.centre_m - car.eye.position_m), mirror.normal);
    EXPECT_LT(seen.x, -0.98F) << mirror.name << ": straight behind to 11 degrees";
    EXPECT_LT(std::abs(seen.z), 0.1F) << mirror.name << ": the horizon is in it";
  }
}

TEST(Models, lensStandsBeforeItsCameraAndDry) {
  const host::CarView car = host::carView(model("car.glb"));
  const auto lens =
      std::find_if(car.panes.begin(), car.panes.end(), [](const auto& p) { return p.name == "lens"; });
  const auto camera =
      std::find_if(car.cameras.begin(), car.cameras.end(), [](const auto& c) { return c.name == "lens"; });
  ASSERT_TRUE(lens != car.panes.end() && camera != car.cameras.end());
  for (std::size_t i = 0; i < lens->positions_m.size(); ++i) {
    const glm::vec3 out = lens->positions_m[i] - camera->position_m;
    EXPECT_LT(glm::length(out), 0.05F);
    EXPECT_GT(glm::dot(out, lens->normals[i]), 0.0F) << "its wet side looks away from the camera";
  }
}

TEST(Models, roadLeadsThroughEachShelterThatIsDrivenThrough) {
  const host::RoadView road = host::roadView(model("road.glb"));
  ASSERT_TRUE(road.route);
  float length_m = 0.0F;
  for (std::size_t i = 1; i < road.route->points_m.size(); ++i) {
    length_m += glm::distance(road.route->points_m[i - 1], road.route->points_m[i]);
  }
  EXPECT_GE(length_m, 1500.0F);
  EXPECT_GT(road.lamps.size(), 10U);
  for (const char* name : {"bridge", "tunnel", "canopy"}) {
    const bool is_crossed =
        std::any_of(road.shelters.begin(), road.shelters.end(), [&](const host::ShelterView& shelter) {
          if (shelter.name.rfind(name, 0) != 0) return false;
          const glm::vec2 low(lowest(shelter.points_m));
          const glm::vec2 high(highest(shelter.points_m));
          return std::any_of(road.route->points_m.begin(), road.route->points_m.end(),
                             [&](const glm::vec3& p) {
                               return glm::all(glm::lessThan(low, glm::vec2(p))) &&
                                      glm::all(glm::lessThan(glm::vec2(p), high));
                             });
        });
    EXPECT_TRUE(is_crossed) << name;
  }
}

}  // namespace
