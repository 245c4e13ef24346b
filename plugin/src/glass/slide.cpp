#include "glass/slide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace rg::glass {
namespace {

constexpr double kLeastFall = 0.1;    // a sill more nearly along the way is a mistake
constexpr double kMostThrough = 0.7;  // as is a way more nearly through the glass

// Through the edge that lies farthest along the way, upright on the glass: of the convex hull of (place
// across, way) the side that the pane's middle goes down to.
glm::dvec4 ownSill(const PaneInfo& info, const glm::dvec3& direction, const glm::dvec3& normal) {
  const glm::dvec3 across = glm::normalize(glm::cross(direction, normal));
  std::vector<glm::dvec2> places;
  for (const uint32_t i : info.indices) {
    const glm::dvec3 p(info.positions_m[i]);
    places.emplace_back(glm::dot(p, across), glm::dot(p, direction));
  }
  std::ranges::sort(
      places, [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<glm::dvec2> hull;  // from one end to the other, on the side of greater ways
  for (const glm::dvec2& p : places) {
    const auto bends = [&] {
      const glm::dvec2 a = hull.back() - hull[hull.size() - 2], b = p - hull.back();
      return a.x * b.y - a.y * b.x >= 0.0;
    };
    while (hull.size() >= 2 && bends()) hull.pop_back();
    hull.push_back(p);
  }
  const double middle = 0.5 * (places.front().x + places.back().x);
  size_t end = 1;
  while (end + 1 < hull.size() && hull[end].x < middle) ++end;
  const glm::dvec2 a = hull[end - 1], side = glm::normalize(hull[end] - a);
  const glm::dvec3 n = side.x * direction - side.y * across;
  return {n, side.x * a.y - side.y * a.x};
}

glm::dvec4 squareSill(const PaneInfo& info, const glm::dvec3& direction) {
  double farthest_m = -1e30;
  for (const uint32_t i : info.indices)
    farthest_m = std::max(farthest_m, glm::dot(glm::dvec3(info.positions_m[i]), direction));
  return {direction, farthest_m};
}

}  // namespace

Slide::Slide(const PaneInfo& info, const PaneMap& map) : given_(glm::dvec3(info.sill) != glm::dvec3(0.0)) {
  const glm::dvec3 normal = map.meanNormal();
  if (info.slide_direction != glm::dvec3(0.0))
    direction_ = info.slide_direction;
  else
    direction_ = -map.meanUp();
  if (std::abs(glm::dot(direction_, normal)) > kMostThrough)
    throw std::invalid_argument("pane '" + info.name + "': does not slide along its own surface");
  sill_ = given_ ? info.sill : ownSill(info, direction_, normal);
  fall_ = glm::dot(glm::dvec3(sill_), direction_);
  // An edge that steep is none to slide behind: a pane that comes to a point goes behind one square to its
  // way.
  if (!given_ && fall_ < kLeastFall) sill_ = squareSill(info, direction_), fall_ = 1.0;
  if (fall_ < kLeastFall)
    throw std::invalid_argument("pane '" + info.name + "': its sill does not lie across the way it slides");
}

void Slide::sort(const PaneMap& map) {
  std::vector<double> ways_m(static_cast<size_t>(map.texelCount()));
  for (int i = 0; i < map.texelCount(); ++i) {
    if (!map.inside(i)) continue;
    ways_m[static_cast<size_t>(i)] = way_m(glm::dvec3(map.texel(i).position_m));
    order_.push_back(i);
  }
  std::ranges::stable_sort(order_, {}, [&](int i) { return ways_m[static_cast<size_t>(i)]; });
  for (const int i : order_) ways_m_.push_back(ways_m[static_cast<size_t>(i)]);
}

int Slide::texel(const PaneMap& map, size_t i) {
  if (order_.empty()) sort(map);
  return order_[i];
}

size_t Slide::texels(const PaneMap& map) {
  if (order_.empty()) sort(map);
  return order_.size();
}

size_t Slide::goneAt(const PaneMap& map, double opening_m) {
  if (!hides(opening_m)) return 0;
  if (order_.empty()) sort(map);
  return static_cast<size_t>(std::ranges::lower_bound(ways_m_, opening_m) - ways_m_.begin());
}

}  // namespace rg::glass
