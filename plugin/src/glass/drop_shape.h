// How long a drop's base is and how pointed its tail: what weight, wind and its own speed make of it.
// Whatever its outline, the base's area and the volume over it stay.
#pragma once

#include <algorithm>
#include <cmath>

#include "glass/water.h"

namespace rg::glass {

// The law of Cox and Voinov lets the angle of a line that moves at capillary number Ca differ by theta_0^3 -
// theta^3 = 9 Ca ln(drop's size / a molecule's reach); 1 mm over 10 nm. (ln unsourced: 10 to 15 are in use)
inline constexpr double kLogScales = 11.5;

// How fast a contact line of this angle moves at most, where nothing but itself drives it: as its angle goes
// to nothing (Le Grand, Daerr & Limat 2005 take the first corner from this).
inline double lineSpeed_mps(double angle_rad) {
  return kGamma_n_m / kMu_pa_s * angle_rad * angle_rad * angle_rad / (9.0 * kLogScales);
}

// Length over width of the base at rest under a force along the glass: 1 + 0.096 Bo, Bo = rho g sin a D^2 /
// gamma (ElSherbini & Jacobi 2004: measured on inclines just before drops move, up to a Bo of some 4 (range
// unsourced); here with the force in its weight's place, so that wind counts, and for weaker forces too).
inline double lengthAtRest(double force_n, double volume_m3, double base_radius_m) {
  constexpr double kMeasured = 4.0;
  const double bond = force_n / volume_m3 * 4.0 * base_radius_m * base_radius_m / kGamma_n_m;
  return 1.0 + 0.096 * std::min(bond, kMeasured);
}

// A drop that has been longer stays so as far as its contact line is pinned: at its ends, where it is R
// sqrt(length) long, tan(theta / 2) = h / that is not less than receding, at its sides not more than
// advancing.
inline double longestPinned(double height_m, double base_radius_m, double tan_half_receding,
                            double tan_half_advancing) {
  const double steep = height_m / base_radius_m;
  const double longest = std::min(steep / tan_half_receding, tan_half_advancing / steep);
  return std::max(1.0, longest * longest);
}

// Beyond the receding line's speed the tail is a corner, so oblique that its sides recede at that speed: sin
// phi = U_c / U, phi half its angle; down to 30 degrees, when pearls leave it (Podgorski, Flesselles & Limat
// 2001). Sides so oblique leave a round head and meet 1 / sin phi of its radii behind its middle: there the
// tail ends. 1: none.
inline constexpr double kPearling = 2.0;  // 1 / sin 30 degrees
inline double tailsEnd(double speed_mps, double receding_mps) {
  return std::clamp(speed_mps / receding_mps, 1.0, kPearling);
}

// Height of a cap of this volume whose base has the area of a circle of this radius and is so long: that of a
// spherical cap on a base as wide, stretched along it.
inline double capHeightFrom(double start_m, double volume_m3, double base_radius_m, double elongation) {
  return capHeightFrom(start_m, volume_m3 / elongation, base_radius_m / std::sqrt(elongation));
}
inline double capHeight(double volume_m3, double base_radius_m, double elongation) {
  return capHeightFrom(0.0, volume_m3, base_radius_m, elongation);
}

}  // namespace rg::glass
