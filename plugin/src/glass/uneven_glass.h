// Glass is not the same everywhere: how easily water advances over it varies over millimetres and
// centimetres, and stays where it is. Fronts of film turn into fingers by it, streams and sliding drops
// wander.
#pragma once

#include <cstdint>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

class UnevenGlass {
 public:
  // `seed`: whose glass it is. `share`: how much of it is uneven, 0 .. 1.
  UnevenGlass(const PaneMap& map, uint32_t seed, double share = 1.0);

  // Of each texel, 0 the easiest .. shared::kMostUneven, see shared::unevenness.
  int level(int texel) const { return levels_[static_cast<size_t>(texel)]; }
  void fetch(int texel) const { __builtin_prefetch(&levels_[static_cast<size_t>(texel)]); }

 private:
  std::vector<uint8_t> levels_;
};

}  // namespace rg::glass
