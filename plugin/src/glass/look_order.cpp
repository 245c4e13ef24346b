#include "glass/look_order.h"

#include <algorithm>
#include <cmath>

namespace rg::glass {
namespace {

// Half the angle a sphere is seen under; all around for an eye within it.
double halfAngle(const SeenPane& seen) {
  return seen.distance_m > seen.radius_m ? std::asin(seen.radius_m / seen.distance_m) : 3.141592653589793;
}

// Against the planes at the picture's four sides: w + x >= 0, w - x >= 0 and so on (Gribb & Hartmann, 2001).
bool meetsFrustum(const glm::dvec3& centre_eye_m, double radius_m, const glm::dmat4& clipFromEye) {
  const glm::dmat4 rows = glm::transpose(clipFromEye);
  for (int side = 0; side < 4; ++side) {
    const glm::dvec4 plane = rows[3] + (side % 2 == 0 ? 1.0 : -1.0) * rows[side / 2];
    const glm::dvec3 normal(plane);
    if (glm::dot(normal, centre_eye_m) + plane.w < -radius_m * glm::length(normal)) return false;
  }
  return true;
}

}  // namespace

std::vector<SeenPane> seenPanes(std::span<const LookPane> panes, const LookView& view) {
  std::vector<SeenPane> seen;
  for (const LookPane& pane : panes) {
    const glm::dvec3 centre(view.eyeFromWorld * pane.worldFromVehicle * glm::dvec4(pane.centre_m, 1.0));
    const double radius_m = static_cast<double>(pane.radius_m);
    if (!meetsFrustum(centre, radius_m, view.clipFromEye)) continue;
    const double distance_m = std::max(glm::length(centre), 1e-9);
    seen.push_back({&pane, centre / distance_m, distance_m, radius_m});
  }
  std::stable_sort(seen.begin(), seen.end(),
                   [](const SeenPane& a, const SeenPane& b) { return a.distance_m > b.distance_m; });
  return seen;
}

bool liesBehind(const SeenPane& far, const SeenPane& near) {
  if (far.distance_m - far.radius_m < near.distance_m + near.radius_m) return false;
  const double apart = std::acos(std::clamp(glm::dot(far.direction, near.direction), -1.0, 1.0));
  return apart < halfAngle(far) + halfAngle(near);
}

}  // namespace rg::glass
