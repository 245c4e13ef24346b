// Snow: flakes by size, how fast they fall, and how much of the precipitation is snow.
#pragma once

namespace rg::rain {

// Flakes are counted by the diameter of the drop they melt to. They are aggregates of rimed dendrites,
// Locatelli & Hobbs (1974, table 1): mass 0.037 D^1.9 mg, speed 0.79 D^0.27 m/s, D in mm across; measured for
// 2..12 mm, here held from 2.5 to 25 mm, where that speed is 1.0..1.9 m/s. Single crystals are left out.
inline constexpr double kSmallestFlake_mm = 2.5;
inline constexpr double kLargestFlake_mm = 25.0;
double flakeDiameter_mm(double melted_mm);
double meltedDiameter_mm(double flake_mm);
double flakeSpeed_mps(double flake_mm);

// A flake on its way to becoming a drop: smaller, and faster, than it was. Its speed lies midway between that
// of the flake and that of the drop, its diameter is their geometric mean (unsourced: Mitra, Vohl, Ahr &
// Pruppacher 1990 saw speeds go from the one to the other as flakes melt in a wind tunnel).
double meltingDiameter_mm(double melted_mm);
double meltingSpeed_mps(double melted_mm);

// Slope of Gunn & Marshall's (1958) sizes N0 exp(-L D), L = 2.55 R^-0.48 per mm, D melted, mm. N0 is not
// theirs (3800 R^-0.87 per m3 per mm), but such that the water delivered is exactly R. Held below 0.001 mm/h.
double snowSlope_per_mm(double rate_mm_h);

// The share of precipitation that falls as snow, 0..1: Jennings, Winchell, Livneh & Molotch (2018),
// 1 / (1 + exp(-10.04 + 1.41 T + 0.09 RH)), T in deg C, RH in %. Clamped to humidities of 0..1.
double snowShare(double temperature_c, double humidity);

// The share of snow that is melting as it comes down: none below 0 deg C, all from +2 on, linear between
// (unsourced).
double meltingShare(double temperature_c);

}  // namespace rg::rain
