#include "rain/border.h"

#include <algorithm>
#include <cmath>

#include "rain/standing.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kLeastTurn_radps = 1.0472;  // 60 deg/s: a turn of the view that needs no warning

}  // namespace

Border::Border(Cells& cells) : cells_(cells) {
  entered_.reserve(1u << 16);
  left_.reserve(1u << 16);
  released_.reserve(1u << 16);
}

void Border::clear() {
  views_.clear();
  cells_of_.fill(0);
}

void Border::shift(const dvec3& shift_m) {
  for (auto& view : views_) view->eye_m -= shift_m;
}

void Border::follow(std::span<const ViewState> all_told, const ClassFrames& frames, double reach_per_diameter,
                    const std::bitset<kClasses>& followed) {
  entered_.clear();
  for (auto& view : views_) view->told = false;
  for (const ViewState& told : all_told) {
    auto found = std::find_if(views_.begin(), views_.end(), [&](const auto& v) { return v->id == told.id; });
    if (found == views_.end()) {
      views_.push_back(std::make_unique<FollowedView>());
      found = views_.end() - 1;
      (*found)->id = told.id;
    }
    (*found)->told = true;
    followView(**found, told, frames, reach_per_diameter, followed);
  }
  for (auto& view : views_) {
    if (view->told) continue;
    for (uint32_t kind = 0; kind < kClasses; ++kind)
      replaceRows(view->rows[view->current][kind], RowSet{}, kind);
  }
  std::erase_if(views_, [](const auto& view) { return !view->told; });
  releaseCells();
}

void Border::followView(FollowedView& view, const ViewState& told, const ClassFrames& frames,
                        double reach_per_diameter, const std::bitset<kClasses>& followed) {
  const Cone cone = coneOf(told);
  const glm::dquat worldFromEye = glm::quat_cast(glm::transpose(glm::dmat3(told.eyeFromWorld)));
  const dvec3 velocity = eyeVelocityOf(told);
  double turn = 0.0, surprise_m = 0.0;
  if (view.moved && !told.discontinuity && cone.valid) {
    const dvec3 really = (cone.eye_m - view.eye_m) / kTickSeconds;
    surprise_m = glm::distance(really, velocity) * kTickSeconds;
    turn = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(worldFromEye, view.worldFromEye)))) / kTickSeconds;
  }
  view.moved = cone.valid;
  view.eye_m = cone.eye_m;
  view.worldFromEye = worldFromEye;

  const uint32_t before = view.current, after = 1 - before;
  view.current = after;
  view.streak_m = 0.0;
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    if (!followed.test(kind)) {
      view.rows[after][kind].clear();
      replaceRows(view.rows[before][kind], view.rows[after][kind], kind);
      view.rows[before][kind].clear();
      continue;
    }
    const ClassLattice& lattice = classLattices()[kind];
    const dvec3 past = frames.velocity(kind) - velocity;
    Margin margin;
    margin.ahead_m = past * (1.25 * kTickSeconds);  // a quarter to spare
    margin.streak_m = past * (0.5 * exposureOf(told));
    view.streak_m = std::max(view.streak_m, glm::length(margin.streak_m));
    const double reach = reach_per_diameter * 1e-3 * lattice.reach_mm;
    margin.sides_m = 0.02 + lattice.swing_m + 1.3 * kTickSeconds * std::max(turn, kLeastTurn_radps) * reach +
                     1.3 * surprise_m;
    margin.reach_m = reach + lattice.swing_m + 1.25 * kTickSeconds * glm::length(past) + 1.3 * surprise_m;
    findRows(cone, margin, (cone.eye_m - frames.origin(kind)) / lattice.cell_m, lattice.cell_m,
             view.rows[after][kind]);
    replaceRows(view.rows[before][kind], view.rows[after][kind], kind);
    view.rows[before][kind].clear();
  }
}

// Counts the cells that `after` has and `before` had not as entered, and the other way round.
void Border::replaceRows(const RowSet& before, const RowSet& after, uint32_t kind) {
  for (int32_t y = after.y0; y < after.y0 + after.ny; ++y) {
    for (int32_t z = after.z0; z < after.z0 + after.nz; ++z) {
      const RowSpan was = before.at(y, z), is = after.at(y, z);
      if (was.first == was.last) {
        enter(kind, y, z, is.first, is.last);
      } else {
        enter(kind, y, z, is.first, std::min(is.last, was.first));
        enter(kind, y, z, std::max(is.first, was.last), is.last);
      }
    }
  }
  for (int32_t y = before.y0; y < before.y0 + before.ny; ++y) {
    for (int32_t z = before.z0; z < before.z0 + before.nz; ++z) {
      const RowSpan was = before.at(y, z), is = after.at(y, z);
      if (is.first == is.last) {
        leave(kind, y, z, was.first, was.last);
      } else {
        leave(kind, y, z, was.first, std::min(was.last, is.first));
        leave(kind, y, z, std::max(was.first, is.last), was.last);
      }
    }
  }
}

void Border::enter(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last) {
  for (int32_t x = first; x < last; ++x) {
    bool is_fresh = false;
    const uint32_t index = cells_.acquire({x, y, z, kind}, is_fresh);
    if (!is_fresh) continue;
    entered_.push_back(index);
    ++cells_of_[kind];
  }
}

void Border::leave(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last) {
  for (int32_t x = first; x < last; ++x) released_.push_back({x, y, z, kind});
}

// After all views have entered theirs: a cell that goes from one view to another stays.
void Border::releaseCells() {
  left_.clear();
  for (const CellKey& key : released_) {
    const uint32_t index = cells_.release(key);
    if (index == kNone) continue;
    left_.push_back(index);
    --cells_of_[key.kind];
  }
  released_.clear();
}

}  // namespace rg::rain
