#include "glass/washer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace rg::glass {

// Fast and short, a jet goes straight.
Jet::Jet(const JetInfo& info, const PaneMap& map, const std::string& pane) {
  const double rim = std::cos(0.5 * info.fan_rad);
  double sum = 0.0;
  for (int i = 0; i < map.texelCount(); ++i) {
    if (!map.inside(i)) continue;
    const PaneTexel& texel = map.texel(i);
    const glm::dvec3 way = glm::dvec3(texel.position_m) - info.nozzle_m;
    const double way_m = glm::length(way);
    const double facing = -glm::dot(way, glm::dvec3(texel.normal)) / way_m;
    if (!(facing > 0.0) || glm::dot(way, info.direction) < rim * way_m) continue;
    sum += static_cast<double>(texel.area_m2) * facing / (way_m * way_m);
    texels_.push_back(i);
    sums_.push_back(sum);
  }
  if (texels_.empty()) throw std::invalid_argument("pane '" + pane + "': a wash meets nothing of it");
  share_ = std::min(1.0, sum / (2.0 * std::numbers::pi * (1.0 - rim)));
}

int Jet::texelAt(double share) const {
  const auto at = std::lower_bound(sums_.begin(), sums_.end() - 1, share * sums_.back());
  return texels_[static_cast<size_t>(at - sums_.begin())];
}

}  // namespace rg::glass
