// What the views look into from tick to tick: which cells come into sight, and which go out of it.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <span>
#include <vector>

#include "rain/cells.h"
#include "rain/class_frames.h"
#include "rain/region.h"
#include "tick.h"

namespace rg::rain {

// One view, as far as the field follows it.
struct FollowedView {
  uint32_t id = 0;
  bool told = false;   // in this tick
  bool moved = false;  // `eye_m` and `worldFromEye` are of the tick before
  glm::dvec3 eye_m{0.0};
  glm::dquat worldFromEye{1, 0, 0, 0};
  double streak_m = 0.0;  // of the longest streak, from the drop to its end
  uint32_t current = 0;
  std::array<std::array<RowSet, kClasses>, 2> rows;
};

class Border {
 public:
  explicit Border(Cells& cells);

  // Takes the views to a tick; drops are seen as far as `reach_per_diameter` times their diameter. Views that
  // are not told any more look into nothing, and none looks for classes that are not in `followed`.
  void follow(std::span<const ViewState> told, const ClassFrames& frames, double reach_per_diameter,
              const std::bitset<kClasses>& followed);

  // Cells that came into sight with the last follow(), each once.
  const std::vector<uint32_t>& entered() const { return entered_; }
  // Cells that no view looks into any more: each must be emptied and freed before the next follow().
  const std::vector<uint32_t>& left() const { return left_; }
  uint32_t cellsOf(uint32_t kind) const { return cells_of_[kind]; }  // in sight

  std::span<const std::unique_ptr<FollowedView>> views() const { return views_; }
  void clear();  // no view has looked anywhere; the cells are cleared by their owner
  void shift(const glm::dvec3& shift_m);

 private:
  void followView(FollowedView& view, const ViewState& told, const ClassFrames& frames,
                  double reach_per_diameter, const std::bitset<kClasses>& followed);
  void replaceRows(const RowSet& before, const RowSet& after, uint32_t kind);
  void enter(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last);
  void leave(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last);
  void releaseCells();

  Cells& cells_;
  std::vector<std::unique_ptr<FollowedView>> views_;
  std::array<uint32_t, kClasses> cells_of_{};
  std::vector<uint32_t> entered_, left_;
  std::vector<CellKey> released_;  // by a view in this tick
};

}  // namespace rg::rain
