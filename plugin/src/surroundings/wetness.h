// How wet open ground is: what rain brings, what runs off, and what the air takes.
#pragma once

#include <cstdint>

#include "saved/archive.h"
#include "tick.h"

namespace rg::surroundings {

// What a road holds before the rest runs off, mm (macrotexture of asphalt is 0.5 .. 1 mm deep; unsourced).
inline constexpr double kMostOnGround_mm = 1.0;

// What an open water surface gives to the air: Penman 1948, "Natural evaporation from open water, bare soil
// and grass", Proc. R. Soc. A 193: 0.35 (1 + 0.54 u) (e_s - e) mm a day, pressures in mmHg, u at 2 m in m/s.
// Saturation by Magnus' formula.
double evaporation_mm_h(double temperature_c, double humidity, double wind_mps);

// Follows the weather from tick to tick.
class Wetness {
 public:
  void tick(const Tick& tick);
  void reset() { water_mm_ = 0.0; }
  double water_mm() const { return water_mm_; }
  static void visit(auto& a, auto& wetness) { a.within(wetness.water_mm_, 0.0, kMostOnGround_mm); }

 private:
  double water_mm_ = 0.0;
};

}  // namespace rg::surroundings
