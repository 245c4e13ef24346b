// Which volumes a view looks into: those that may keep rain out of its rays, however far off.
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

}  // namespace rg::rain
