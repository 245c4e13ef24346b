#include "glass/pane_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "glass/chart.h"
#include "shared/glass_film.glsl"

namespace rg::glass {
namespace {

constexpr int kMostTexels = 4096;        // along a side
constexpr double kLeastArea_m2 = 1e-12;  // of a triangle; a smaller one is a mistake of the mesh

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool finite(const glm::vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

void checkMesh(const PaneInfo& info) {
  if (info.positions_m.size() < 3) refusePane(info, "has fewer than three vertices");
  if (info.uvs.size() != info.positions_m.size()) refusePane(info, "has no uv for each vertex");
  if (info.indices.empty() || info.indices.size() % 3 != 0)
    refusePane(info, "has no whole number of triangles");
  if (!(info.texel_m >= 0.5e-3 && info.texel_m <= 20e-3))
    refusePane(info, "texel size must lie in 0.5 .. 20 mm");
  for (const uint32_t i : info.indices) {
    if (i >= info.positions_m.size())
      refusePane(info, "index " + std::to_string(i) + " is past its vertices");
  }
  for (size_t i = 0; i < info.positions_m.size(); ++i) {
    if (!finite(info.positions_m[i]) || !finite(info.uvs[i]))
      refusePane(info, "vertex " + std::to_string(i) + " is not finite");
  }
  double uv_area = 0.0;
  const Chart given(info.uvs.begin(), info.uvs.end());
  for (size_t t = 0; t < info.indices.size() / 3; ++t)
    uv_area += std::abs(triangleOf(info, given, t).uvArea());
  if (uv_area <= 0.0) refusePane(info, "its uvs have no area");
  for (size_t t = 0; t < info.indices.size() / 3; ++t) {
    const ChartTriangle triangle = triangleOf(info, given, t);
    if (glm::length(triangle.normal_area()) < kLeastArea_m2)
      refusePane(info, "triangle " + std::to_string(t) + " has no area");
    if (std::abs(triangle.uvArea()) < 1e-12 * uv_area)
      refusePane(info, "triangle " + std::to_string(t) + " has no area in uv");
  }
}

}  // namespace

PaneMap::PaneMap(const PaneInfo& info) {
  checkMesh(info);
  chart_ = chartOf(info);
  layGrid(info);
  rasterise(info);
  findDirections();
  makeNodes();
  makeRegions();
}

// Scales the chart so that a grid metre is a metre in the mean square over the glass.
void PaneMap::layGrid(const PaneInfo& info) {
  glm::dvec2 least{1e300}, most{-1e300};
  for (const uint32_t i : info.indices) {
    least = glm::min(least, chart_[i]);
    most = glm::max(most, chart_[i]);
  }
  grid_.texel_m = info.texel_m;
  grid_.metres_per_uv = metresPerUnit(info, chart_);
  const glm::dvec2 texels = glm::ceil((most - least) * grid_.metres_per_uv / info.texel_m - 1e-6);
  if (!(texels.x <= kMostTexels && texels.y <= kMostTexels))
    refusePane(info, "needs more than 4096 texels along a side");
  grid_.size = glm::ivec2(texels) + 2;
  grid_.uv_origin = least - info.texel_m / grid_.metres_per_uv;
  middle_m_ = (0.5 * (least + most) - grid_.uv_origin) * grid_.metres_per_uv;
  texels_.resize(static_cast<size_t>(texelCount()));
}

void PaneMap::rasterise(const PaneInfo& info) {
  constexpr double kOnEdge = 1e-7;   // of a barycentric coordinate: rounding on a shared edge
  constexpr double kOverlap = 1e-3;  // clearly inside of two triangles
  std::vector<uint8_t> clear(texels_.size(), 0);
  for (size_t t = 0; t < info.indices.size() / 3; ++t) {
    ChartTriangle triangle = triangleOf(info, chart_, t);
    const auto [du, dv] = triangle.derivatives();
    for (glm::dvec2& uv : triangle.uv) uv = (uv - grid_.uv_origin) * grid_.metres_per_uv / grid_.texel_m;
    const glm::dvec3 normal_area = triangle.normal_area();
    const glm::dvec2 low = glm::min(glm::min(triangle.uv[0], triangle.uv[1]), triangle.uv[2]);
    const glm::dvec2 high = glm::max(glm::max(triangle.uv[0], triangle.uv[1]), triangle.uv[2]);
    const glm::dvec2 e = triangle.uv[1] - triangle.uv[0], f = triangle.uv[2] - triangle.uv[0];
    const double inv = 1.0 / (e.x * f.y - e.y * f.x);
    for (int y = std::max(1, static_cast<int>(low.y - 0.5));
         y <= std::min(grid_.size.y - 2, static_cast<int>(high.y)); ++y) {
      for (int x = std::max(1, static_cast<int>(low.x - 0.5));
           x <= std::min(grid_.size.x - 2, static_cast<int>(high.x)); ++x) {
        const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - triangle.uv[0];
        const double b = (d.x * f.y - d.y * f.x) * inv, c = (e.x * d.y - e.y * d.x) * inv;
        const double margin = std::min({1.0 - b - c, b, c});
        if (margin < -kOnEdge) continue;
        const size_t i = static_cast<size_t>(y * grid_.size.x + x);
        if (margin > kOverlap) {
          if (clear[i] != 0)
            refusePane(info,
                       "its uvs overlap at (" +
                           std::to_string((triangle.uv[0].x + d.x) * grid_.texel_m / grid_.metres_per_uv.x +
                                          grid_.uv_origin.x) +
                           ", " +
                           std::to_string((triangle.uv[0].y + d.y) * grid_.texel_m / grid_.metres_per_uv.y +
                                          grid_.uv_origin.y) +
                           ")");
          clear[i] = 1;
        }
        PaneTexel& texel = texels_[i];
        texel.position_m = glm::vec3(triangle.p[0] * (1.0 - b - c) + triangle.p[1] * b + triangle.p[2] * c);
        texel.normal = glm::vec3(glm::normalize(normal_area));
        texel.along_x = glm::vec3(du / grid_.metres_per_uv.x);
        texel.along_y = glm::vec3(dv / grid_.metres_per_uv.y);
        texel.area_m2 = glm::length(glm::cross(texel.along_x, texel.along_y)) *
                        static_cast<float>(grid_.texel_m * grid_.texel_m);
      }
    }
  }
  inside_.resize(texels_.size());
  for (size_t i = 0; i < texels_.size(); ++i) {
    area_m2_ += static_cast<double>(texels_[i].area_m2);
    inside_[i] = texels_[i].area_m2 > 0.0f ? 1 : 0;
  }
  if (area_m2_ <= 0.0) refusePane(info, "is smaller than a texel");
  shown_ = inside_;
}

// Right and up at the pane's middle, and from them glass metres.
void PaneMap::findDirections() {
  glm::dvec3 normal{0.0}, along_x{0.0}, along_y{0.0};
  glm::vec3 low{1e30f}, high{-1e30f};
  for (int i = 0; i < texelCount(); ++i) {
    if (!inside(i)) continue;
    const PaneTexel& t = texel(i);
    const double area = static_cast<double>(t.area_m2);
    normal += area * glm::dvec3(t.normal);
    along_x += area * glm::dvec3(t.along_x);
    along_y += area * glm::dvec3(t.along_y);
    low = glm::min(low, t.position_m);
    high = glm::max(high, t.position_m);
  }
  centre_m_ = 0.5f * (low + high);
  for (const PaneTexel& t : texels_) {
    if (t.area_m2 > 0.0f) radius_m_ = std::max(radius_m_, glm::distance(t.position_m, centre_m_));
  }
  normal = glm::normalize(normal);
  right_handed_ = glm::dot(glm::cross(along_x, along_y), normal) > 0.0;
  along_x /= area_m2_;
  along_y /= area_m2_;
  const glm::dvec3 vertical = std::abs(normal.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 up = glm::normalize(vertical - glm::dot(vertical, normal) * normal);
  const glm::dvec3 right = glm::cross(normal, up);  // seen from inside, looking out along the normal
  mean_normal_ = normal;
  double least_cosine = 1.0;
  least_texel_m2_ = 1e300;
  for (const PaneTexel& t : texels_) {
    if (t.area_m2 <= 0.0f) continue;
    const double area_m2 = static_cast<double>(t.area_m2);
    least_texel_m2_ = std::min(least_texel_m2_, area_m2);
    most_texel_m2_ = std::max(most_texel_m2_, area_m2);
    least_cosine = std::min(least_cosine, glm::dot(glm::dvec3(t.normal), normal));
  }
  // Normals are rounded to floats.
  if (least_cosine > 0.0) most_bent_sine_ = std::sqrt(1.0 - least_cosine * least_cosine) + 1e-5;
  mean_up_ = up;
  glassFromGrid_ = glm::dmat2(glm::dot(along_x, right), glm::dot(along_x, up), glm::dot(along_y, right),
                              glm::dot(along_y, up));
  gridFromGlass_ = glm::inverse(glassFromGrid_);
  up_ = glm::normalize(gridFromGlass_ * glm::dvec2(0.0, 1.0));
}

glm::dvec2 PaneMap::middleOf(int index) const {
  return (glm::dvec2(index % grid_.size.x, index / grid_.size.x) + 0.5) * grid_.texel_m;
}

std::optional<glm::dvec3> PaneMap::vehicleFromGrid(glm::dvec2 grid_m) const {
  const int index = texelAt(grid_m);
  if (index < 0) return std::nullopt;
  const glm::dvec2 d = grid_m - middleOf(index);
  const PaneTexel& t = texel(index);
  return glm::dvec3(t.position_m) + d.x * glm::dvec3(t.along_x) + d.y * glm::dvec3(t.along_y);
}

// A node takes the mean of the glass within a tile around it; one without glass takes that of the nearest
// nodes that have some.
void PaneMap::makeNodes() {
  constexpr int kTile = shared::kTileSize;
  nodes_across_ = (grid_.size + (kTile - 1)) / kTile + 1;
  const auto count = static_cast<size_t>(nodes_across_.x * nodes_across_.y);
  nodes_.assign(count, {});
  std::vector<double> weight(count, 0.0);
  tile_area_m2_.assign(static_cast<size_t>(tileCount().x * tileCount().y), 0.0f);
  std::vector<PaneNode> sums(
      count, PaneNode{glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0), 0.0, 0.0});
  glm::dvec2 glass_low{1e30}, glass_high{-1e30};
  for (int i = 0; i < texelCount(); ++i) {
    if (!inside(i)) continue;
    const PaneTexel& t = texel(i);
    const int x = i % grid_.size.x, y = i / grid_.size.x;
    const size_t n = static_cast<size_t>((y + kTile / 2) / kTile * nodes_across_.x + (x + kTile / 2) / kTile);
    tile_area_m2_[static_cast<size_t>(y / kTile * tileCount().x + x / kTile)] += t.area_m2;
    sums[n].position_m += glm::dvec3(t.position_m);
    sums[n].normal += glm::dvec3(t.normal);
    sums[n].along_x += glm::dvec3(t.along_x);
    sums[n].along_y += glm::dvec3(t.along_y);
    weight[n] += 1.0;
    const glm::dvec2 glass = glassFromGrid(middleOf(i));
    glass_low = glm::min(glass_low, glass);
    glass_high = glm::max(glass_high, glass);
  }
  glass_extent_m_ = glass_high - glass_low + 1e-9;
  for (bool missing = true; missing;) {
    missing = false;
    const std::vector<double> known = weight;
    for (int y = 0; y < nodes_across_.y; ++y) {
      for (int x = 0; x < nodes_across_.x; ++x) {
        const size_t n = static_cast<size_t>(y * nodes_across_.x + x);
        if (known[n] > 0.0) continue;
        missing = true;
        for (const glm::ivec2 d :
             {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
          const glm::ivec2 q = glm::ivec2(x, y) + d;
          if (q.x < 0 || q.y < 0 || q.x >= nodes_across_.x || q.y >= nodes_across_.y) continue;
          const size_t m = static_cast<size_t>(q.y * nodes_across_.x + q.x);
          if (known[m] <= 0.0) continue;
          sums[n].position_m += sums[m].position_m / known[m];
          sums[n].normal += sums[m].normal / known[m];
          sums[n].along_x += sums[m].along_x / known[m];
          sums[n].along_y += sums[m].along_y / known[m];
          weight[n] += 1.0;
        }
      }
    }
  }
  for (size_t n = 0; n < count; ++n) {
    PaneNode& node = nodes_[n];
    node.position_m = sums[n].position_m / weight[n];
    node.normal = glm::normalize(sums[n].normal);
    node.along_x = sums[n].along_x / weight[n];
    node.along_y = sums[n].along_y / weight[n];
    const glm::dvec2 place =
        glm::dvec2(static_cast<int>(n) % nodes_across_.x, static_cast<int>(n) / nodes_across_.x) *
        (kTile * grid_.texel_m);
    // Written so that left and right are alike to the last bit.
    const glm::dvec2 glass = glassFromGrid(place);
    node.across = std::clamp((2.0 * glass.x - (glass_low.x + glass_high.x)) / glass_extent_m_.x, -1.0, 1.0);
    node.height = std::clamp((glass.y - glass_low.y) / glass_extent_m_.y, 0.0, 1.0);
    const double area = glm::length(glm::cross(node.along_x, node.along_y)) * grid_.texel_m * grid_.texel_m;
    const double step_s = static_cast<double>(shared::kFilmStep_s);
    node_metric_.emplace_back(static_cast<float>(step_s / (glm::length(node.along_x) * grid_.texel_m)),
                              static_cast<float>(step_s / (glm::length(node.along_y) * grid_.texel_m)),
                              static_cast<float>(1.0 / area),
                              static_cast<float>(area / static_cast<double>(shared::kPicolitre_m3)));
  }
}

glm::dvec2 PaneMap::acrossAndHeight(const glm::dvec3& shift_m) const {
  const glm::dvec3 right = glm::cross(mean_normal_, mean_up_);
  return glm::dvec2(2.0 * glm::dot(shift_m, right), glm::dot(shift_m, mean_up_)) / glass_extent_m_;
}

size_t PaneMap::regionOf(int index) const {
  const int x = (index % grid_.size.x) * kRegionsAcross / grid_.size.x,
            y = (index / grid_.size.x) * kRegionsAcross / grid_.size.y;
  return static_cast<size_t>(y * kRegionsAcross + x);
}

void PaneMap::makeRegions() {
  for (int i = 0; i < texelCount(); ++i) {
    if (!inside(i)) continue;
    const size_t r = regionOf(i);
    regions_[r].push_back(i);
    region_area_[r] += static_cast<double>(texel(i).area_m2) * glm::dvec3(texel(i).normal);
  }
  all_of_region_ = regions_;
  for (size_t r = 0; r < regions_.size(); ++r) {
    glm::dvec3 sum{0.0};
    for (const int i : regions_[r]) sum += glm::dvec3(texel(i).position_m);
    if (regions_[r].empty()) continue;
    region_centre_[r] = sum / static_cast<double>(regions_[r].size());
    boundRegion(r);
  }
}

void PaneMap::boundRegion(size_t region) {
  RegionBounds& bounds = region_bounds_[region];
  for (const int i : regions_[region])
    bounds.normal += glm::dvec3(texel(i).normal) / static_cast<double>(regions_[region].size());
  bounds.least_m2 = 1e300;
  for (const int i : regions_[region]) {
    const double area_m2 = static_cast<double>(texel(i).area_m2);
    bounds.bend = std::max(bounds.bend, glm::distance(glm::dvec3(texel(i).normal), bounds.normal));
    bounds.least_m2 = std::min(bounds.least_m2, area_m2);
    bounds.most_m2 = std::max(bounds.most_m2, area_m2);
  }
}

size_t PaneMap::tileOf(int index) const {
  const int x = index % grid_.size.x / shared::kTileSize, y = index / grid_.size.x / shared::kTileSize;
  return static_cast<size_t>(y * tileCount().x + x);
}

// Regions and tiles are summed afresh, so that what they are depends on what is shown alone.
void PaneMap::show(std::span<const int> texels, bool shown) {
  std::array<bool, kRegions> touched{};
  std::vector<bool> touched_tiles(tile_area_m2_.size(), false);
  for (const int i : texels) {
    shown_[static_cast<size_t>(i)] = shown ? 1 : 0;
    touched[regionOf(i)] = true;
    touched_tiles[tileOf(i)] = true;
  }
  for (size_t t = 0; t < tile_area_m2_.size(); ++t) {
    if (touched_tiles[t]) tile_area_m2_[t] = 0.0f;
  }
  for (int i = 0; i < texelCount(); ++i) {
    const size_t t = tileOf(i);
    if (touched_tiles[t] && this->shown(i)) tile_area_m2_[t] += texel(i).area_m2;
  }
  for (size_t r = 0; r < regions_.size(); ++r) {
    if (!touched[r]) continue;
    regions_[r].clear();
    region_area_[r] = glm::dvec3(0.0);
    for (const int i : all_of_region_[r]) {
      if (!this->shown(i)) continue;
      regions_[r].push_back(i);
      region_area_[r] += static_cast<double>(texel(i).area_m2) * glm::dvec3(texel(i).normal);
    }
  }
}

// Vertices at one place share their normal, though they may have been split for uv or shading.
PaneMesh::PaneMesh(const PaneInfo& info, const PaneMap& map)
    : indices(info.indices.begin(), info.indices.end()) {
  const auto less = [](const glm::vec3& a, const glm::vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::map<glm::vec3, glm::dvec3, decltype(less)> normals(less);
  for (size_t t = 0; t < indices.size() / 3; ++t) {
    const glm::dvec3 area = triangleOf(info, map.chart(), t).normal_area();
    for (size_t k = 0; k < 3; ++k)
      normals.try_emplace(info.positions_m[indices[3 * t + k]], 0.0).first->second += area;
  }
  for (size_t i = 0; i < info.positions_m.size(); ++i) {
    const glm::vec3& p = info.positions_m[i];
    const auto found = normals.find(p);
    const glm::vec3 n =
        found == normals.end() ? glm::vec3(0.0f, 0.0f, 1.0f) : glm::vec3(glm::normalize(found->second));
    const glm::vec2 uv(map.chart()[i]);
    vertices.insert(vertices.end(), {p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y});
  }
}

}  // namespace rg::glass
