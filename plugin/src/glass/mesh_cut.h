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

// The triangles of a mesh, each cut as `cut` does.
PaneMesh cutMesh(const PaneMesh& mesh,
                 const std::function<std::vector<MeshVertex>(const std::vector<MeshVertex>&)>& cut);

// A mesh in pieces, none of which lies on two tiles of the grid.
struct TiledMesh {
  PaneMesh mesh;
  std::vector<uint32_t> tiles;  // of each vertex: its piece's, row by row
};
// `mesh`: its uv from 0 to 1 over the grid.
TiledMesh cutIntoTiles(const PaneMesh& mesh, glm::ivec2 texels);

}  // namespace rg::glass
