// A washer's jet: where on a pane it lands, and its water coming down there.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

struct JetInfo {
  glm::dvec3 nozzle_m{0.0};             // vehicle frame
  glm::dvec3 direction{1.0, 0.0, 0.0};  // unit
  double fan_rad = 0.2;                 // whole angle of the cone that it fills evenly
};

class Jet {
 public:
  // Throws std::invalid_argument when none of it meets the pane's outer side.
  Jet(const JetInfo& info, const PaneMap& map, const std::string& pane);

  // A texel it lands on, by a number in 0 .. 1: each as often as it is seen large from the nozzle.
  int texelAt(double share) const;
  // Water that leaves the nozzle and misses the pane is not counted.
  double share() const { return share_; }

 private:
  std::vector<int> texels_;
  std::vector<double> sums_;  // of solid angles
  double share_ = 1.0;        // of the cone that the pane fills
};

}  // namespace rg::glass
