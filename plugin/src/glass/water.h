// Water and what glass does to it: constants, the presets of surfaces, and the geometry of a sessile drop as
// a spherical cap.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "glass/pane.h"
#include "gravity.h"

namespace rg::glass {

inline constexpr double kGamma_n_m = 0.072;  // surface tension of water
inline constexpr double kMu_pa_s = 1.0e-3;   // viscosity
inline constexpr double kRho_kg_m3 = 1000.0;
inline constexpr double kRhoAir_kg_m3 = 1.2;
inline constexpr double kPicolitresPerM3 = 1.0e15;

// Rounded as std::llround does it, which is a call.
inline int64_t picolitres(double volume_m3) {
  const double exact = volume_m3 * kPicolitresPerM3;
  const auto whole = static_cast<int64_t>(exact);
  const double rest = exact - static_cast<double>(whole);
  return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}
inline double cubicMetres(int64_t volume_pl) { return static_cast<double>(volume_pl) / kPicolitresPerM3; }

// What a surface does to water. Contact angles as in physics.md (advancing / receding 40/10, 60/20, 110/90,
// 105/98 degrees). The film's thresholds are tuned by eye within the orders of magnitude given there: below a
// few um a film pins or breaks into drops.
struct Surface {
  double advancing_rad, receding_rad;
  double friction;    // b of the sliding law F = F0 + b w eta U; 20..200 (Li et al. 2023)
  double pin_m;       // a thinner film does not move
  double front_m;     // a thinner film does not run onto dry glass
  double rupture_m;   // a thinner film breaks up into beads ...
  double rupture_hz;  // ... so often for each texel, once in a turn to dry at most
  double wetting_m;  // a film so thick wets all glass of its tile, from half of that on a part; drops sink in
  // Film a sliding drop leaves at 0.1 m/s (by eye; a wall that is wetted wholly keeps 32 um, Landau & Levich
  // 1942: 0.94 l_c Ca^(2/3)).
  double trail_film_m;
};
Surface surfaceOf(Glass glass);

// Volume of a spherical cap with contact angle theta over a base of radius 1: V = R^3 capShape(theta).
inline double capShape(double theta_rad) {
  const double c = std::cos(theta_rad);
  const double s = std::sin(theta_rad);
  return std::numbers::pi * (1.0 - c) * (1.0 - c) * (2.0 + c) / (3.0 * s * s * s);
}

// Height of the cap of volume V over a base of radius R: the real root of h^3 + 3 R^2 h - 6 V / pi = 0, by
// Newton's steps. From wherever they start the first goes beyond the root and the others come down to it;
// near it, as of a drop that has hardly changed since, there are one or two: what a step leaves is its
// square.
inline double capHeightFrom(double start_m, double volume_m3, double base_radius_m) {
  constexpr double kClose = 1e-5;
  const double r2 = base_radius_m * base_radius_m, sixth = 6.0 / std::numbers::pi * volume_m3;
  double h = start_m;
  for (int steps = 0; steps < 60; ++steps) {
    const double next = (2.0 * h * h * h + sixth) / (3.0 * (h * h + r2)), step = next - h;
    h = next;
    if (std::abs(step) <= kClose * h) break;
  }
  return h;
}
inline double capHeight(double volume_m3, double base_radius_m) {
  return capHeightFrom(0.0, volume_m3, base_radius_m);
}

// Beads, and drops of no known history, are caps of the mean of both angles (physics.md 3).
inline double meanAngle(const Surface& surface) {
  return 0.5 * (surface.advancing_rad + surface.receding_rad);
}

// The force that holds a drop of base width w (Furmidge; k = 24 / pi^3, ElSherbini & Jacobi 2006).
inline double retention_n(double width_m, double cos_receding, double cos_advancing) {
  constexpr double kShape = 24.0 / (std::numbers::pi * std::numbers::pi * std::numbers::pi);
  return kShape * kGamma_n_m * width_m * (cos_receding - cos_advancing);
}

// Base radius R of the largest cap that an upright pane holds: rho V(R) g = retention(2 R).
inline double heldRadius_m(const Surface& surface) {
  const double hold_n_m = retention_n(2.0, std::cos(surface.receding_rad), std::cos(surface.advancing_rad));
  return std::sqrt(hold_n_m / (kRho_kg_m3 * kGravity_mps2 * capShape(meanAngle(surface))));
}

// What of a cap stands above a height: a cap of the same sphere.
inline double capVolumeAbove(double height_m, double base_radius_m, double above_m) {
  const double rest_m = height_m - above_m;
  if (rest_m <= 0.0) return 0.0;
  const double sphere_m = (base_radius_m * base_radius_m + height_m * height_m) / (2.0 * height_m);
  return std::numbers::pi * rest_m * rest_m * (3.0 * sphere_m - rest_m) / 3.0;
}

// Contact angle of a cap from its height and base: tan(theta / 2) = h / R.
inline float capAngle(float height_m, float base_radius_m) {
  return 2.0f * std::atan(height_m / base_radius_m);
}

// A cap's outline seen from the side: the segment of a circle. Of flat ones, where its formula loses digits,
// by the first two terms of its series in h / R, right to 2e-4.
inline double capOutline_m2(double height_m, double base_radius_m) {
  const double t = height_m / base_radius_m, r2 = base_radius_m * base_radius_m;
  if (t < 0.3) return r2 * t * (4.0 / 3.0 + 4.0 / 15.0 * t * t);
  const double sphere = (1.0 + t * t) / (2.0 * t);  // over R
  return r2 * (2.0 * sphere * sphere * std::atan(t) - (1.0 - t * t) / (2.0 * t));
}

// Mass of water vapour in saturated air, kg/m^3: Magnus' formula (Sonntag 1990) and the ideal gas; 0.0173 at
// 20 C.
inline double saturatedVapour_kg_m3(double temperature_c) {
  const double pressure_pa = 611.2 * std::exp(17.62 * temperature_c / (243.12 + temperature_c));
  return pressure_pa / (461.5 * (temperature_c + 273.15));
}

inline constexpr double kVapourDiffusivity_m2_s = 2.5e-5;

// Hu & Larson 2002: -dm/dt of a sessile drop in still air, kg/s; theta in rad, humidity 0..1.
inline double evaporation_kg_s(double base_radius_m, double theta_rad, double humidity,
                               double saturated_kg_m3) {
  return std::numbers::pi * base_radius_m * kVapourDiffusivity_m2_s * (1.0 - humidity) * saturated_kg_m3 *
         (0.27 * theta_rad * theta_rad + 1.30);
}

// How much faster air that moves past takes vapour up than still air: Froessling 1938, 1 + 0.276 Re^1/2
// Sc^1/3, Re of the base's diameter.
inline double ventilation(double speed_mps, double diameter_m) {
  return 1.0 + 0.276 * std::sqrt(speed_mps * diameter_m / 1.5e-5) * 0.85;
}

}  // namespace rg::glass
