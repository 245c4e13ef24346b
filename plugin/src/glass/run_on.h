// How far the ridge before a blade runs on where the blade slows down and turns round.
#pragma once

#include <cstdint>

#include "glass/water.h"

namespace rg::glass {

// A piece of a blade on its last way: as a crank moves it, x(t) = -half_way cos(rate t).
struct PieceStroke {
  double half_way_m = 0.0;
  double rate_radps = 0.0;
};

// Way of a ridge of this cross-section beyond the place where its blade turns round, without gravity and
// wind.
double runOn_m(double area_m2, const PieceStroke& stroke, const Surface& surface);

// The least volume of a piece of `piece_m` of the ridge with which it runs on for `edge_m`; kNeverRunsOn when
// none does.
inline constexpr int32_t kNeverRunsOn = 0x7fffffff;
int32_t leastToRunOn_pl(double edge_m, double piece_m, const PieceStroke& stroke, const Surface& surface);

}  // namespace rg::glass
