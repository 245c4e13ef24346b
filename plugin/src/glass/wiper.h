// A wiper's blade over a pane: at which angle it crosses each texel, and from that what a stroke sweeps. No
// rate of ticks leaves gaps, because a texel is wiped when its angle lies in (before, now], whatever the step
// between both.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

// Where a blade crosses a place: up to twice when the blade stands far across its arm (pantographs).
struct Crossings {
  int count = 0;
  double angle_rad[2] = {0.0, 0.0};
  int segment[2] = {0, 0};  // piece of the blade, 0 .. kBladeSegments - 1, counted from the pivot's side
};

// One way of the blade, without reversal.
struct Sweep {
  double before_rad = 0.0;
  double now_rad = 0.0;
  bool covers(double angle_rad) const {
    return now_rad > before_rad ? angle_rad > before_rad && angle_rad <= now_rad
                                : angle_rad < before_rad && angle_rad >= now_rad;
  }
};

class Wiper {
 public:
  // `slot` is where its ridge's pieces begin: slot * kBladeSegments.
  Wiper(const WiperInfo& info, const PaneMap& map, int slot);

  const WiperInfo& info() const { return info_; }
  int slot() const { return slot_; }
  Crossings crossingsAt(const glm::dvec3& vehicle_m) const;

  // All (texel, piece) the blade can cross, in the order of angle. Shared with the GPU's copy of it.
  const std::shared_ptr<const std::vector<shared::SweptTexel>>& swept() const { return swept_; }
  // First and one past the last entry of swept() that a sweep crosses.
  std::pair<int, int> range(const Sweep& sweep) const;
  // A place on this texel may be crossed: drops elsewhere need no closer look.
  bool mayCross(int texel, const Sweep& sweep) const;

  // Texels next to the blade where it turns round at `extreme_rad`, ahead of it in its old direction, for
  // each piece; none: the water leaves the glass.
  std::vector<std::vector<int>> aheadOf(double extreme_rad, double direction) const;
  // The piece is not over the pane at this angle.
  bool offGlass(int segment, double angle_rad) const;

 private:
  Crossings crossings(const glm::dvec3& vehicle_m, double beyond_end_m) const;

  WiperInfo info_;
  int slot_;
  glm::dvec3 side_{0.0};
  double texel_m_;
  std::shared_ptr<const std::vector<shared::SweptTexel>> swept_;
  std::vector<double> angles_;                         // of swept_
  std::vector<std::pair<float, float>> texel_angles_;  // least and most of a texel, for mayCross
  std::vector<std::pair<double, double>> segment_angles_;
};

}  // namespace rg::glass
