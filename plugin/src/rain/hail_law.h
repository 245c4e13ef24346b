// Hail: stones by size, how fast they fall, and how they leave what they hit.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace rg::rain {

// Below 5 mm it is graupel (WMO International Cloud Atlas); stones of more than 3 cm are left out.
inline constexpr double kSmallestStone_mm = 5.0;
inline constexpr double kLargestStone_mm = 30.0;
inline constexpr double kIceDensity = 0.9;  // by water's

// Terminal speed of a ball of ice: drag is weight, v^2 = 4 rho_h g D / (3 Cd rho_a), rho_h 900 and rho_a 1.2
// kg/m3, Cd 0.6 (Macklin & Ludlam 1961 measured 0.5..0.9).
double stoneSpeed_mps(double diameter_mm);

// Slope of Cheng & English's (1983) sizes N0 exp(-L D) per m3 per mm, N0 = 115 L^3.63: the one at which all
// sizes together would deliver the rate, as water. Held to 0.15..1 per mm, what they saw; N0 is then such
// that the stones that are counted deliver exactly the rate.
double hailSlope_per_mm(double rate_mm_h);

// The velocity with which a stone leaves what it hit, in the hit thing's frame: `normal` unit, out of it,
// `velocity_mps` into it. What comes back along the normal is 0.3..0.4 of what came, along the surface 0.7
// stays, and a rough surface turns up to a quarter of the blow sideways, by `id` (unsourced, all three). It
// always has less energy than before.
glm::dvec3 bouncedVelocity(const glm::dvec3& velocity_mps, const glm::dvec3& normal, uint32_t id);

}  // namespace rg::rain
