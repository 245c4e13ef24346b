// How evenly a blade wipes: what film it leaves along its edge. A new one leaves the same everywhere; wear
// nicks the edge, and each nick draws a thin streak, at the same distance from the pivot stroke after stroke.
#pragma once

#include <cstdint>
#include <vector>

namespace rg::glass {

class Wear {
 public:
  // `worn` 0 (new) .. 1. The same seed gives the same nicks.
  Wear(double residual_film_m, double blade_m, double worn, uint32_t seed);

  // Film left at `along_m` from the blade's middle.
  double residual_m(double along_m) const;
  // What more it leaves where it runs dry and drags.
  double smear_m() const;

 private:
  struct Nick {
    double along_m, half_width_m, film_m;
  };
  double residual_film_m_, worn_;
  uint32_t seed_;
  std::vector<Nick> nicks_;
};

}  // namespace rg::glass
