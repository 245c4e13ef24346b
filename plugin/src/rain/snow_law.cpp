#include "rain/snow_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rain/size_law.h"

namespace rg::rain {
namespace {

constexpr double kFlakeMass_mg = 0.037, kFlakeMassPower = 1.9;  // of a flake 1 mm across
constexpr double kDropMass_mg = std::numbers::pi / 6.0;         // of a drop of 1 mm

}  // namespace

double flakeDiameter_mm(double melted_mm) {
  return std::pow(kDropMass_mg * melted_mm * melted_mm * melted_mm / kFlakeMass_mg, 1.0 / kFlakeMassPower);
}

double meltedDiameter_mm(double flake_mm) {
  return std::cbrt(kFlakeMass_mg * std::pow(flake_mm, kFlakeMassPower) / kDropMass_mg);
}

double flakeSpeed_mps(double flake_mm) { return 0.79 * std::pow(flake_mm, 0.27); }

double meltingDiameter_mm(double melted_mm) { return std::sqrt(melted_mm * flakeDiameter_mm(melted_mm)); }

double meltingSpeed_mps(double melted_mm) {
  return 0.5 * (flakeSpeed_mps(flakeDiameter_mm(melted_mm)) + fallSpeed(melted_mm));
}

double snowSlope_per_mm(double rate_mm_h) { return 2.55 * std::pow(std::max(rate_mm_h, 1e-3), -0.48); }

double snowShare(double temperature_c, double humidity) {
  const double percent = 100.0 * std::clamp(humidity, 0.0, 1.0);
  return 1.0 / (1.0 + std::exp(-10.04 + 1.41 * temperature_c + 0.09 * percent));
}

double meltingShare(double temperature_c) { return std::clamp(0.5 * temperature_c, 0.0, 1.0); }

}  // namespace rg::rain
