// Merges a scene's primitives: those that move together, look alike and lie near each other become one draw.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace host {

struct MergedVertex {
  glm::vec3 position_m;
  std::array<std::int16_t, 4> normal;
  glm::vec2 uv;
  std::array<std::uint8_t, 4> colour;
  std::array<std::int8_t, 4> tangent;
};
static_assert(sizeof(MergedVertex) == 36);

struct MergedDraw {
  std::uint32_t first = 0, count = 0;  ///< indices
  int body = 0, material = 0, role = -1;
  unsigned part = 1;
  glm::vec3 min_m{1e30F}, max_m{-1e30F};
};

struct MergedScene {
  std::vector<int> bodies;  ///< node each body moves with, -1 for the first: it stands still
  std::vector<MergedVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<MergedDraw> draws;
};

/// `cell_m`: edge of the squares (in the file's x and z) that still parts are cut into, 0: not cut. Shelters
/// are left out.
MergedScene mergeScene(const Scene& scene, float cell_m);

/// All triangles that block light, three corners each, in the file's axes at rest: no panes, shelters,
/// blended or masked materials.
std::vector<glm::vec3> opaqueTriangles(const Scene& scene);

}  // namespace host
