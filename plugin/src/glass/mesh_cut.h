// Parts of a pane's mesh: triangles cut at planes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

using MeshVertex = std::array<float, 8>;  // as in PaneMesh

// What of a convex polygon lies where `inside` is 0 or more, which is linear over it (Sutherland & Hodgman
// 1974). Polygons that share an edge get the same vertex on it, whichever way round they run.
std::vector<MeshVertex> cutPolygon(const std::vector<MeshVertex>& polygon,
                                   const std::function<double(const MeshVertex&)>& inside);

// A mesh twice: what of it lies on each tile of the grid, then on each cell (shared/glass_tile.glsl); tiles
// row by row, and the cells of the first, of the second and so on. Cells meet; a tile reaches a hair beyond
// its edges, as its neighbour may have corners there that it has not, and no pixel is to be lost between
// them.
struct PieceMesh {
  PaneMesh mesh;
  size_t tiles = 0;             // indices of all tiles, which are the whole mesh
  std::vector<uint32_t> first;  // of each piece, its place among the indices; at last their number
};
// `mesh`: its uv from 0 to 1 over the grid.
PieceMesh cutIntoPieces(const PaneMesh& mesh, glm::ivec2 texels);

}  // namespace rg::glass
