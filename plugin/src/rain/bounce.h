// What becomes of a hailstone that hit something: it flies on, once, and is gone where it comes down.
#pragma once

#include <glm/glm.hpp>

#include "rain/shelter.h"
#include "shared/rain_streak.glsl"

namespace rg::rain {

// A stone at the end of its fall. Times in s; `ago_s`: it was so long before now, 0 .. a tick.
struct Impact {
  glm::dvec3 place_m{0.0};  // of its middle
  glm::dvec3 velocity_mps{0.0};
  double diameter_m = 0.0;
  double ago_s = 0.0;
  uint32_t id = 0;
};

// Free flight without drag from `place_m` on, which the stone reached at its impact.
struct Flight {
  glm::dvec3 place_m{0.0}, velocity_mps{0.0};
  double lasts_s = 0.0;
};

// How it flies off what it hit: a volume's face, resting or moving, else the ground. It ends where it comes
// down to the ground or meets a volume, after kLongestFlight_s at most. lasts_s 0: nothing is there to bounce
// off. The velocity is one that a record can hold.
inline constexpr double kLongestFlight_s = 3.0;
Flight flightAfter(const Impact& impact, double ground_m, Shelter& shelter, double now_s);

// Its record, in the lattice of bounced stones whose cell (0, 0, 0) has its corner at `origin_m`. `from`,
// `end`: as RainDrop.end. Places beyond 500 km from the origin have none: diameter 0.
shared::RainDrop recordOf(const Flight& flight, double diameter_m, const glm::dvec3& origin_m, uint32_t from,
                          uint32_t end);

}  // namespace rg::rain
