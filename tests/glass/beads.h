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
inline const shared::vec4 kTexel(3e-3f, 3e-3f, 1.0f / 9e-6f, 0.0f);

}  // namespace rg::test
