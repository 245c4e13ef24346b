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

glm::dvec2 sumOfAreas(const glass::PaneMesh& mesh, size_t from, size_t to) {
  const double way_round = areas(mesh, 0).x;
  glm::dvec2 sum{0.0};
  for (size_t t = from; t < to; t += 3) {
    const glm::dvec2 piece = areas(mesh, t);
    EXPECT_GE(piece.x * way_round, -1e-9) << "turned over";
    sum += piece;
  }
  return sum;
}

// The square of texels a piece belongs to: of tiles first, then of each tile's cells.
struct Square {
  glm::ivec2 first;
  int size;
};
Square squareOf(size_t piece, glm::ivec2 tiles) {
  const auto number = static_cast<int>(piece), count = tiles.x * tiles.y;
  const auto corner = [&](int tile) { return 16 * glm::ivec2(tile % tiles.x, tile / tiles.x); };
  if (number < count) return {corner(number), 16};
  const int cell = (number - count) % 16;
  return {corner((number - count) / 16) + 4 * glm::ivec2(cell % 4, cell / 4), 4};
}

TEST(MeshCut, tilesAndCellsHoldAllOfThePaneOnceEachItsOwn) {
  constexpr glm::ivec2 kTexels{233, 121}, kTiles{15, 8};
  const Mesh bulging = windscreen(1.5, 0.8, rad(30), 0.1, 7);
  glass::PaneMesh mesh;
  mesh.indices = bulging.indices;
  for (size_t i = 0; i < bulging.positions.size(); ++i) {
    const glm::vec3& p = bulging.positions[i];
    mesh.vertices.insert(mesh.vertices.end(),
                         {p.x, p.y, p.z, 0.0f, 0.0f, 1.0f, bulging.uvs[i].x, bulging.uvs[i].y});
  }
  const glass::PieceMesh cut = glass::cutIntoPieces(mesh, kTexels);
  ASSERT_EQ(cut.first.size(), size_t{15 * 8 * 17 + 1});
  ASSERT_EQ(cut.first[15 * 8], cut.tiles);
  ASSERT_EQ(cut.first.back(), cut.mesh.indices.size());
  const glm::dvec2 whole = sumOfAreas(mesh, 0, mesh.indices.size());
  const glm::dvec2 of_tiles = sumOfAreas(cut.mesh, 0, cut.tiles) / whole;
  const glm::dvec2 of_cells = sumOfAreas(cut.mesh, cut.tiles, cut.mesh.indices.size()) / whole;
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(of_cells[k], 1.0, 1e-5);
    EXPECT_GT(of_tiles[k], 1.0 + 1e-4) << "tiles overlap by a hair";
    EXPECT_LT(of_tiles[k], 1.003);  // 0.02 of 16 texels, both ways
  }
  for (size_t piece = 0; piece + 1 < cut.first.size(); ++piece) {
    const Square square = squareOf(piece, kTiles);
    const double beyond = square.size == 16 ? 0.011 : 0.001;
    for (size_t i = cut.first[piece]; i < cut.first[piece + 1]; ++i) {
      const size_t v = 8 * cut.mesh.indices[i];
      const glm::dvec2 texel(cut.mesh.vertices[v + 6] * static_cast<float>(kTexels.x),
                             cut.mesh.vertices[v + 7] * static_cast<float>(kTexels.y));
      const glm::dvec2 first(square.first);
      EXPECT_TRUE(glm::all(glm::greaterThan(texel, first - beyond)) &&
                  glm::all(glm::lessThan(texel, first + static_cast<double>(square.size) + beyond)));
    }
  }
}

}  // namespace
}  // namespace rg::test
