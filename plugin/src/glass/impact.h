// Which raindrops meet the glass during a tick, and where: the flux of each size through the moving surface.
#pragma once

#include <cstdint>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

struct Impact {
  glm::dvec2 place_m{0.0};  // grid
  int texel = 0;
  double diameter_m = 0.0;
  double speed_mps = 0.0;  // against the glass, along its normal
  int64_t volume_pl = 0;
  uint32_t hash = 0;  // for what is random about this drop
};

double weber(const Impact& impact);

// How far such a drop's water spreads over the glass, as a lamella: D We^(1/4) across, or D Re^(1/5) where
// viscosity stops it before (Clanet, Beguin, Richard & Quere 2004). Speed along the glass' normal.
double lamellaRadius_m(double diameter_m, double speed_mps);
double lamellaRadius_m(const Impact& impact);

// How often lamellae run over a place of the glass that the rain reaches, in the mean.
double lamellae_hz(const PaneMap& map, const PaneTick& tick);

// Water that meets the pane in a second, m^3/s: sum over sizes and regions of N V_D max(0, -(v_drop -
// v_glass) . n) A.
double catchRate_m3_s(const PaneMap& map, const PaneTick& tick);

// A Poisson number for each size, by hash of (seed, pane, tick, size); places go by area and incidence. `out`
// is cleared first.
void findImpacts(const PaneMap& map, const PaneTick& tick, uint64_t seed, uint32_t pane,
                 std::vector<Impact>& out);

}  // namespace rg::glass
