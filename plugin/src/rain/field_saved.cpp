// The field as a saved state: all that its ticks go on from. Cells and rows follow from what views looked
// into, the calendar from drops' ends.
#include "rain/field_state.h"
#include "saved/inputs.h"

namespace rg::rain {

void Field::State::visit(auto& a, auto& s) {
  a(s.settings.seed);
  a(s.started, s.running);
  a.within(s.epoch, -kLatestTick, kLatestTick);
  a.within(s.tick, -kLatestTick, kLatestTick);
  a.within(s.ceiling_m, -1e30, kAnyNumber);
  a(s.ground_m);
  a.within(s.keep, 1e-6, 1.0);
  a(s.born, s.died, s.sheltered, s.bounced, s.uploaded, s.tests_before);
  a(s.frames);
}

void Field::State::writeCells(saved::Writer& a) const {
  uint32_t count = 0;
  for (uint32_t i = 0; i < cells.poolSize(); ++i) count += cells[i].views > 0 && cells[i].bunch != kNone;
  a(count);
  for (uint32_t i = 0; i < cells.poolSize(); ++i) {
    const Cell& cell = cells[i];
    if (cell.views == 0 || cell.bunch == kNone) continue;
    a(cell.key, cell.near_volume);
    drops.write(a, cell.bunch);
  }
}

void Field::State::readCells(saved::Reader& a) {
  uint32_t count = 0;
  a.within(count, 0u, cells.live());
  for (uint32_t i = 0; i < count; ++i) {
    CellKey key;
    bool near_volume = false;
    a(key, near_volume);
    const uint32_t index = cells.indexOf(key);
    a.require(index != kNone && cells[index].bunch == kNone, "a cell that no view looks into has drops");
    cells[index].near_volume = near_volume;
    drops.read(a, key.kind, index, cells[index].bunch);
  }
}

void Field::write(saved::Writer& a) const {
  const State& s = *state_;
  const uint32_t capacity = s.drops.capacity();
  const bool has_bounced = s.bounced_cell != kNone;
  a(capacity);
  State::visit(a, s);
  s.shelter.write(a);
  if (s.started) s.rate.write(a);
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    const bool is_followed = s.followed.test(kind);
    a(is_followed);
  }
  s.border.write(a);
  a(has_bounced);
  s.writeCells(a);
}

void Field::read(saved::Reader& a) {
  uint32_t capacity = 0;
  bool has_bounced = false;
  a(capacity);
  a.require(capacity == state_->drops.capacity(), "rg_create_info.max_drops was another one");
  auto s = std::make_unique<State>(state_->settings);
  s->visibility = state_->visibility;
  s->profile = state_->profile;
  State::visit(a, *s);
  a.require(s->settings.seed == state_->settings.seed, "rg_create_info.seed was another one");
  s->shelter.takeVolumes(state_->shelter);
  s->shelter.read(a);
  if (s->started) s->rate.read(a);
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    bool is_followed = false;
    a(is_followed);
    s->followed.set(kind, is_followed);
  }
  s->border.read(a);
  a(has_bounced);
  bool is_fresh = false;
  if (has_bounced) s->bounced_cell = s->cells.acquire({0, 0, 0, kBouncedClass}, is_fresh);
  a.require(s->started || (!s->running && s->cells.live() == 0), "drops fall before the first tick");
  s->readCells(a);
  s->drops.scheduleAll(s->now());
  if (a.commits()) state_ = std::move(s);
}

}  // namespace rg::rain
