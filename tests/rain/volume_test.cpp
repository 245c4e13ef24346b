// Convex volumes: what is taken, and what is refused with which words.
#include "rain/volume.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene.h"

namespace rg::rain::test {
namespace {

std::vector<Plane> boxPlanes() {
  return {{{1, 0, 0}, 1}, {{-1, 0, 0}, 1}, {{0, 1, 0}, 2}, {{0, -1, 0}, 2}, {{0, 0, 1}, 3}, {{0, 0, -1}, 0}};
}
std::string refusal(const std::vector<dvec3>& vertices, const std::vector<Plane>& planes) {
  VolumeInfo info;
  info.name = "canopy";
  info.vertices = vertices;
  info.planes = planes;
  Convex out;
  return makeConvex(info, out);
}

TEST(Volume, hullOfABoxHasSixFacesHoweverManyPointsItIsGivenBy) {
  auto points = boxCorners({-1, -2, 0}, {1, 2, 3});
  for (int i = 0; i < 40; ++i)
    points.emplace_back(0.9 * std::sin(i), 1.9 * std::cos(3 * i), 1.5 + 1.4 * std::sin(7 * i));
  VolumeInfo info;
  info.vertices = points;
  Convex hull;
  ASSERT_EQ(makeConvex(info, hull), "");
  EXPECT_EQ(hull.planes.size(), 6u);
  EXPECT_NEAR(hull.radius_m, std::sqrt(1 + 4 + 2.25), 1e-9);
}

TEST(Volume, planesAndVerticesGiveTheSameBounds) {
  VolumeInfo info;
  const auto planes = boxPlanes();
  info.planes = planes;
  Convex out;
  ASSERT_EQ(makeConvex(info, out), "");
  EXPECT_NEAR(glm::distance(out.box.low, dvec3(-1, -2, 0)), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(out.box.high, dvec3(1, 2, 3)), 0.0, 1e-9);
}

// A roof given as a polygon, or as a box of no height, keeps rain off as a sheet 1 mm thick.
TEST(Volume, flatPieceIsTakenAsASheetOfAMillimetre) {
  const auto expectSheet = [](const VolumeInfo& info, const dvec3& normal, double d) {
    Convex out;
    ASSERT_EQ(makeConvex(info, out), "");
    double above = 0.0, below = 0.0;  // of the flat piece
    for (const Plane& p : out.planes) {
      if (glm::dot(p.normal, normal) > 0.999999) above = p.d - d;
      if (glm::dot(p.normal, normal) < -0.999999) below = p.d + d;
    }
    EXPECT_NEAR(above, 0.5e-3, 1e-9);
    EXPECT_NEAR(below, 0.5e-3, 1e-9);
  };
  const dvec3 normal = glm::normalize(dvec3(1, -2, 5)),
              u = glm::normalize(glm::cross(normal, dvec3(1, 0, 0))), v = glm::cross(normal, u);
  std::vector<dvec3> hexagon;
  for (int i = 0; i < 6; ++i)
    hexagon.push_back(normal * 3.0 + 4.0 * std::cos(i * 1.0472) * u + 2.0 * std::sin(i * 1.0472) * v);
  VolumeInfo info;
  info.vertices = hexagon;
  expectSheet(info, normal, 3.0);
  const std::vector<dvec3> triangle = {{0, 0, 2}, {5, 0, 2}, {0, 5, 2}};
  info.vertices = triangle;
  expectSheet(info, {0, 0, 1}, 2.0);
  VolumeInfo by_planes;
  auto planes = boxPlanes();
  planes[4].d = 1.5;
  planes[5].d = -1.5;
  by_planes.planes = planes;
  expectSheet(by_planes, {0, 0, 1}, 1.5);
}

TEST(Volume, refusesWhatIsNoVolumeAndNamesIt) {
  const auto expectRefused = [](const std::string& said, const char* because) {
    EXPECT_NE(said.find("'canopy'"), std::string::npos) << said;
    EXPECT_NE(said.find(because), std::string::npos) << said;
  };
  auto corners = boxCorners({0, 0, 0}, {1, 1, 1});
  corners[3].y = std::nan("");
  expectRefused(refusal(corners, {}), "vertex 3");
  expectRefused(refusal(boxCorners({0, 0, 1}, {1, 0, 1}), {}), "on a line");
  expectRefused(refusal({{0, 0, 0}, {1, 0, 0}}, {}), "2 vertices");
  expectRefused(refusal({}, {}), "either");
  auto open = boxPlanes();
  open.pop_back();
  expectRefused(refusal({}, open), "finite volume");
  auto inverted = boxPlanes();
  for (Plane& p : inverted) p = {-p.normal, -p.d};
  expectRefused(refusal({}, inverted), "inside out");
  auto empty = boxPlanes();
  empty[0].d = -5;
  expectRefused(refusal({}, empty), "nothing");
  auto line = boxPlanes();
  line[2].d = line[3].d = line[5].d = 0.0;
  line[4].d = 0.0;
  expectRefused(refusal({}, line), "nothing");
  auto longNormal = boxPlanes();
  longNormal[2].normal *= 2.0;
  expectRefused(refusal({}, longNormal), "unit length");
  auto infinite = boxPlanes();
  infinite[1].d = INFINITY;
  expectRefused(refusal({}, infinite), "plane 1");
}

}  // namespace
}  // namespace rg::rain::test
