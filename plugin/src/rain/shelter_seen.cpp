// Which volumes a view looks into, as they may keep rain out of its rays, however far off; and which are near
// an eye.
#include <algorithm>

#include "rain/shelter.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kSmallest = 0.004;  // radius / distance: smaller ones shadow a few pixels' worth (unsourced)
// What a view may turn, and go on, until its pictures are drawn.
constexpr double kTurned = 0.1, kGoneOn_m = 5.0;

bool sees(const Cone& view, const dvec3& centre_m, double radius_m, double range_m) {
  if (!view.valid) return false;
  const dvec3 to_centre = centre_m - view.eye_m;
  const double distance_m = glm::length(to_centre);
  if (distance_m > range_m + radius_m || radius_m < kSmallest * distance_m) return false;
  const double reach_m = radius_m + kTurned * distance_m + kGoneOn_m;
  return std::ranges::all_of(view.inward, [&](const dvec3& n) { return glm::dot(n, to_centre) > -reach_m; });
}

}  // namespace

void Shelter::seen(std::span<const Cone> views, double range_m, std::vector<NearVolume>& out) const {
  const auto isSeen = [&](const dvec3& centre_m, double radius_m) {
    return std::ranges::any_of(views,
                               [&](const Cone& view) { return sees(view, centre_m, radius_m, range_m); });
  };
  std::vector<uint32_t> waiting;
  if (!nodes_.empty()) waiting.push_back(0);
  while (!waiting.empty()) {
    const Node& node = nodes_[waiting.back()];
    waiting.pop_back();
    const dvec3 half = 0.5 * (node.box.high - node.box.low);
    if (!isSeen(node.box.low + half, glm::length(half))) continue;
    if (node.count == 0) {
      waiting.push_back(node.first);
      waiting.push_back(node.first + 1);
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Convex& shape = list_[i]->shape;
      if (isSeen(shape.centre, shape.radius_m))
        out.push_back({0, Pose{}, shape.planes, shape.centre, shape.radius_m});
    }
  }
  for (const auto& [id, body] : bodies_) {
    if (!body.known) continue;
    for (const uint32_t i : body.volumes) {
      const Convex& shape = list_[i]->shape;
      if (isSeen(outOfBody(body.path.pose(), shape.centre), shape.radius_m))
        out.push_back({id, body.path.pose(), shape.planes, shape.centre, shape.radius_m});
    }
  }
}

void Shelter::near(std::span<const dvec3> eyes, double radius, std::vector<NearVolume>& out) const {
  const auto closeTo = [&](auto&& gap) {
    return std::any_of(eyes.begin(), eyes.end(), [&](const dvec3& eye) { return gap(eye) <= radius; });
  };
  const auto boxCloseTo = [&](const Box& box) {
    return closeTo([&](const dvec3& eye) {
      return glm::length(glm::max(glm::max(box.low - eye, eye - box.high), dvec3(0.0)));
    });
  };
  nearStatic(0, boxCloseTo, out);
  for (const auto& [id, body] : bodies_) {
    if (!body.known) continue;
    for (const uint32_t i : body.volumes) {
      const Convex& shape = list_[i]->shape;
      const dvec3 centre = outOfBody(body.path.pose(), shape.centre);
      if (!closeTo([&](const dvec3& eye) { return glm::distance(centre, eye) - shape.radius_m; })) continue;
      out.push_back({id, body.path.pose(), shape.planes, shape.centre, shape.radius_m});
    }
  }
}

template <class F>
void Shelter::nearStatic(uint32_t node, const F& closeTo, std::vector<NearVolume>& out) const {
  if (nodes_.empty() || !closeTo(nodes_[node].box)) return;
  const auto [box, first, count] = nodes_[node];
  if (count == 0) {
    nearStatic(first, closeTo, out);
    nearStatic(first + 1, closeTo, out);
    return;
  }
  for (uint32_t i = first; i < first + count; ++i) {
    const Convex& shape = list_[i]->shape;
    if (closeTo(shape.box)) out.push_back({0, Pose{}, shape.planes, shape.centre, shape.radius_m});
  }
}

}  // namespace rg::rain
