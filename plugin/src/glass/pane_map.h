// Where on the pane is what: a grid of cells with positions, directions and areas in metres, made from any
// uv-mapped mesh.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "glass/pane.h"

namespace rg::glass {

// Grid metres: the chart scaled so that it has metres on the average, x along u, y along v; the local
// metric does the rest.
struct PaneGrid {
  glm::ivec2 size{0};         // texels; a rim of one texel lies off the pane
  double texel_m = 0.0;       // grid metres
  glm::dvec2 uv_origin{0.0};  // of the corner of texel (0, 0)
  glm::dvec2 metres_per_uv{1.0};
};

struct PaneTexel {
  glm::vec3 position_m{0.0f};  // vehicle frame, as the rest
  glm::vec3 normal{0.0f};      // unit, outward
  glm::vec3 along_x{0.0f};     // change of position for one grid metre
  glm::vec3 along_y{0.0f};
  float area_m2 = 0.0f;  // real; 0: off the pane
};

// A corner of tiles: directions vary little over a tile, so fields are made here and are linear between.
struct PaneNode {
  glm::dvec3 position_m{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};
  glm::dvec3 along_x{1.0, 0.0, 0.0};
  glm::dvec3 along_y{0.0, 1.0, 0.0};
  double across = 0.0;  // -1 at the pane's left .. 1 at its right, seen from inside
  double height = 0.0;  // 0 at its lower edge .. 1 at its upper
};

// What all texels of a region have in common, shown or not.
struct RegionBounds {
  glm::dvec3 normal{0.0};  // their mean one, not of unit length
  double bend = 0.0;       // none of theirs is farther from it
  double least_m2 = 0.0, most_m2 = 0.0;
};

// Vectors of the vehicle's frame as their components along the glass about a node, grid axes, in their own
// unit.
class GlassAxes {
 public:
  explicit GlassAxes(const PaneNode& node)
      : x_(node.along_x),
        y_(node.along_y),
        xx_(glm::dot(x_, x_)),
        xy_(glm::dot(x_, y_)),
        yy_(glm::dot(y_, y_)),
        det_(xx_ * yy_ - xy_ * xy_),
        length_x_(std::sqrt(xx_)),
        length_y_(std::sqrt(yy_)) {}
  glm::dvec2 along(const glm::dvec3& v) const {
    const double vx = glm::dot(v, x_), vy = glm::dot(v, y_);
    return {(vx * yy_ - vy * xy_) / det_ * length_x_, (vy * xx_ - vx * xy_) / det_ * length_y_};
  }

 private:
  glm::dvec3 x_, y_;
  double xx_, xy_, yy_, det_, length_x_, length_y_;
};

class PaneMap {
 public:
  // Throws std::invalid_argument naming the pane: uvs missing, without area or overlapping; degenerate
  // triangles; indices out of range; NaN; smaller than a texel; more than 4096 texels along a side; seams on
  // a pane that cannot be laid flat.
  explicit PaneMap(const PaneInfo& info);

  const std::vector<glm::dvec2>& chart() const { return chart_; }  // of each vertex, see chart.h
  const PaneGrid& grid() const { return grid_; }
  int texelCount() const { return grid_.size.x * grid_.size.y; }
  const PaneTexel& texel(int index) const { return texels_[static_cast<size_t>(index)]; }
  bool inside(int index) const { return inside_[static_cast<size_t>(index)] != 0; }
  double area_m2() const { return area_m2_; }
  double leastTexel_m2() const { return least_texel_m2_; }
  double mostTexel_m2() const { return most_texel_m2_; }

  // Of a window that slides some texels are behind its sill: texelAt and what is said of tiles and of
  // regions, but for their centres, leave them out. All else about a map never changes once it is made, so
  // that several threads may ask for it.
  bool shown(int index) const { return shown_[static_cast<size_t>(index)] != 0; }
  void show(std::span<const int> texels, bool shown);

  // Index of the texel at a place, or -1 where it is off the pane or not shown.
  int texelAt(glm::dvec2 grid_m) const { return texelAt(grid_m, -1); }
  // The same, of somebody who is on a texel that is shown.
  int texelAt(glm::dvec2 grid_m, int own) const {
    const glm::dvec2 texel = grid_m / grid_.texel_m;
    if (!(texel.x >= 0.0 && texel.y >= 0.0 && texel.x < grid_.size.x && texel.y < grid_.size.y)) return -1;
    const int index = static_cast<int>(texel.y) * grid_.size.x + static_cast<int>(texel.x);
    return index == own || shown(index) ? index : -1;
  }
  // The same of a column and a row of the grid.
  int texelAt(glm::ivec2 texel) const {
    const bool known = texel.x >= 0 && texel.y >= 0 && texel.x < grid_.size.x && texel.y < grid_.size.y;
    return known ? shownAt(texel.x, texel.y) : -1;
  }
  glm::dvec2 middleOf(int index) const;

