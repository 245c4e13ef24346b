#include "render/sky.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace host {

namespace {

double allThatFalls_mm_h(const Sky& sky) {
  return std::max(sky.rain_mm_h, 0.0) + std::max(sky.snow_mm_h, 0.0) + std::max(sky.hail_mm_h, 0.0);
}

constexpr double kUsualElevation_deg = 35.0;  // what the clear sky's colours and the overcast one's are for
// Level ground under clouds that lamps of a village light; the order of magnitude of a full moon, unsourced.
constexpr double kNight_lx = 0.1;

double elevation_deg(const Sky& sky) {
  return std::asin(std::clamp(double(glm::normalize(sky.to_sun).z), -1.0, 1.0)) * 180.0 / 3.14159265358979;
}

// Illuminance of level ground by sun and sky, lux. Explanatory Supplement to the Astronomical Almanac
// (Seidelmann 1992), after Janiczek & DeYoung (1987): log10 E as a cubic in the sun's elevation / 90 degrees,
// by range. Coefficients from memory; at 90, 0 and -6 degrees they give the 129 klx, 759 lx and 3.4 lx known.
double illuminance_lx(double elevation_deg) {
  struct Range {
    double from_deg;
    std::array<double, 4> c;
  };
  static constexpr std::array<Range, 6> kRanges{{{20.0, {3.74, 3.97, -4.07, 1.47}},
                                                 {5.0, {3.05, 13.28, -45.98, 64.33}},
                                                 {-0.8, {2.88, 22.26, -207.64, 1034.30}},
                                                 {-5.0, {2.88, 21.81, -258.11, -858.36}},
                                                 {-12.0, {2.70, 12.17, -431.69, -1899.83}},
                                                 {-18.0, {13.84, 262.72, 1447.42, 2797.93}}}};
  for (const auto& [from_deg, c] : kRanges) {
    if (elevation_deg < from_deg) continue;
    const double x = elevation_deg / 90.0;
    return kNight_lx + std::pow(10.0, c[0] + x * (c[1] + x * (c[2] + x * c[3])));
  }
  return kNight_lx;
}

// How much of the sun's beam comes through the air, relative to that at the usual height: optical depth 0.2
// of clear air (unsourced) over the air mass of Kasten & Young (1989).
double beam(double elevation_deg) {
  const auto passed = [](double deg) {
    const double air_mass =
        1.0 / (std::sin(deg / 180.0 * 3.14159265358979) + 0.50572 * std::pow(deg + 6.07995, -1.6364));
    return std::exp(-0.2 * air_mass);
  };
  return elevation_deg > 0.0 ? passed(elevation_deg) / passed(kUsualElevation_deg) : 0.0;
}

}  // namespace

double cloudCover(const Sky& sky) { return std::clamp(allThatFalls_mm_h(sky) / 0.5, 0.0, 1.0); }

double extinctionOfAir(const Sky& sky) { return 3.912 / std::max(sky.visibility_m, 1.0); }

double extinction(const Sky& sky) {
  return extinctionOfAir(sky) + 3.9e-3 * std::pow(std::max(sky.snow_mm_h, 0.0), 0.65);
}

glm::vec3 sunIrradiance(const Sky& sky) {
  // About 90 klx under a clear sky, warm as it is lower than the sky is blue; none through rain clouds.
  return glm::vec3(95.0F, 88.0F, 76.0F) *
         static_cast<float>((1.0 - cloudCover(sky)) * beam(elevation_deg(sky)));
}

double daylight(const Sky& sky) {
  return illuminance_lx(elevation_deg(sky)) / illuminance_lx(kUsualElevation_deg);
}

double overcastZenith(const Sky& sky) {
  // Chosen by eye, for want of a law: 12 klx on level ground in a drizzle, 4 klx in a downpour, the sun at 35
  // degrees. E = 7/9 pi L (Moon & Spencer 1942).
  const double illuminance_klx = 15.0 * std::pow(allThatFalls_mm_h(sky) + 1.0, -0.33) * daylight(sky);
  return illuminance_klx * 9.0 / (7.0 * 3.14159265358979);
}

float streetLampGain(const Sky& sky) {
  return static_cast<float>(1.0 + 9.0 * std::cbrt(std::min(daylight(sky), 1.0)));
}

float litWindowLevel(const Sky& sky) {
  constexpr float kByNight = 0.016F;  // of the 6000 cd/m^2 of emission 1
  return kByNight + (1.0F - kByNight) * std::cbrt(static_cast<float>(std::min(daylight(sky), 1.0)));
}

}  // namespace host
