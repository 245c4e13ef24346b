// Beads on uncoated glass, for tests of their laws.
#pragma once

#include "glass/bead_shape.h"
#include "shared/glass_film.glsl"

namespace rg::test {

inline shared::Beads beads(int volume_pl, int number) {
  shared::Beads b{};
  b.volume_pl = volume_pl;
  b.number = number;
  return b;
}

// Of a texel of 3 mm on uncoated glass.
inline shared::FilmStepInfo uncoated() {
  const glass::Surface s = glass::surfaceOf(glass::Glass::uncoated);
  shared::FilmStepInfo info{};
  info.pin_m = static_cast<float>(s.pin_m);
  info.front_m = static_cast<float>(s.front_m);
  info.rupture_m = static_cast<float>(s.rupture_m);
  glass::setBeadShape(info, s);
  info.drops_allowed = 1;
  return info;
}
// Of PaneMap::nodeMetric().
inline shared::vec4 squareTexel(float side_m) {
  const float per_step = shared::kFilmStep_s / side_m;
  return {per_step, per_step, 1.0f / (side_m * side_m), side_m * side_m / shared::kPicolitre_m3};
}
inline const shared::vec4 kTexel = squareTexel(3e-3f);

}  // namespace rg::test
