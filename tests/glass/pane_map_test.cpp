// Metres on any mesh, and what a mesh is refused for.
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "scene.h"

namespace rg::test {
namespace {

void expectRefused(const Mesh& mesh, const std::string& why) {
  try {
    const glass::PaneMap map(paneInfo(mesh));
    FAIL() << "accepted; should say: " << why;
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("'windscreen'"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
  }
}

TEST(PaneMap, areaIsTheMeshesWhateverTheUvDensity) {
  Mesh mesh = windscreen(1.5, 0.8, rad(30), 0.1, 24);
  double area = 0.0;
  for (size_t t = 0; t < mesh.indices.size(); t += 3) {
    const glm::vec3 a = mesh.positions[mesh.indices[t]], b = mesh.positions[mesh.indices[t + 1]],
                    c = mesh.positions[mesh.indices[t + 2]];
    area += 0.5 * static_cast<double>(glm::length(glm::cross(b - a, c - a)));
  }
  constexpr double kTolerance = 0.01;  // a texel at the rim is on the pane or off it
  EXPECT_NEAR(glass::PaneMap(paneInfo(mesh)).area_m2() / area, 1.0, kTolerance);
  for (glm::vec2& uv : mesh.uvs)
    uv = {0.3f * uv.x * (0.6f + 0.4f * uv.x), 7.0f - 5.0f * uv.y};  // uneven, another scale, turned over
  EXPECT_NEAR(glass::PaneMap(paneInfo(mesh)).area_m2() / area, 1.0, kTolerance);
}

TEST(PaneMap, glassMetresAreMetresRightAndUpSeenFromInside) {
  Mesh mesh = windscreen();
  for (glm::vec2& uv : mesh.uvs) uv = {4.0f - 3.0f * uv.y, 0.2f * uv.x};  // chart turned by a quarter
  const glass::PaneMap map(paneInfo(mesh));
  const auto middle = map.vehicleFromGrid(map.gridFromGlass({0.0, 0.0}));
  const auto there = map.vehicleFromGrid(map.gridFromGlass({0.3, 0.2}));
  ASSERT_TRUE(middle && there);
  const glm::dvec3 d = *there - *middle;
  constexpr double kTolerance_m = 1e-5;  // of float positions
  EXPECT_NEAR(d.y, -0.3, kTolerance_m);  // right is the vehicle's -y
  EXPECT_NEAR(d.z, 0.2 * std::sin(rad(30)), kTolerance_m);
  EXPECT_NEAR(d.x, -0.2 * std::cos(rad(30)), kTolerance_m);
  EXPECT_FALSE(map.vehicleFromGrid(map.gridFromGlass({0.76, 0.0})));
}

TEST(PaneMap, normalsPointOutOnBothHandsOfTheChart) {
  Mesh mesh = windscreen();
  const glass::PaneMap right(paneInfo(mesh));
  for (glm::vec2& uv : mesh.uvs) uv.x = -uv.x;
  const glass::PaneMap left(paneInfo(mesh));
  EXPECT_NE(right.rightHanded(), left.rightHanded());
  for (const glass::PaneMap* map : {&right, &left}) {
    const int middle = map->texelAt(map->gridFromGlass({0.0, 0.0}));
    ASSERT_GE(middle, 0);
    EXPECT_GT(map->texel(middle).normal.x, 0.4f);
    EXPECT_GT(map->texel(middle).normal.z, 0.8f);
  }
}

// A mesh's triangles each with vertices of its own, so that uvs can be cut anywhere.
Mesh inTriangles(const Mesh& mesh) {
  Mesh out;
  for (const uint32_t i : mesh.indices) {
    out.indices.push_back(static_cast<uint32_t>(out.indices.size()));
    out.positions.push_back(mesh.positions[i]);
    out.uvs.push_back(mesh.uvs[i]);
  }
  return out;
}

// Laying flat anew hides no mistake: islands that overlap are one, and so is glass that goes round a corner.
TEST(PaneMap, refusesPiecesThatOverlapOrCannotBeLaidFlat) {
  const Mesh good = inTriangles(windscreen());
  EXPECT_NO_THROW(glass::PaneMap(paneInfo(good)));
  Mesh mesh = good;
  const size_t half = mesh.uvs.size() / 2;
  for (size_t i = 0; i < half; ++i) mesh.uvs[i].y += 0.25f;  // the lower over a part of the upper
  expectRefused(mesh, "uvs overlap at");
  for (size_t i = 0; i < half; ++i) mesh.uvs[i].y -= 1.25f;  // and away from it
  EXPECT_NO_THROW(glass::PaneMap(paneInfo(mesh)));
  Mesh wound = mesh;  // about a drum, through 3/4 of a turn
  for (glm::vec3& p : wound.positions) {
    const float turn = p.y / 1.5f * static_cast<float>(rad(270));
    p = {0.3f * std::cos(turn), 0.3f * std::sin(turn), p.z};
  }
  expectRefused(wound, "too curved to be laid flat");
  for (size_t i = 0; i < half; ++i) wound.uvs[i].y += 1.0f;  // in one even piece it needs not be
  EXPECT_NO_THROW(glass::PaneMap(paneInfo(wound)));
}

TEST(PaneMap, refusesBrokenMeshesByName) {
  const Mesh good = windscreen();
  Mesh mesh = good;
  mesh.uvs.clear();
  expectRefused(mesh, "no uv");
  mesh = good;
  for (glm::vec2& uv : mesh.uvs) uv = {0.5f, 0.5f};
  expectRefused(mesh, "uvs have no area");
  mesh = good;
  mesh.positions[10] = mesh.positions[11] = mesh.positions[12];
  expectRefused(mesh, "has no area");
  mesh = good;
  mesh.indices[4] = 9999;
  expectRefused(mesh, "past its vertices");
  mesh = good;
  mesh.indices.pop_back();
  expectRefused(mesh, "whole number");
  mesh = good;
  mesh.indices.clear();
  expectRefused(mesh, "whole number");
  mesh = good;
  mesh.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  expectRefused(mesh, "not finite");
  mesh = good;
  mesh.uvs[3].y = std::numeric_limits<float>::infinity();
  expectRefused(mesh, "not finite");
  mesh = good;
  mesh.uvs[40] = mesh.uvs[41] = mesh.uvs[42];
  expectRefused(mesh, "has no area in uv");
  mesh = good;
  for (glm::vec2& uv : mesh.uvs) uv.x = std::abs(uv.x - 0.5f);  // folded in the middle
  expectRefused(mesh, "overlap");
  mesh = good;
  for (glm::vec3& p : mesh.positions) p *= 100.0f;
  expectRefused(mesh, "4096 texels");
  mesh = good;
  for (glm::vec3& p : mesh.positions) p *= 0.001f;
  expectRefused(mesh, "smaller than a texel");
}

}  // namespace
}  // namespace rg::test
