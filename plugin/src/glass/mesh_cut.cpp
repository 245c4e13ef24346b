#include "glass/mesh_cut.h"

#include <algorithm>
#include <cmath>

#include "shared/glass_types.glsl"

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

struct Stretch {
  int first, last;  // tiles
};
Stretch tilesOf(const Polygon& polygon, size_t axis, glm::ivec2 texels) {
  double low = 1e30, high = -1e30;
  for (const MeshVertex& v : polygon) {
    low = std::min(low, along(v, axis, texels));
    high = std::max(high, along(v, axis, texels));
  }
  const int count = (texels[static_cast<glm::length_t>(axis)] + shared::kTileSize - 1) / shared::kTileSize;
  const auto tile = [count](double at) {
    return std::clamp(static_cast<int>(std::floor(at / shared::kTileSize)), 0, count - 1);
  };
  return {tile(low), tile(high)};
}

// What of it lies on a column, or a row, of tiles: the first and the last go on for ever.
Polygon onTiles(const Polygon& polygon, size_t axis, int tile, Stretch all, glm::ivec2 texels) {
  const double low = tile * shared::kTileSize, high = low + shared::kTileSize;
  Polygon part = polygon;
  if (tile > all.first)
    part = cutPolygon(part, [&](const MeshVertex& v) { return along(v, axis, texels) - low; });
  if (tile < all.last)
    part = cutPolygon(part, [&](const MeshVertex& v) { return high - along(v, axis, texels); });
  return part;
}

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

PaneMesh cutMesh(const PaneMesh& mesh, const std::function<Polygon(const Polygon&)>& cut) {
  PaneMesh out;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) append(out, cut(triangleOf(mesh, t)));
  return out;
}

TiledMesh cutIntoTiles(const PaneMesh& mesh, glm::ivec2 texels) {
  TiledMesh out;
  const int across = (texels.x + shared::kTileSize - 1) / shared::kTileSize;
  for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
    const Polygon triangle = triangleOf(mesh, t);
    const Stretch columns = tilesOf(triangle, 0, texels);
    for (int x = columns.first; x <= columns.last; ++x) {
      const Polygon column = onTiles(triangle, 0, x, columns, texels);
      if (column.size() < 3) continue;
      const Stretch rows = tilesOf(column, 1, texels);
      for (int y = rows.first; y <= rows.last; ++y) {
        const Polygon piece = onTiles(column, 1, y, rows, texels);
        if (piece.size() < 3) continue;
        append(out.mesh, piece);
        out.tiles.resize(out.mesh.vertices.size() / kFloats, static_cast<uint32_t>(y * across + x));
      }
    }
  }
  return out;
}

}  // namespace rg::glass
