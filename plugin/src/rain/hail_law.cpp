#include "rain/hail_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gravity.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kStone_kg_m3 = 900.0, kAir_kg_m3 = 1.2, kDrag = 0.6;
constexpr double kFlattest_per_mm = 0.15, kSteepest_per_mm = 1.0;

// 0..1 by id, another one for each `which`.
double chance(uint32_t id, uint32_t which) {
  uint32_t h = (id + which * 0x9e3779b9u) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return (h ^ h >> 16) * 0x1p-32;
}

}  // namespace

double stoneSpeed_mps(double diameter_mm) {
  return std::sqrt(4.0 * kStone_kg_m3 * kGravity_mps2 * 1e-3 * diameter_mm / (3.0 * kDrag * kAir_kg_m3));
}

double hailSlope_per_mm(double rate_mm_h) {
  // With speed c sqrt(D) all sizes deliver 3.6e-3 0.9 pi/6 115 c Gamma(4.5) L^-0.87 mm/h.
  constexpr double kGamma4_5 = 11.6317;
  const double of_one =
      3.6e-3 * kIceDensity * std::numbers::pi / 6.0 * 115.0 * stoneSpeed_mps(1.0) * kGamma4_5;
  const double slope = std::pow(std::max(rate_mm_h, 1e-3) / of_one, -1.0 / 0.87);
  return std::clamp(slope, kFlattest_per_mm, kSteepest_per_mm);
}

dvec3 bouncedVelocity(const dvec3& velocity_mps, const dvec3& normal, uint32_t id) {
  const double into_mps = std::max(0.0, -glm::dot(velocity_mps, normal));
  const dvec3 along = velocity_mps + normal * into_mps;
  const dvec3 other = std::abs(normal.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 one = glm::normalize(glm::cross(normal, other)), two = glm::cross(normal, one);
  const double turn = 2.0 * std::numbers::pi * chance(id, 0), sideways = 0.25 * into_mps * chance(id, 1);
  const double back = (0.3 + 0.1 * chance(id, 2)) * into_mps;
  return 0.7 * along + sideways * (std::cos(turn) * one + std::sin(turn) * two) + back * normal;
}

}  // namespace rg::rain
