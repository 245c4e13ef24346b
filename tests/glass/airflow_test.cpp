// Air over a pane: the host's field for what comes from ahead, our own for the rest.
#include "glass/airflow.h"

#include <gtest/gtest.h>

#include "scene.h"

namespace rg::test {
namespace {

using glass::Airflow, glass::AirflowField, glass::PaneNode;
using glm::dvec3;

void expectNear(const dvec3& got, const dvec3& wanted) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(got[k], wanted[k], 1e-6) << k;  // single precision
}

TEST(AirflowField, goesStraightFromSampleToSample) {
  const AirflowField field{2, 3, {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {1, 2, 0}, {0, 2, 3}, {1, 2, 3}}};
  expectNear(field.at(-1.0, 0.0), {0, 0, 0});
  expectNear(field.at(1.0, 0.0), {1, 0, 0});
  expectNear(field.at(0.0, 0.25), {0.5, 1, 0});
  expectNear(field.at(1.0, 0.75), {1, 2, 1.5});
  expectNear(field.at(7.0, 9.0), {1, 2, 3});  // past the edge as at it
  const AirflowField one{1, 1, {{0, 0, 1}}};
  expectNear(one.at(0.3, 0.6), {0, 0, 1});
}

TEST(AirflowField, servesTheAirFromAheadAlone) {
  const Mesh mesh = windscreen();
  const glass::PaneMap map(paneInfo(mesh));
  Airflow airflow;
  airflow.ahead = {1, 1, {{-0.5f, 0.25f, 0.75f}}};
  const PaneNode& node = map.nodes()[map.nodes().size() / 2];
  const dvec3 wind{0.0, 3.0, 0.0}, behind{12.0, 0.0, 0.0};
  expectNear(glass::airOverGlass(map, node, {-20.0, 0.0, 0.0}, airflow), {-10.0, 5.0, 15.0});
  expectNear(glass::airOverGlass(map, node, {-40.0, 0.0, 0.0}, airflow), {-20.0, 10.0, 30.0});
  expectNear(glass::airOverGlass(map, node, wind, airflow), glass::airOverGlass(map, node, wind));
  expectNear(glass::airOverGlass(map, node, behind, airflow), glass::airOverGlass(map, node, behind));
  expectNear(glass::airOverGlass(map, node, dvec3(-20.0, 0.0, 0.0) + wind, airflow),
             dvec3(-10.0, 5.0, 15.0) + glass::airOverGlass(map, node, wind));
}

TEST(ForceField, shearOnTheFilmGoesWithTheFrictionTold) {
  const Mesh mesh = windscreen();
  const glass::PaneMap map(paneInfo(mesh));
  const auto shearWith = [&](double friction) {
    glass::ForceField forces;
    forces.make(map, {0.0, 0.0, -9.81}, {-20.0, 0.0, 0.0});  // told of while it is used
    Airflow airflow;
    airflow.shape.drag_friction = friction;
    airflow.ahead = {1, 1, {{-0.866f, 0.0f, 0.5f}}};  // up the glass, as fast as the free air
    forces.setAirflow(airflow);
    forces.make(map, {0.0, 0.0, -9.81}, {-20.0, 0.0, 0.0});
    const shared::vec4 drive = forces.filmDrive()[map.nodes().size() / 2];
    return std::hypot(static_cast<double>(drive.z), static_cast<double>(drive.w));
  };
  EXPECT_NEAR(shearWith(0.004), 0.5 * 1.2 * 0.004 * 20.0 * 20.0, 1e-3);  // rho C_f U^2 / 2, Pa
  EXPECT_NEAR(shearWith(0.008), 2.0 * shearWith(0.004), 1e-5);
}

TEST(AirflowShape, saysHowMuchSpeedIsMissingBelowAndBehind) {
  const Mesh mesh = windscreen(1.5, 0.8, rad(30.0));
  const glass::PaneMap map(paneInfo(mesh));
  Airflow airflow;
  airflow.shape = {.stagnation = 1.0, .outward = 0.0, .lee = 0.0, .drag_friction = 0.004};
  for (const PaneNode& node : map.nodes()) {
    const double up = glm::length(glass::airOverGlass(map, node, {-30.0, 0.0, 0.0}, airflow));
    // Raked at 30 degrees: cos 30 of the wind goes along the glass; none at the lower edge, all at the upper.
    EXPECT_NEAR(up, 30.0 * std::cos(rad(30.0)) * node.height, 1e-3);
    EXPECT_NEAR(glm::length(glass::airOverGlass(map, node, {30.0, 0.0, 0.0}, airflow)), 0.0, 1e-3) << "lee";
  }
}

}  // namespace
}  // namespace rg::test
