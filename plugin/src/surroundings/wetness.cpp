#include "surroundings/wetness.h"

#include <algorithm>
#include <cmath>

namespace rg::surroundings {

double evaporation_mm_h(double temperature_c, double humidity, double wind_mps) {
  const double saturated_mmhg = 4.58 * std::exp(17.62 * temperature_c / (243.12 + temperature_c));
  const double missing_mmhg = saturated_mmhg * std::max(0.0, 1.0 - humidity);
  return 0.35 * (1.0 + 0.54 * wind_mps) * missing_mmhg / 24.0;
}

void Wetness::tick(const Tick& tick) {
  const WeatherState& w = tick.weather;
  const double wind_mps = glm::length(w.wind_mps);
  const double change_mm_h = w.rain_mm_h - evaporation_mm_h(w.temperature_c, w.humidity, wind_mps);
  water_mm_ = std::clamp(water_mm_ + change_mm_h * kTickSeconds / 3600.0, 0.0, kMostOnGround_mm);
}

}  // namespace rg::surroundings
