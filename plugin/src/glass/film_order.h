// What travels between a pane's ticks on the CPU and its film on the GPU: orders for one film step (two
// ticks), and the report of it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "shared/glass_film.glsl"

namespace rg::glass {

inline constexpr int kTicksPerFilmStep = 2;
// A report is used this many ticks after the step it tells of: long enough for a GPU that lags and for hosts
// that draw 12 pictures a second, and the same for all, so that the state does not depend on how fast
// anything was.
inline constexpr int kReportLatency_ticks = 16;
inline constexpr int kRidgePieces = shared::kMaxGlassWipers * shared::kBladeSegments;

// A blade's way in terms of its list of swept texels; no texel twice.
struct SweepOrder {
  std::shared_ptr<const std::vector<shared::SweptTexel>> swept;
  int first_range = 0;     // of the order's ranges, one for each piece of the blade
  int first_piece = 0;     // of the ridges
  bool backwards = false;  // towards lesser angles
};

// A texel that a window's sill hides from now on, or shows again, dry. Where a film is made in the middle of
// a step it may be both, one after the other.
struct SlidTexel {
  int texel;
  bool shown;
};

// Order of work in a step: takes, what slides, adds of film and of beads, ridge adds, sweeps one after the
// other, leaves, flow, drying.
struct FilmOrder {
  int64_t step = -1;
  bool clear = false;  // no step: the film is to be dry
  std::vector<shared::FilmTake> takes;
  std::vector<SlidTexel> slid;
  std::vector<shared::FilmAdd> adds;
  std::vector<shared::BeadAdd> bead_adds;  // no texel twice, as in the others
  std::vector<shared::RidgeAdd> ridge_adds;
  std::vector<SweepOrder> sweeps;
  std::vector<shared::SweptRange> sweep_ranges;
  std::vector<shared::RidgeLeave> leaves;
  std::vector<int> leave_texels;
  std::vector<int> leave_edges;     // for each of `leaves`: where its water leaves the pane if it does; -1
  std::vector<shared::vec4> drive;  // per node, see ForceField::filmDrive
  shared::FilmStepInfo info{};
  int64_t ordered_pl = 0;  // of all adds
};

// What a blade threw off the pane in a step.
struct ThrownOff {
  int segment = 0;
  int texel = -1;  // at the edge it went over, as FilmLink knows it; -1: none
  int volume_pl = 0;
  bool operator==(const ThrownOff&) const = default;
};

struct FilmReport {
  int64_t step = 0;
  std::vector<shared::FilmTile> tiles;
  std::vector<int> taken_pl;  // one for each of the order's takes
  int64_t ridge_pl = 0;
  std::vector<ThrownOff> thrown;  // of each piece that threw any, in their order
};

}  // namespace rg::glass
