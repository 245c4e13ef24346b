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
  // A class's cells as they were last found: they do as long as they hold what the view looks into.
  struct Known {
    bool found = false;
    Region region;
    glm::dvec3 eye_m{0.0};  // in the class's frame
    int64_t until = 0;      // this tick they are found anew in any case
    uint32_t current = 0;   // of `rows`
  };
  std::array<Known, kClasses> known;
  std::array<std::array<RowSet, 2>, kClasses> rows;

  static void visit(auto& a, auto& view) {
    a(view.id, view.moved);
    a.within(view.eye_m, -kAnyNumber, kAnyNumber);
    visitUnit(a, view.worldFromEye);
    a(view.streak_m);
    for (uint32_t kind = 0; kind < kClasses; ++kind) {
      auto& known = view.known[kind];
      a(known.found);
      if (!known.found) continue;
      a(known.region);
      a.within(known.eye_m, -kAnyNumber, kAnyNumber);
      a.within(known.until, -kLatestTick, kLatestTick);
      a(view.rows[kind][known.current]);
    }
  }
};

// What a tick's views look for.
struct Sought {
  int64_t tick = 0;
  std::span<const ViewState> views;
  double reach_per_diameter = 1.0;  // drops are seen as far as this times their diameter
  std::bitset<kClasses> classes;    // that may have drops: the others have no cells
};

// The border's cells are blocks of 2^level cells of the standing lattice along each axis, so that there are
// no more of them however far drops are seen: along a class's reach as near to six as powers of two come.
class Border {
 public:
  explicit Border(Cells& cells);

  static uint32_t levelFor(double reach_per_diameter);
  uint32_t level() const { return level_; }
  // Begins anew, no view having looked anywhere; the cells are cleared by their owner.
  void clear(uint32_t level);
  double cell_m(uint32_t kind) const;

  // Takes the views to a tick. Views that are not told any more look into nothing.
  void follow(const Sought& sought, const ClassFrames& frames);

  // Cells that came into sight with the last follow(), each once.
  const std::vector<uint32_t>& entered() const { return entered_; }
  // Cells that no view looks into any more: each must be emptied and freed before the next follow().
  const std::vector<uint32_t>& left() const { return left_; }
  uint32_t cellsOf(uint32_t kind) const { return cells_of_[kind]; }  // in sight

  std::span<const std::unique_ptr<FollowedView>> views() const { return views_; }
  void shift(const glm::dvec3& shift_m);

  // Between ticks. Read by one that has looked nowhere yet; its cells are found by what was looked into.
  void write(saved::Writer& a) const;
  void read(saved::Reader& a);

 private:
  // How a view moves in a tick.
  struct Motion {
    glm::dvec3 velocity_mps{0.0};
    double turn_radps = 0.0;
    double surprise_m = 0.0;  // so far it is from where its velocity said
    double exposure_s = 0.0;
  };

  void followView(FollowedView& view, const ViewState& told, const Sought& sought, const ClassFrames& frames);
  void followClass(FollowedView& view, uint32_t kind, const Cone& cone, const Motion& motion,
                   const Sought& sought, const ClassFrames& frames);
  void takeRows(FollowedView& view, uint32_t kind);
  void forgetRows(FollowedView& view, uint32_t kind);
  void replaceRows(const RowSet& before, const RowSet& after, uint32_t kind);
  void replaceRow(RowSpan was, RowSpan is, uint32_t kind, int32_t y, int32_t z);
  void enter(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last);
  void leave(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last);
  void releaseCells();

  Cells& cells_;
  uint32_t level_ = 0;
  std::vector<std::unique_ptr<FollowedView>> views_;
  std::array<uint32_t, kClasses> cells_of_{};
  std::vector<uint32_t> entered_, left_;
  std::vector<CellKey> released_;  // by a view in this tick
};

}  // namespace rg::rain
