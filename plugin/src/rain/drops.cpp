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
  lowest_ = 0;
  size_t bits = capacity_;
  for (auto& level : free_) {
    for (size_t i = 0; i < level.size(); ++i) {
      const size_t left = bits - i * 64;
      level[i] = left >= 64 ? ~uint64_t{0} : (uint64_t{1} << left) - 1;
    }
    bits = level.size();
  }
}

uint32_t SlotPool::take() {
  if (used_ == capacity_) return kNone;
  if (free_[0][lowest_] == 0) {
    lowest_ = 0;
    for (int level = kLevels - 1; level > 0; --level)
      lowest_ = lowest_ * 64 + static_cast<size_t>(std::countr_zero(free_[level][lowest_]));
  }
  size_t index = lowest_ * 64 + static_cast<size_t>(std::countr_zero(free_[0][lowest_]));
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
  lowest_ = std::min(lowest_, index / 64);
  for (auto& level : free_) {
    const uint64_t before = level[index / 64];
    level[index / 64] |= uint64_t{1} << (index % 64);
    if (before != 0) break;  // it is known above
    index /= 64;
  }
  --used_;
  while (end_ > 0 && !taken(end_ - 1)) --end_;
}

Drops::Drops(uint32_t capacity)
    : pool_(capacity), slots_(capacity), calendar_(capacity), changed_((size_t{capacity} + 63) / 64) {
  constexpr size_t kCells = 1u << 14;  // two views' worth: more make the bunches grow
  bunches_.reserve(capacity / Bunch::kMost + kCells);
  free_bunches_.reserve(bunches_.capacity());
  due_.reserve(capacity);
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
  uint64_t& word = changed_[slot / 64];
  const uint64_t bit = uint64_t{1} << (slot % 64);
  changes_ += (word & bit) == 0 ? 1u : 0u;
  word |= bit;
}

void Drops::schedule(uint32_t slot, uint32_t now) {
  slots_[slot].entry = calendar_.write(slot, slots_[slot].drop.end, now,
                                       [this](const Calendar::Entry& entry) { return isRight(entry); });
}

uint32_t Drops::add(const shared::RainDrop& drop, const End& end, float chance, uint32_t cell,
                    uint32_t& bunch, uint32_t now) {
  const uint32_t slot = pool_.take();
  if (slot == kNone) return kNone;
  if (bunch == kNone || bunches_[bunch].count == Bunch::kMost) bunch = newBunch(bunch);
  Slot& born = slots_[slot];
  born.drop = drop;
  born.drop.end = end.at;
  born.cell = cell;
  born.bunch = bunch;
  born.entry = kNoEntry;
  born.chance = chance;
  ++live_of_[shared::rainClassOf(drop)];
  bunches_[bunch].slots[bunches_[bunch].count++] = slot;
  if (end.comes) schedule(slot, now);
  touch(slot);
  return slot;
}

void Drops::remove(uint32_t slot, uint32_t& first) {
  Bunch& bunch = bunches_[slots_[slot].bunch];
  uint32_t at = 0;
  while (bunch.slots[at] != slot) ++at;
  bunch.slots[at] = bunch.slots[--bunch.count];
  if (bunch.count == 0) freeBunch(slots_[slot].bunch, first);
  --live_of_[shared::rainClassOf(slots_[slot].drop)];
  pool_.give(slot);
  touch(slot);
}

void Drops::removeAll(uint32_t& first, uint32_t kind) {
  for (; first != kNone; freeBunch(first, first)) {
    const Bunch& bunch = bunches_[first];
    fetch(bunch.next);
    for (uint32_t i = 0; i < bunch.count; ++i) {
      pool_.give(bunch.slots[i]);
      touch(bunch.slots[i]);
    }
    live_of_[kind] -= bunch.count;
  }
}

void Drops::setEnd(uint32_t slot, const End& end, uint32_t now) {
  slots_[slot].drop.end = end.at;
  slots_[slot].entry = kNoEntry;
  if (end.comes) schedule(slot, now);
  touch(slot);
}

void Drops::clear() {
  for (uint32_t slot = 0; slot < pool_.end(); ++slot) {
    if (alive(slot)) touch(slot);
  }
  pool_.clear();
  live_of_.fill(0);
  bunches_.clear();
  free_bunches_.clear();
}

}  // namespace rg::rain
