#include "render/sky.h"

#include <algorithm>
#include <cmath>

namespace host {

namespace {

double allThatFalls_mm_h(const Sky& sky) {
  return std::max(sky.rain_mm_h, 0.0) + std::max(sky.snow_mm_h, 0.0) + std::max(sky.hail_mm_h, 0.0);
}

}  // namespace

double cloudCover(const Sky& sky) { return std::clamp(allThatFalls_mm_h(sky) / 0.5, 0.0, 1.0); }

double extinction(const Sky& sky) {
  return 3.912 / std::max(sky.visibility_m, 1.0) + 3.9e-3 * std::pow(std::max(sky.snow_mm_h, 0.0), 0.65);
}

glm::vec3 sunIrradiance(const Sky& sky) {
  // About 90 klx under a clear sky, warm as it is lower than the sky is blue; none through rain clouds.
  return glm::vec3(95.0F, 88.0F, 76.0F) * static_cast<float>(1.0 - cloudCover(sky));
}

double overcastZenith(const Sky& sky) {
  // Chosen by eye, for want of a law: 12 klx on level ground in a drizzle, 4 klx in a downpour. E = 7/9 pi L
  // (Moon & Spencer 1942).
  const double illuminance_klx = 15.0 * std::pow(allThatFalls_mm_h(sky) + 1.0, -0.33);
  return illuminance_klx * 9.0 / (7.0 * 3.14159265358979);
}

}  // namespace host
