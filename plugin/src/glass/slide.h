// A window that slides: straight along its own surface, behind a sill. What has gone behind it is not rained
// on, not blown over and not seen; water it takes there the seal strips off.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

class Slide {
 public:
  // Throws std::invalid_argument naming the pane where the sill does not lie across the way.
  Slide(const PaneInfo& info, const PaneMap& map);

  const glm::dvec3& direction() const { return direction_; }  // unit, vehicle frame
  // How far the glass has to slide until a place of it (where it lies when shut) is at the sill.
  double way_m(const glm::dvec3& position_m) const {
    return (sill_.w - glm::dot(glm::dvec3(sill_), position_m)) / fall_;
  }
  // Whether an opening may put some of it behind the sill: with a sill of its own even a window that is shut.
  bool hides(double opening_m) const { return opening_m > 0.0 || given_; }

  // The half space (n, d) of n . p + d >= 0 in which the glass, lying as when shut, is seen at an opening.
  glm::dvec4 seenWhere(double opening_m) const { return {-glm::dvec3(sill_), sill_.w - fall_ * opening_m}; }

  // Texels in the order in which they go behind the sill, and how many of them have at an opening.
  int texel(const PaneMap& map, size_t i);
  size_t texels(const PaneMap& map);  // how many there are
  size_t goneAt(const PaneMap& map, double opening_m);

 private:
  void sort(const PaneMap& map);

  glm::dvec3 direction_;
  glm::dvec4 sill_;  // n, d: glass is seen where n . p <= d
  double fall_;      // n . direction
  bool given_;
  // Made when it first opens.
  std::vector<int> order_;
  std::vector<double> ways_m_;  // ascending
};

}  // namespace rg::glass
