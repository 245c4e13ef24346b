// The wind near the ground: the share of the stated wind that the air has at the drops' height, and the
// larger one that drops still have from higher up.
#pragma once

#include <array>

#include "rain/hydrometeors.h"

namespace rg::rain {

// Air: U(z) = (u* / 0.4) ln(z / z0), the wind being stated at 10 m as meteorologists do (WMO-No. 8).
//
// A drop's sideways speed nears the air's by g / v_t of the difference per second (drag goes with the square
// of speed, and is g along the fall), so within v_t^2 / g of its fall: 0.1 m for flakes, 0.4 m for the
// smallest drops, 8.7 m for the largest, 49 m for a hailstone of 3 cm. Fallen through the profile from high
// up it has at z the mean of the winds above, weighted with exp(-(z' - z) g / v_t^2): (u* / 0.4) (ln(z / z0)
// + exp(x) E1(x)), x = z g / v_t^2. (Caldwell & Elliott 1971 treat the same fall.)
//
// One height stands for all of the space round the views. Left out: that drops fall a little faster through
// air that passes them, stable and unstable air, and what houses and hedges do to the wind.
struct WindProfile {
  double roughness_m = 0.0;  // z0; 0: the wind is as stated at every height
  double height_m = 1.5;     // above ground, of the drops and the glass
  double air_share = 1.0;
  std::array<double, kClasses> drop_share = allOne();

  // roughness_m is clamped to 0..1, height_m to 1..10; what is no number counts as no profile.
  static WindProfile of(double roughness_m, double height_m);

  double dropShare(double fall_speed_mps) const;

  static void visit(auto& a, auto& profile) {
    a.within(profile.roughness_m, 0.0, 1.0);
    a(profile.height_m, profile.air_share, profile.drop_share);
  }

 private:
  static std::array<double, kClasses> allOne() {
    std::array<double, kClasses> ones{};
    ones.fill(1.0);
    ones[kBouncedClass] = 0.0;  // a stone that flies knows no wind
    return ones;
  }
};

}  // namespace rg::rain
