// A pane's film as it is between two steps, with nothing under way to or from the GPU: what lies there, as
// far as the rest does not follow from it.
#pragma once

#include <cstdint>
#include <vector>

#include "glass/pane_map.h"
#include "saved/archive.h"

namespace rg::glass {

struct FilmState {
  std::vector<int32_t> film_pl;   // of each texel; -1 off the pane and behind its sill
  std::vector<uint32_t> beads;    // packed as in shared/glass_beads.glsl
  std::vector<int32_t> ridge_pl;  // of each piece
  std::vector<uint8_t> tiles;     // kStirs, kAwake

  static constexpr uint8_t kStirs = 1, kAwake = 2;  // as TileState in film_buffers.glsl

  int64_t filmSum_pl() const;
  int64_t beadsSum_pl() const;
  int64_t ridgesSum_pl() const;

  void write(saved::Writer& a) const;
  // Off the pane are the texels that have no glass, and those that are `hidden`.
  void read(saved::Reader& a, const PaneMap& map, const std::vector<bool>& hidden);
};

}  // namespace rg::glass