  // Glass metres: right of the pane's middle seen from inside, and up. Exact on a flat pane; on a curved one
  // distances shrink towards its rim.
  glm::dvec2 gridFromGlass(glm::dvec2 glass_m) const { return middle_m_ + gridFromGlass_ * glass_m; }
  glm::dvec2 glassFromGrid(glm::dvec2 grid_m) const { return glassFromGrid_ * (grid_m - middle_m_); }
  // Vehicle position of a place on the pane; none off it.
  std::optional<glm::dvec3> vehicleFromGrid(glm::dvec2 grid_m) const;
  bool rightHanded() const { return right_handed_; }  // along x cross along y points out of the glass
  glm::dvec2 up() const { return up_; }               // unit, grid axes: from the lower to the upper edge
  const glm::dvec3& meanNormal() const { return mean_normal_; }  // unit, outward, vehicle frame
  // No normal of the glass is farther from the mean one than the angle of this sine; 2, which no stream
  // reaches: some look away.
  double mostBentSine() const { return most_bent_sine_; }
  const glm::dvec3& meanUp() const { return mean_up_; }  // unit, up along the mean glass
  // What a shift along the mean glass is in PaneNode's across and height.
  glm::dvec2 acrossAndHeight(const glm::dvec3& shift_m) const;

  // Corners of tiles, row by row.
  glm::ivec2 nodeCount() const { return nodes_across_; }
  glm::ivec2 tileCount() const { return nodes_across_ - 1; }
  const std::vector<PaneNode>& nodes() const { return nodes_; }
  // As the film asks for it: how many texels 1 m/s goes along x, y in its step; 1/area in 1/m^2; how many
  // picolitres a film of 1 m has.
  const std::vector<shared::vec4>& nodeMetric() const { return node_metric_; }
  size_t tileOf(int index) const;                                          // of a texel
  const std::vector<float>& tileArea_m2() const { return tile_area_m2_; }  // of what is shown

  // Regions for shelter, see kRegions. Middle of the whole pane's glass there; none where it has none.
  const std::optional<glm::dvec3>& regionCentre(int region) const {
    return region_centre_[static_cast<size_t>(region)];
  }
  const std::vector<int>& regionTexels(int region) const { return regions_[static_cast<size_t>(region)]; }
  const RegionBounds& regionBounds(int region) const { return region_bounds_[static_cast<size_t>(region)]; }
  // Outward area vector: the flux of a stream that meets all of it is -v . this.
  const glm::dvec3& regionArea_m2(int region) const { return region_area_[static_cast<size_t>(region)]; }
  glm::vec3 centre_m() const { return centre_m_; }
  float radius_m() const { return radius_m_; }

 private:
  void layGrid(const PaneInfo& info);
  void rasterise(const PaneInfo& info);
  void findDirections();
  void makeNodes();
  void makeRegions();
  int shownAt(int x, int y) const {
    const int index = y * grid_.size.x + x;
    return shown(index) ? index : -1;
  }
  size_t regionOf(int index) const;

  std::vector<glm::dvec2> chart_;
  PaneGrid grid_;
  std::vector<PaneTexel> texels_;
  std::vector<uint8_t> inside_;
  std::vector<uint8_t> shown_;  // by itself, as each drop on its way asks for it
  double area_m2_ = 0.0, least_texel_m2_ = 0.0, most_texel_m2_ = 0.0;
  glm::dvec2 middle_m_{0.0}, up_{0.0, 1.0};
  glm::dvec3 mean_normal_{0.0, 0.0, 1.0}, mean_up_{1.0, 0.0, 0.0};
  double most_bent_sine_ = 2.0;
  glm::dvec2 glass_extent_m_{1.0};
  glm::dmat2 gridFromGlass_{1.0}, glassFromGrid_{1.0};
  bool right_handed_ = true;
  glm::ivec2 nodes_across_{0};
  std::vector<PaneNode> nodes_;
  std::vector<shared::vec4> node_metric_;
  std::vector<float> tile_area_m2_;
  void boundRegion(size_t region);
  std::array<std::vector<int>, kRegions> regions_, all_of_region_;
  std::array<RegionBounds, kRegions> region_bounds_{};
  std::array<glm::dvec3, kRegions> region_area_{};
  std::array<std::optional<glm::dvec3>, kRegions> region_centre_;
  glm::vec3 centre_m_{0.0f};
  float radius_m_ = 0.0f;
};

// A copy of the mesh for those who draw it: floats {x, y, z, nx, ny, nz, u, v}, outward smooth normals, uv as
// of the chart.
struct PaneMesh {
  PaneMesh() = default;
  PaneMesh(const PaneInfo& info, const PaneMap& map);
  std::vector<float> vertices;
  std::vector<uint32_t> indices;
};

}  // namespace rg::glass
