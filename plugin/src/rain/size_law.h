// From mm/h to drops: how many of which size are in the air, and how fast they fall.
#pragma once

#include <array>
#include <cstdint>

namespace rg::rain {

inline constexpr uint32_t kSpeedClasses = 32;
inline constexpr double kSmallest_mm =
    0.5;  // of the drops that are counted (physics of rain, normative table)
inline constexpr double kLargest_mm = 6.0;
inline constexpr double kMaxRate_mm_h = 300.0;

// Terminal speed, m/s, for D in mm. Atlas, Srivastava & Sekhon (1973): v = 9.65 - 10.3 exp(-0.6 D); within 2
// % of Gunn & Kinzer for 0.5..5.8.
double fallSpeed(double diameter_mm);
// The diameter that falls at `speed_mps`: the inverse of fallSpeed.
double diameterOfSpeed(double speed_mps);

// A class of drops that fall alike: equal steps of speed, so that no drop is more than 0.12 m/s off.
struct SpeedClass {
  double from_mm = 0.0;
  double to_mm = 0.0;
  double speed_mps = 0.0;
};
const std::array<SpeedClass, kSpeedClasses>& speedClasses();

// Marshall & Palmer (1948): N(D) = N0 exp(-L D) per m3 per mm, L = 4.1 R^-0.21 per mm, for D of 0.5..6 mm,
// with N0 such that the water delivered is exactly R (unscaled, N0 = 8000 delivers 2..16 % too much).
struct SizeLaw {
  double rate_mm_h = 0.0;
  double slope_per_mm = 0.0;  // L
  double n0_per_m3_mm = 0.0;  // scaled N0

  // rate_mm_h is clamped to 0..300; NaN counts as 0. No rain: n0 = 0.
  static SizeLaw of(double rate_mm_h);

  double numberDensity(double from_mm, double to_mm) const;  // drops/m3
  double flux(double from_mm, double to_mm) const;           // drops/(m2 s) through level ground
  double water_g_m3() const;
  double delivered_mm_h() const;
  double cover_per_m() const;  // of a view by the drops' disks, per metre of way: pi/4 times the sum of D^2
  double meanSpeedSeen_mps() const;  // fall speed, weighted with the drops' disks
  double meanDiameter_mm() const;    // of the drops in the air
  double meanDiameterReachingGround_mm() const;

  // The diameter below which the share u (0..1) of the drops between the two sizes lies.
  double quantile(double from_mm, double to_mm, double u) const;
};

// How much light rain takes out of a way through it: 0.312 R^0.67 per km (Weber et al. 2015).
double extinction_per_m(double rate_mm_h);
// Meteorological range in rain, m: 3 / extinction; 5 % contrast.
double visibility_m(double rate_mm_h);

}  // namespace rg::rain
