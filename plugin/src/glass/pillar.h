// From one pane's edge to the next pane's, round the pillar between both: what runs off the one there, or a
// blade throws over, goes on over the other: a windscreen's water over the side windows. Of a blade what the
// film's step reports: not what those of panes without a film throw, nor what one cannot hold.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <mutex>
#include <vector>

#include "glass/pane_map.h"
#include "saved/archive.h"

namespace rg::glass {

// Edges no farther apart than this have a pillar between them (the car's own are 8 to 14 cm wide).
inline constexpr double kWidestPillar_m = 0.2;
// How long water is on its way, in ticks: 0.1 m at half a metre a second (by eye). At least one, so that a
// pane's tick needs none of its neighbours' at the same time.
inline constexpr int64_t kPillarTicks = 24;

// Water gathers on a pillar's trim until it is so much (2 mm^3, by eye) and comes off at once: what is at
// rest on the glass there it joins, and runs when that is enough for it.
inline constexpr int64_t kTrickle_pl = 2'000'000;

// Water that comes off a pillar, at a texel of the pane it comes to.
struct Trickle {
  int texel = 0;
  int64_t volume_pl = 0;
};

// [thread: any; it locks itself] Moments are those of PaneTick. What it is given, in whole picolitres, it
// hands on in order kPillarTicks later, so that it does not depend on how far either pane's ticks have come.
// What nobody takes for ten seconds runs past.
class Pillar {
 public:
  // Finds which tiles of the one have an edge that looks at the other's edge. A tile's water gathers and
  // comes off at one place.
  Pillar(const PaneMap& from, const PaneMap& to);
  bool joins() const { return joins_; }

  // From the pane it leaves: `share` of what left the tile in a tick.
  void give(int64_t moment, size_t tile, int64_t volume_pl, double share);
  // The pane's oldest tick that has not run yet; kNone when all have.
  static constexpr int64_t kNone = std::numeric_limits<int64_t>::max();
  void owes(int64_t moment);

  // For the pane it comes to: whether all that arrives by then is known, and what has.
  bool knows(int64_t moment) const;
  std::vector<Trickle> arrived(int64_t moment);

  void clear();
  uint64_t hash() const;  // of what is under way

  // What is on its way, as part of a saved state; `now`: the latest moment there was.
  void write(saved::Writer& a) const;
  void read(saved::Reader& a, int64_t now);

 private:
  struct Crossing {
    float share = 0.0f;  // of a tile's edge that looks at the other pane
    int texel = -1;      // there
    int64_t gathered_pl = 0;
  };
  struct UnderWay {
    int64_t moment = 0;
    Trickle trickle;
  };
  std::vector<Crossing> crossings_;  // of each tile
  int texels_there_ = 0;             // of the other pane's grid
  bool joins_ = false;
  mutable std::mutex mutex_;
  std::deque<UnderWay> under_way_;
  int64_t owes_ = kNone;
};

}  // namespace rg::glass
