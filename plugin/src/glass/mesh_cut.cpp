#include "glass/mesh_cut.h"

#include <algorithm>
#include <cmath>

#include "shared/glass_tile.glsl"

namespace rg::glass {
namespace {

using Polygon = std::vector<MeshVertex>;

constexpr size_t kFloats = std::tuple_size_v<MeshVertex>;

MeshVertex vertexOf(const PaneMesh& mesh, uint32_t index) {
  MeshVertex v;
  std::copy_n(mesh.vertices.begin() + static_cast<ptrdiff_t>(kFloats * index), kFloats, v.begin());
  return v;
}

Polygon triangleOf(const PaneMesh& mesh, size_t first) {
  return {vertexOf(mesh, mesh.indices[first]), vertexOf(mesh, mesh.indices[first + 1]),
          vertexOf(mesh, mesh.indices[first + 2])};
}

// As a fan.
void append(PaneMesh& mesh, const Polygon& polygon) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size() / kFloats);
  for (const MeshVertex& v : polygon) mesh.vertices.insert(mesh.vertices.end(), v.begin(), v.end());
  for (uint32_t k = 2; k < polygon.size(); ++k)
    mesh.indices.insert(mesh.indices.end(), {first, first + k - 1, first + k});
}

MeshVertex between(const MeshVertex& a, double a_inside, const MeshVertex& b, double b_inside) {
  if (b < a) return between(b, b_inside, a, a_inside);
  const auto s = static_cast<float>(a_inside / (a_inside - b_inside));
  MeshVertex cut;
  for (size_t i = 0; i < kFloats; ++i) cut[i] = a[i] + s * (b[i] - a[i]);
  return cut;
}

// In texels of the grid.
double along(const MeshVertex& v, size_t axis, glm::ivec2 texels) {
  return static_cast<double>(v[6 + axis]) * texels[static_cast<glm::length_t>(axis)];
}

// Squares of the grid, `size` texels along a side; pieces reach `beyond` over their edges.
struct Squares {
  glm::ivec2 texels;
  int size;
  double beyond;
};

struct Stretch {
  int first, last;
};
Stretch squaresOf(const Polygon& polygon, size_t axis, const Squares& squares) {
  double low = 1e30, high = -1e30;
  for (const MeshVertex& v : polygon) {
    low = std::min(low, along(v, axis, squares.texels));
    high = std::max(high, along(v, axis, squares.texels));
  }
  const int count = (squares.texels[static_cast<glm::length_t>(axis)] + squares.size - 1) / squares.size;
  const auto square = [&](double at) {
    return std::clamp(static_cast<int>(std::floor(at / squares.size)), 0, count - 1);
  };
  return {square(low), square(high)};
}

// What of it lies on a column, or a row, of squares: the first and the last go on for ever.
Polygon onSquares(const Polygon& polygon, size_t axis, int square, Stretch all, const Squares& squares) {
  const double low = square * squares.size - squares.beyond;
  const double high = (square + 1) * squares.size + squares.beyond;
  Polygon part = polygon;
  if (square > all.first)
    part = cutPolygon(part, [&](const MeshVertex& v) { return along(v, axis, squares.texels) - low; });
  if (square < all.last)
    part = cutPolygon(part, [&](const MeshVertex& v) { return high - along(v, axis, squares.texels); });
  return part;
}

// Calls `visit(square, polygon)` for each part of the mesh's triangles.
template <class Visit>
void forEachPart(const PaneMesh& mesh, const Squares& squares, const Visit& visit) {
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const Polygon triangle = triangleOf(mesh, t);
    const Stretch columns = squaresOf(triangle, 0, squares);
    for (int x = columns.first; x <= columns.last; ++x) {
      const Polygon column = onSquares(triangle, 0, x, columns, squares);
      if (column.size() < 3) continue;
      const Stretch rows = squaresOf(column, 1, squares);
      for (int y = rows.first; y <= rows.last; ++y) {
        const Polygon part = onSquares(column, 1, y, rows, squares);
        if (part.size() >= 3) visit(glm::ivec2(x, y), part);
      }
    }
  }
}

constexpr double kTileBeyond = 0.01;  // texels; more than the 1/256 of a pixel that places are rounded to

}  // namespace

Polygon cutPolygon(const Polygon& polygon, const std::function<double(const MeshVertex&)>& inside) {
  Polygon out;
  for (size_t k = 0; k < polygon.size(); ++k) {
    const MeshVertex &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double a_inside = inside(a), b_inside = inside(b);
    if (a_inside >= 0.0) out.push_back(a);
    if ((a_inside >= 0.0) != (b_inside >= 0.0)) out.push_back(between(a, a_inside, b, b_inside));
  }
  return out;
}

PieceMesh cutIntoPieces(const PaneMesh& mesh, glm::ivec2 texels) {
  const glm::ivec2 tiles = (texels + shared::kTileSize - 1) / shared::kTileSize;
  const auto tile_count = static_cast<size_t>(tiles.x) * static_cast<size_t>(tiles.y);
  const auto tileAt = [&](glm::ivec2 at) { return static_cast<size_t>(at.y * tiles.x + at.x); };
  std::vector<std::vector<Polygon>> parts(tile_count * (1 + shared::kCellsOfTile));
  forEachPart(mesh, {texels, shared::kTileSize, kTileBeyond},
              [&](glm::ivec2 tile, const Polygon& part) { parts[tileAt(tile)].push_back(part); });
  forEachPart(mesh, {texels, shared::kCellSize, 0.0}, [&](glm::ivec2 cell, const Polygon& part) {
    const glm::ivec2 within = cell % shared::kCellsAlong;
    const size_t tile = tileAt(cell / shared::kCellsAlong);
    parts[tile_count + tile * shared::kCellsOfTile +
          static_cast<size_t>(within.y * shared::kCellsAlong + within.x)]
        .push_back(part);
  });
  PieceMesh out;
  for (const std::vector<Polygon>& piece : parts) {
    out.first.push_back(static_cast<uint32_t>(out.mesh.indices.size()));
    for (const Polygon& part : piece) append(out.mesh, part);
  }
  out.first.push_back(static_cast<uint32_t>(out.mesh.indices.size()));
  out.tiles = out.first[tile_count];
  return out;
}

}  // namespace rg::glass
