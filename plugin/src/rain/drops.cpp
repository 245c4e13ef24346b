#include "rain/drops.h"

#include <algorithm>
#include <bit>

namespace rg::rain {

using shared::RainDrop;

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

void SlotPool::findLowest() {
  lowest_ = 0;
  for (int level = kLevels - 1; level > 0; --level)
    lowest_ = lowest_ * 64 + static_cast<size_t>(std::countr_zero(free_[level][lowest_]));
}

void SlotPool::takeOf(size_t at, uint64_t bits) {
  const auto last = static_cast<uint32_t>(at * 64) + static_cast<uint32_t>(std::bit_width(bits));
  end_ = std::max(end_, last);
  free_[0][at] &= ~bits;
  for (int level = 1; level < kLevels && free_[level - 1][at] == 0; ++level, at /= 64)
    free_[level][at / 64] &= ~(uint64_t{1} << (at % 64));
}

void SlotPool::takeThis(uint32_t slot) {
  takeOf(slot / 64, uint64_t{1} << (slot % 64));
  ++used_;
}

void SlotPool::give(size_t at, uint64_t bits, uint32_t count) {
  lowest_ = std::min(lowest_, at);
  used_ -= count;
  bool was_known = free_[0][at] != 0;  // above
  free_[0][at] |= bits;
  for (int level = 1; level < kLevels && !was_known; ++level, at /= 64) {
    was_known = free_[level][at / 64] != 0;
    free_[level][at / 64] |= uint64_t{1} << (at % 64);
  }
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

void Drops::touch(size_t at, uint64_t bits) {
  uint64_t fresh = bits & ~changed_[at];
  changed_[at] |= bits;
  for (; fresh != 0; fresh &= fresh - 1) ++changes_;
}

void Drops::schedule(uint32_t slot, uint32_t now) {
  slots_[slot].entry = calendar_.write(slot, slots_[slot].drop.end, now,
                                       [this](const Calendar::Entry& entry) { return isRight(entry); });
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

// Drops that were born together mostly lie together: their slots are given back as many at once as share a
// word.
void Drops::removeAll(uint32_t& first, uint32_t kind) {
  for (; first != kNone; freeBunch(first, first)) {
    const Bunch& bunch = bunches_[first];
    fetch(bunch.next);
    for (uint32_t i = 0; i < bunch.count;) {
      const size_t at = bunch.slots[i] / 64;
      const uint32_t begin = i;
      uint64_t bits = 0;
      for (; i < bunch.count && bunch.slots[i] / 64 == at; ++i) bits |= uint64_t{1} << (bunch.slots[i] % 64);
      pool_.give(at, bits, i - begin);
      touch(at, bits);
    }
    live_of_[kind] -= bunch.count;
  }
}

namespace {
void visitRecord(auto& a, auto& drop) {
  a(drop.cell_x, drop.cell_y, drop.cell_z, drop.fraction_xy, drop.fraction_z_class, drop.end);
  a.within(drop.diameter_m, 0.0, 0.2);
  a(drop.id);
}
}  // namespace

void Drops::write(saved::Writer& a, uint32_t bunch) const {
  uint32_t count = 0;
  for (uint32_t b = bunch; b != kNone; b = bunches_[b].next) count += bunches_[b].count;
  a(count);
  for (; bunch != kNone; bunch = bunches_[bunch].next) {
    for (uint32_t i = 0; i < bunches_[bunch].count; ++i) {
      const uint32_t slot = bunches_[bunch].slots[i];
      const bool comes = ends(slot);
      a(slot, slots_[slot].chance, comes);
      visitRecord(a, slots_[slot].drop);
    }
  }
}

void Drops::read(saved::Reader& a, uint32_t kind, uint32_t cell, uint32_t& bunch) {
  uint32_t count = 0;
  a.within(count, 0u, capacity() - pool_.used());
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t slot = 0;
    float chance = 0.0f;
    bool comes = false;
    RainDrop drop{};
    a.within(slot, 0u, capacity() - 1);
    a.within(chance, 0.0, 2.0);
    a(comes);
    visitRecord(a, drop);
    a.require(!alive(slot), "two drops are in one slot");
    a.require(shared::rainClassOf(drop) == kind, "a drop is of another class than its cell");
    pool_.takeThis(slot);
    touch(slot);
    if (bunch == kNone || bunches_[bunch].count == Bunch::kMost) bunch = newBunch(bunch);
    bunches_[bunch].slots[bunches_[bunch].count++] = slot;
    slots_[slot] = {drop, cell, bunch, comes ? kToBeScheduled : kNoEntry, chance};
    ++live_of_[kind];
  }
}

void Drops::scheduleAll(uint32_t now) {
  calendar_.start(now);
  for (uint32_t slot = 0; slot < end(); ++slot) {
    if (alive(slot) && ends(slot)) schedule(slot, now);
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
