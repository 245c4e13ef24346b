#include "rain/border.h"

#include <algorithm>
#include <cmath>

#include "rain/standing.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kReferenceReach = 1.25 * 1663.0;  // per diameter: of the standing lattice's cells
constexpr double kCut_m = 2.0;  // an eye that is so far from where it was to be has been put there
constexpr double kLeastTurn_radps = 1.0472;  // 60 deg/s: a turn of the view that needs no warning
constexpr double kMostAhead = 8.0;           // ticks for which cells are found at most
constexpr double kMoreCells = 0.1;           // cells that they may grow by for it
constexpr double kSpare = 0.005;             // cells, for roundings and an eye that changes its velocity

}  // namespace

Border::Border(Cells& cells) : cells_(cells) {
  entered_.reserve(1u << 16);
  left_.reserve(1u << 16);
  released_.reserve(1u << 16);
}

uint32_t Border::levelFor(double reach_per_diameter) {
  constexpr double kHalfAStep = 1.4142;  // of level: the one that is nearest in ratio
  uint32_t level = 0;
  while (reach_per_diameter > kHalfAStep * kReferenceReach * static_cast<double>(1u << level)) ++level;
  return level;
}

void Border::clear(uint32_t level) {
  level_ = level;
  views_.clear();
  cells_of_.fill(0);
}

double Border::cell_m(uint32_t kind) const {
  return classLattices()[kind].cell_m * static_cast<double>(1u << level_);
}

void Border::shift(const dvec3& shift_m) {
  for (auto& view : views_) view->eye_m -= shift_m;
}

void Border::follow(const Sought& sought, const ClassFrames& frames) {
  entered_.clear();
  for (auto& view : views_) view->told = false;
  for (const ViewState& told : sought.views) {
    auto found = std::find_if(views_.begin(), views_.end(), [&](const auto& v) { return v->id == told.id; });
    if (found == views_.end()) {
      views_.push_back(std::make_unique<FollowedView>());
      found = views_.end() - 1;
      (*found)->id = told.id;
    }
    (*found)->told = true;
    followView(**found, told, sought, frames);
  }
  for (auto& view : views_) {
    if (view->told) continue;
    for (uint32_t kind = 0; kind < kClasses; ++kind) forgetRows(*view, kind);
  }
  std::erase_if(views_, [](const auto& view) { return !view->told; });
  releaseCells();
}

void Border::followView(FollowedView& view, const ViewState& told, const Sought& sought,
                        const ClassFrames& frames) {
  const Cone cone = coneOf(told);
  const glm::dquat worldFromEye = glm::quat_cast(glm::transpose(glm::dmat3(told.eyeFromWorld)));
  const dvec3 velocity = eyeVelocityOf(told);
  Motion motion{velocity, 0.0, 0.0, exposureOf(told)};
  const double off_m = glm::distance(cone.eye_m - view.eye_m, velocity * kTickSeconds);
  if (view.moved && !told.discontinuity && cone.valid && off_m < kCut_m) {
    motion.surprise_m = off_m;
    motion.turn_radps =
        2.0 * std::acos(std::min(1.0, std::abs(glm::dot(worldFromEye, view.worldFromEye)))) / kTickSeconds;
  }
  view.moved = cone.valid;
  view.eye_m = cone.eye_m;
  view.worldFromEye = worldFromEye;
  view.streak_m = 0.0;
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    if (sought.classes[kind])
      followClass(view, kind, cone, motion, sought, frames);
    else
      forgetRows(view, kind);
  }
}

