// How large beads are, and what a film's step is told of their shape.
#pragma once

#include <algorithm>

#include "glass/water.h"
#include "shared/glass_film.glsl"

namespace rg::glass {

// Glass that holds nothing by Furmidge's law holds a ball of 0.1 mm of radius all the same: none is quite
// even.
inline constexpr double kLeastHeld_m3 = 4.2e-12;  // (by eye)

// The largest that is a bead: no larger than those that lie on an upright pane of this glass, nor than a
// texel's store holds.
inline double mostBead_m3(const Surface& surface) {
  const double radius_m = std::min(static_cast<double>(shared::kMostBead_m), heldRadius_m(surface));
  return std::clamp(capShape(meanAngle(surface)) * radius_m * radius_m * radius_m, kLeastHeld_m3,
                    cubicMetres(shared::kMostBeads_pl));
}

// What beads' shape says: caps of the mean angle.
inline void setBeadShape(shared::FilmStepInfo& info, const Surface& surface) {
  const double contact_rad = meanAngle(surface);
  info.bead_mm3_per_pl = static_cast<float>(1e-6 / capShape(contact_rad));
  info.most_bead_pl = static_cast<int>(picolitres(mostBead_m3(surface)));
  info.bead_by_ridge = shared::ridgeBeads(static_cast<float>(contact_rad));
}

}  // namespace rg::glass
