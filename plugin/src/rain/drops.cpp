#include "rain/drops.h"

#include <algorithm>
#include <bit>

namespace rg::rain {

SlotPool::SlotPool(uint32_t capacity) : capacity_(capacity) {
  size_t words = capacity;
  for (auto& level : free_) {
    words = (words + 63) / 64;
    level.resize(words);
  }
  clear();
}

void SlotPool::clear() {
  used_ = end_ = 0;
  size_t bits = capacity_;
  for (auto& level : free_) {
    for (size_t i = 0; i < level.size(); ++i) {
      const size_t left = bits - i * 64;
      level[i] = left >= 64 ? ~uint64_t{0} : (uint64_t{1} << left) - 1;
    }
    bits = level.size();
  }
}

bool SlotPool::taken(uint32_t slot) const { return (free_[0][slot / 64] >> (slot % 64) & 1u) == 0; }

uint32_t SlotPool::take() {
  if (used_ == capacity_) return kNone;
  size_t index = 0;
  for (int level = kLevels - 1; level >= 0; --level) {
    index = index * 64 + static_cast<size_t>(std::countr_zero(free_[level][index]));
  }
  const uint32_t slot = static_cast<uint32_t>(index);
  for (auto& level : free_) {
    level[index / 64] &= ~(uint64_t{1} << (index % 64));
    if (level[index / 64] != 0) break;
    index /= 64;
  }
  ++used_;
  if (slot >= end_) end_ = slot + 1;
  return slot;
}

void SlotPool::give(uint32_t slot) {
  size_t index = slot;
  for (auto& level : free_) {
    level[index / 64] |= uint64_t{1} << (index % 64);
    index /= 64;
  }
  --used_;
  while (end_ > 0 && !taken(end_ - 1)) --end_;
}

Drops::Drops(uint32_t capacity)
    : slots_(capacity), records_(capacity), places_(capacity), heads_(kBuckets, kNone) {
  constexpr size_t kCells = 1u << 14;  // two views' worth: more make the bunches grow
  bunches_.reserve(capacity / Bunch::kMost + kCells);
  free_bunches_.reserve(bunches_.capacity());
  changed_.reserve(capacity);
}

uint32_t Drops::newBunch(uint32_t next) {
  if (free_bunches_.empty()) {
    bunches_.emplace_back();
    free_bunches_.push_back(static_cast<uint32_t>(bunches_.size() - 1));
  }
  const uint32_t bunch = free_bunches_.back();
  free_bunches_.pop_back();
  bunches_[bunch].count = 0;
  bunches_[bunch].next = next;
  return bunch;
}

void Drops::freeBunch(uint32_t bunch, uint32_t& first) {
  if (bunch == first) {
    first = bunches_[bunch].next;
  } else {
    uint32_t before = first;
    while (bunches_[before].next != bunch) before = bunches_[before].next;
    bunches_[before].next = bunches_[bunch].next;
  }
  free_bunches_.push_back(bunch);
}

void Drops::touch(uint32_t slot) {
  if (places_[slot].changed != 0) return;
  places_[slot].changed = 1;
  changed_.push_back(slot);
}

void Drops::clearChanged() {
  for (const uint32_t slot : changed_) places_[slot].changed = 0;
  changed_.clear();
}

void Drops::schedule(uint32_t slot, uint32_t now) {
  // Ends fall within a tick: the bucket is of the first tick at or after the end, so that by then it has
  // come.
  const uint32_t ahead = std::clamp((records_[slot].end - now + kTick - 1) / kTick, 1u, kBuckets - 1);
  const uint32_t day = (now / kTick + ahead) % kBuckets;
  places_[slot].day = day;
  places_[slot].on_day = {heads_[day], kNone};
  if (heads_[day] != kNone) places_[heads_[day]].on_day.before = slot;
  heads_[day] = slot;
}

void Drops::unschedule(uint32_t slot) {
  const uint32_t day = places_[slot].day;
  if (day == kNone) return;
  const Link link = places_[slot].on_day;
  if (link.before != kNone)
    places_[link.before].on_day.next = link.next;
  else
    heads_[day] = link.next;
  if (link.next != kNone) places_[link.next].on_day.before = link.before;
  places_[slot].day = kNone;
}

uint32_t Drops::add(const shared::RainDrop& drop, float chance, uint32_t cell, uint32_t& bunch, bool ends,
                    uint32_t now) {
  const uint32_t slot = slots_.take();
  if (slot == kNone) return kNone;
  if (bunch == kNone || bunches_[bunch].count == Bunch::kMost) bunch = newBunch(bunch);
  records_[slot] = drop;
  ++live_of_[shared::rainClassOf(drop)];
  Place& place = places_[slot];
  place.cell = cell;
  place.bunch = bunch;
  place.in_bunch = bunches_[bunch].count;
  place.chance = chance;
  bunches_[bunch].slots[bunches_[bunch].count++] = slot;
  if (ends) schedule(slot, now);
  touch(slot);
  return slot;
}

// Once it is in no bunch.
void Drops::empty(uint32_t slot) {
  unschedule(slot);
  --live_of_[shared::rainClassOf(records_[slot])];
  records_[slot].diameter_m = 0.0f;
  places_[slot].cell = kNone;
  slots_.give(slot);
  touch(slot);
}

void Drops::remove(uint32_t slot, uint32_t& first) {
  Bunch& bunch = bunches_[places_[slot].bunch];
  const uint32_t last = bunch.slots[--bunch.count];
  bunch.slots[places_[slot].in_bunch] = last;
  places_[last].in_bunch = places_[slot].in_bunch;
  if (bunch.count == 0) freeBunch(places_[slot].bunch, first);
  empty(slot);
}

void Drops::fetchDrops(uint32_t bunch) const {
  if (bunch == kNone) return;
  fetch(bunches_[bunch].next);
  for (uint32_t i = 0; i < bunches_[bunch].count; ++i) {
    __builtin_prefetch(&places_[bunches_[bunch].slots[i]], 1);
    __builtin_prefetch(&records_[bunches_[bunch].slots[i]], 1);
  }
}

void Drops::removeAll(uint32_t& first) {
  for (; first != kNone; freeBunch(first, first)) {
    const Bunch& bunch = bunches_[first];
    fetchDrops(bunch.next);
    for (uint32_t i = 0; i < bunch.count; ++i) empty(bunch.slots[i]);
  }
}

void Drops::setEnd(uint32_t slot, uint32_t end, bool ends, uint32_t now) {
  unschedule(slot);
  records_[slot].end = end;
  if (ends) schedule(slot, now);
  touch(slot);
}

void Drops::clear() {
  slots_.clear();
  live_of_.fill(0);
  for (uint32_t slot = 0; slot < capacity(); ++slot) {
    if (records_[slot].diameter_m > 0.0f) touch(slot);
    records_[slot].diameter_m = 0.0f;
    places_[slot].cell = places_[slot].day = kNone;
  }
  heads_.assign(kBuckets, kNone);
  bunches_.clear();
  free_bunches_.clear();
}

}  // namespace rg::rain