// Cells are found for several ticks at once where that makes them but little more, each class in its turn; in
// the middle of its turn as for all of it, so that who looks in only now sees the same. Whatever else the
// view does then, they are found anew as soon as they do not hold all that it looks into.
void Border::followClass(FollowedView& view, uint32_t kind, const Cone& cone, const Motion& motion,
                         const Sought& sought, const ClassFrames& frames) {
  const ClassLattice& lattice = classLattices()[kind];
  const dvec3 past_m = (frames.velocity(kind) - motion.velocity_mps) * kTickSeconds;  // in a tick
  const double reach = sought.reach_per_diameter * 1e-3 * lattice.reach_mm, cell = cell_m(kind);
  const double turned_m = 1.3 * kTickSeconds * reach * motion.turn_radps;
  Margin margin;
  margin.ahead_m = past_m * 1.25;  // a quarter to spare
  margin.streak_m = past_m * (0.5 * motion.exposure_s * kTickHz);
  margin.sides_m = 0.02 + lattice.swing_m + 1.3 * motion.surprise_m +
                   std::max(turned_m, 1.3 * kTickSeconds * reach * kLeastTurn_radps);
  margin.middle_m = -0.5 * margin.ahead_m;  // halfway to where the eye will be
  margin.reach_m = reach + lattice.swing_m + 1.3 * motion.surprise_m + glm::length(margin.middle_m);
  view.streak_m = std::max(view.streak_m, glm::length(margin.streak_m));

  FollowedView::Known& known = view.known[kind];
  const dvec3 eye = cone.eye_m - frames.origin(kind);
  const Region wanted(cone, margin);
  if (known.found && sought.tick < known.until && known.region.holds(wanted, eye - known.eye_m)) return;

  const double more_m = glm::length(past_m) + turned_m;  // in a tick
  const auto ticks =
      static_cast<int64_t>(1.0 + std::min(kMostAhead - 1.0, kMoreCells * cell / std::max(more_m, 1e-6)));
  const int64_t since = ((sought.tick + kind) % ticks + ticks) % ticks;
  const double after = static_cast<double>(ticks - 1);
  known.until = sought.tick - since + ticks;
  known.eye_m = eye + past_m * static_cast<double>(since);
  margin.ahead_m += past_m * after;
  margin.middle_m -= 0.5 * past_m * after;
  margin.sides_m += turned_m * after + kSpare * cell;
  margin.reach_m += 0.5 * glm::length(past_m) * after + kSpare * cell;
  known.region = Region(cone, margin);
  known.found = cone.valid;  // of none there are no rows, and nothing to be known by
  findRows(cone, margin, known.eye_m / cell, cell, view.rows[kind][1 - known.current]);
  takeRows(view, kind);
}

void Border::takeRows(FollowedView& view, uint32_t kind) {
  uint32_t& current = view.known[kind].current;
  replaceRows(view.rows[kind][current], view.rows[kind][1 - current], kind);
  view.rows[kind][current].clear();
  current = 1 - current;
}

void Border::forgetRows(FollowedView& view, uint32_t kind) {
  if (!view.known[kind].found) return;
  view.known[kind].found = false;
  takeRows(view, kind);
}

// Counts the cells that `after` has and `before` had not as entered, and the other way round.
void Border::replaceRows(const RowSet& before, const RowSet& after, uint32_t kind) {
  for (int32_t y = after.y0; y < after.y0 + after.ny; ++y) {
    const RowSpan *is = after.line(y), *was = before.line(y);
    for (int32_t z = after.z0; z < after.z0 + after.nz; ++z, ++is) {
      const RowSpan then = was != nullptr && before.hasZ(z) ? was[z - before.z0] : RowSpan{};
      if (then != *is) replaceRow(then, *is, kind, y, z);
    }
  }
  for (int32_t y = before.y0; y < before.y0 + before.ny; ++y) {
    const RowSpan* was = before.line(y);
    const bool known = after.line(y) != nullptr;
    for (int32_t z = before.z0; z < before.z0 + before.nz; ++z, ++was)
      if (!known || !after.hasZ(z)) replaceRow(*was, RowSpan{}, kind, y, z);
  }
}

void Border::replaceRow(RowSpan was, RowSpan is, uint32_t kind, int32_t y, int32_t z) {
  if (was.first == was.last || is.first == is.last || is.last <= was.first || was.last <= is.first) {
    enter(kind, y, z, is.first, is.last);
    leave(kind, y, z, was.first, was.last);
    return;
  }
  enter(kind, y, z, is.first, was.first);
  enter(kind, y, z, was.last, is.last);
  leave(kind, y, z, was.first, is.first);
  leave(kind, y, z, is.last, was.last);
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

void Border::write(saved::Writer& a) const {
  a(level_);
  const auto count = static_cast<uint32_t>(views_.size());
  a(count);
  for (const auto& view : views_) a(*view);
}

void Border::read(saved::Reader& a) {
  constexpr uint32_t kMostViews = 64, kMostLevel = 8;
  constexpr size_t kMostCells = size_t{1} << 22;
  uint32_t count = 0;
  a.within(level_, 0u, kMostLevel);
  a.within(count, 0u, kMostViews);
  for (uint32_t i = 0; i < count; ++i) {
    views_.push_back(std::make_unique<FollowedView>());
    FollowedView& view = *views_.back();
    a(view);
    for (uint32_t kind = 0; kind < kClasses; ++kind) {
      if (view.known[kind].found) replaceRows(RowSet{}, view.rows[kind][view.known[kind].current], kind);
    }
    a.require(cells_.live() <= kMostCells, "more cells than any view looks into");
  }
  entered_.clear();
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
