// A pane's mesh cut into the tiles of its grid.
#include "glass/mesh_cut.h"

#include <gtest/gtest.h>

#include "scene.h"

namespace rg::test {
namespace {

// Twice the area, by its size in the grid's uv and in the vehicle's frame.
glm::dvec2 areas(const glass::PaneMesh& mesh, size_t first) {
  std::array<glm::dvec3, 3> p;
  std::array<glm::dvec2, 3> uv;
  for (size_t k = 0; k < 3; ++k) {
    const float* v = &mesh.vertices[8 * mesh.indices[first + k]];
    p[k] = {v[0], v[1], v[2]};
    uv[k] = {v[6], v[7]};
  }
  const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
  return {a.x * b.y - a.y * b.x, glm::length(glm::cross(p[1] - p[0], p[2] - p[0]))};
}

TEST(MeshCut, tilesHoldAllOfThePaneOnceEachItsOwn) {
  constexpr glm::ivec2 kTexels{233, 121};
  const Mesh bulging = windscreen(1.5, 0.8, rad(30), 0.1, 7);
  glass::PaneMesh mesh;
  mesh.indices = bulging.indices;
  for (size_t i = 0; i < bulging.positions.size(); ++i) {
    const glm::vec3& p = bulging.positions[i];
    mesh.vertices.insert(mesh.vertices.end(),
                         {p.x, p.y, p.z, 0.0f, 0.0f, 1.0f, bulging.uvs[i].x, bulging.uvs[i].y});
  }
  const glass::TiledMesh tiled = glass::cutIntoTiles(mesh, kTexels);
  ASSERT_EQ(tiled.tiles.size() * 8, tiled.mesh.vertices.size());
  glm::dvec2 whole{0.0}, pieces{0.0};
  for (size_t t = 0; t < mesh.indices.size(); t += 3) whole += areas(mesh, t);
  for (size_t t = 0; t < tiled.mesh.indices.size(); t += 3) {
    const glm::dvec2 piece = areas(tiled.mesh, t);
    EXPECT_GE(piece.x * whole.x, -1e-9) << "turned over";
    pieces += piece;
  }
  EXPECT_NEAR(pieces.x / whole.x, 1.0, 1e-5);
  EXPECT_NEAR(pieces.y / whole.y, 1.0, 1e-5);
  const int across = (kTexels.x + 15) / 16;
  for (size_t i = 0; i < tiled.tiles.size(); ++i) {
    const int tile = static_cast<int>(tiled.tiles[i]);
    const glm::dvec2 texel(tiled.mesh.vertices[8 * i + 6] * static_cast<float>(kTexels.x),
                           tiled.mesh.vertices[8 * i + 7] * static_cast<float>(kTexels.y));
    const glm::dvec2 first(16 * (tile % across), 16 * (tile / across));
    EXPECT_TRUE(glm::all(glm::greaterThan(texel, first - 1e-3)) &&
                glm::all(glm::lessThan(texel, first + 16.001)));
  }
}

}  // namespace
}  // namespace rg::test
