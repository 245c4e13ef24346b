// The sky by weather: what it looks like, and the light it gives.
#pragma once

#include <glm/glm.hpp>

namespace host {

/// The weather as far as light goes.
struct Sky {
  double rain_mm_h = 0.0, snow_mm_h = 0.0, hail_mm_h = 0.0;  ///< as water
  double visibility_m = 40000.0;                             ///< meteorological range without rain
  double wetness = 0.0;                                      ///< of open ground, 0 dry .. 1 soaked
  double time_s = 0.0;                                       ///< clouds drift with it
  glm::vec3 to_sun{0.45F, 0.35F, 0.55F};
  bool operator==(const Sky&) const = default;
};

/// How far clouds close the sky, 0 clear .. 1 overcast: whole from 0.5 mm/h on.
double cloudCover(const Sky& sky);
/// Extinction of the air and its snow, without its rain (the plugin draws that), 1/m: 3.912 / range
/// (Koschmieder 1924, 2 % contrast) + 3.9 S^0.65 per km: a range of 1 km at 1 mm/h, between the extremes of a
/// factor of 3 to 10 that Rasmussen et al. (1999) found (coefficients unsourced). Hail is too sparse to
/// count.
double extinction(const Sky& sky);
/// Of the air alone, as it is where no snow falls.
double extinctionOfAir(const Sky& sky);
/// Light from above at this height of the sun as a share of that at 35 degrees, down to the glow of lamps on
/// clouds at night (Seidelmann 1992, after Janiczek & DeYoung 1987).
double daylight(const Sky& sky);
/// Radiance of an overcast zenith, 1000 cd/m^2: darker the more falls, and the lower the sun stands.
double overcastZenith(const Sky& sky);
/// Irradiance on a plane across the sun's rays, 1000 lx, clouds and air counted: none once it has set.
glm::vec3 sunIrradiance(const Sky& sky);

/// How many times their own intensity street lamps are shown with. They are those of a night; beside daylight
/// a camera that shows both sees none of them, but the eye adapts to each part of the view by itself: 10
/// times by day (chosen by eye), as they are by night.
float streetLampGain(const Sky& sky);

/// How bright lit windows and signs are shown, relative to what is seen to glow by day: some 100 cd/m^2 by
/// night (a room of 300 lx and bright walls), for the same reason.
float litWindowLevel(const Sky& sky);

}  // namespace host
