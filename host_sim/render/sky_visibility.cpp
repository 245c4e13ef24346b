#include "render/sky_visibility.h"

#include <algorithm>
#include <cmath>

namespace host {
namespace {

constexpr int kRays = 96;
constexpr float kReach_m = 150.0F;
constexpr int kMaxCells = 64;
constexpr float kPi = 3.14159265F;

struct Box {
  glm::vec3 corner{0.0F}, x{1.0F, 0.0F, 0.0F}, y{0.0F, 1.0F, 0.0F}, size{1.0F};
  /// Whether a point is inside, or little off: walls and floor count as inside.
  bool holds(glm::vec3 p) const {
    const glm::vec3 d = p - corner;
    const glm::vec3 at{glm::dot(d, x), glm::dot(d, y), d.z};
    return glm::all(glm::greaterThan(at, glm::vec3(-0.6F))) && glm::all(glm::lessThan(at, size + 0.6F));
  }
};

/// The upright box of least floor area around the points: a tunnel does not lie along the axes.
Box uprightBox(std::span<const glm::vec3> points) {
  Box best;
  float least = 1e30F;
  for (int degree = 0; degree < 90; ++degree) {
    const float angle = static_cast<float>(degree) * kPi / 180.0F;
    Box box;
    box.x = {std::cos(angle), std::sin(angle), 0.0F};
    box.y = {-box.x.y, box.x.x, 0.0F};
    glm::vec3 min(1e30F), max(-1e30F);
    for (glm::vec3 p : points) {
      const glm::vec3 q{glm::dot(p, box.x), glm::dot(p, box.y), p.z};
      min = glm::min(min, q);
      max = glm::max(max, q);
    }
    const float area = (max.x - min.x) * (max.y - min.y);
    if (area >= least) continue;
    least = area;
    box.size = max - min;
    box.corner = box.x * min.x + box.y * min.y + glm::vec3(0.0F, 0.0F, min.z);
    best = box;
  }
  return best;
}

/// Directions evenly over the sphere (Fibonacci lattice).
glm::vec3 direction(int i) {
  const float z = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / kRays;
  const float s = std::sqrt(std::max(1.0F - z * z, 0.0F));
  const float angle = 2.3999632F * static_cast<float>(i);
  return {s * std::cos(angle), s * std::sin(angle), z};
}

/// What a surface sends on: albedo 0.12 of what falls on open ground under an overcast sky (7/9 of its
/// zenith); little inside.
constexpr float kLitOutside = 0.12F * 7.0F / 9.0F;
constexpr float kLitInside = 0.006F;

glm::vec3 cellMiddle(const SkyGrid& grid, const glm::mat4& scene_from_box, int i) {
  const glm::vec3 at(i % grid.cells.x, i / grid.cells.x % grid.cells.y, i / (grid.cells.x * grid.cells.y));
  return glm::vec3(scene_from_box * glm::vec4((at + 0.5F) / glm::vec3(grid.cells), 1.0F));
}

glm::vec4 lightAt(const RayTree& tree, glm::vec3 from, const Box& shelter) {
  glm::vec4 light(0.0F);
  for (int i = 0; i < kRays; ++i) {
    const glm::vec3 to = direction(i);
    const float distance_m = tree.nearest(from, to, kReach_m);
    float radiance = to.z > 0.0F ? (1.0F + 2.0F * to.z) / 3.0F : kLitOutside;
    if (distance_m < kReach_m) radiance = shelter.holds(from + distance_m * to) ? kLitInside : kLitOutside;
    light += glm::vec4(radiance, 3.0F * radiance * to) / static_cast<float>(kRays);
  }
  return light;
}

/// Mean light by that in the open, of what lies in the shelter.
float meanLight(const SkyGrid& grid, const glm::mat4& scene_from_box) {
  float sum = 0.0F, whole = 0.0F;
  for (std::size_t i = 0; i < grid.light.size(); ++i) {
    const float share = grid.share(cellMiddle(grid, scene_from_box, static_cast<int>(i)));
    sum += share * std::min(grid.light[i].x / kOpenSky.x, 1.0F);
    whole += share;
  }
  return whole > 0.0F ? sum / whole : 1.0F;
}

}  // namespace

float SkyGrid::share(glm::vec3 scene_m) const {
  const glm::vec3 at = glm::vec3(box_from_scene * glm::vec4(scene_m, 1.0F));
  const glm::vec3 inside = glm::clamp(glm::min(at, 1.0F - at) / border, 0.0F, 1.0F);
  return inside.x * inside.y * inside.z;
}

glm::vec4 SkyGrid::at(glm::vec3 scene_m) const {
  const glm::vec3 box = glm::vec3(box_from_scene * glm::vec4(scene_m, 1.0F));
  const glm::vec3 cell = glm::clamp(box * glm::vec3(cells) - 0.5F, glm::vec3(0.0F), glm::vec3(cells - 1));
  const glm::ivec3 low(cell);
  const glm::vec3 t = cell - glm::vec3(low);
  glm::vec4 sum(0.0F);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::ivec3 c = glm::min(low + step, cells - 1);
    const glm::vec3 w = glm::mix(1.0F - t, t, glm::vec3(step));
    sum += w.x * w.y * w.z * light[static_cast<std::size_t>((c.z * cells.y + c.y) * cells.x + c.x)];
  }
  return sum;
}

SkyGrid measureSky(const RayTree& tree, std::span<const glm::vec3> points_m, float step_m, float border_m) {
  Box box = uprightBox(points_m);
  const Box shelter = box;
  const glm::vec3 border(border_m, border_m, std::min(border_m, 0.15F * box.size.z));
  box.corner -= box.x * border.x + box.y * border.y + glm::vec3(0.0F, 0.0F, border.z);
  box.size += 2.0F * border;

  SkyGrid grid;
  grid.border = border / box.size;
  grid.cells =
      glm::clamp(glm::ivec3(glm::ceil(box.size / step_m)), glm::ivec3(2, 2, 3), glm::ivec3(kMaxCells, 24, 8));
  const glm::vec3 cell = box.size / glm::vec3(grid.cells);
  grid.probe_step_m = 0.35F * std::min({cell.x, cell.y, cell.z});
  const glm::mat4 scene_from_box(glm::vec4(box.x * box.size.x, 0.0F), glm::vec4(box.y * box.size.y, 0.0F),
                                 glm::vec4(0.0F, 0.0F, box.size.z, 0.0F), glm::vec4(box.corner, 1.0F));
  grid.box_from_scene = glm::inverse(scene_from_box);
  for (int i = 0; i < grid.cells.x * grid.cells.y * grid.cells.z; ++i)
    grid.light.push_back(lightAt(tree, cellMiddle(grid, scene_from_box, i), shelter));
  grid.lit = meanLight(grid, scene_from_box);
  return grid;
}

}  // namespace host
