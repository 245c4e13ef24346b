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
  // `seed`: whose glass it is.
  UnevenGlass(const PaneMap& map, uint32_t seed);

  // Of each texel, 0 the easiest .. shared::kGlassLevels - 1, see shared::unevenness.
  int level(int texel) const { return levels_[static_cast<size_t>(texel)]; }

 private:
  std::vector<uint8_t> levels_;
};

}  // namespace rg::glass
