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
    : slots_(capacity),
      records_(capacity),
      in_cell_(capacity),
      on_day_(capacity),
      cell_(capacity, kNone),
      bucket_(capacity, kNone),
      heads_(kBuckets, kNone),
      is_changed_(capacity, false) {
  changed_.reserve(capacity);
}

void Drops::link(std::vector<Link>& links, uint32_t& head, uint32_t slot) {
  links[slot] = {head, kNone};
  if (head != kNone) links[head].before = slot;
  head = slot;
}

void Drops::unlink(std::vector<Link>& links, uint32_t& head, uint32_t slot) {
  const Link link = links[slot];
  if (link.before != kNone)
    links[link.before].next = link.next;
  else
    head = link.next;
  if (link.next != kNone) links[link.next].before = link.before;
}

void Drops::touch(uint32_t slot) {
  if (is_changed_[slot]) return;
  is_changed_[slot] = true;
  changed_.push_back(slot);
}

void Drops::clearChanged() {
  for (const uint32_t slot : changed_) is_changed_[slot] = false;
  changed_.clear();
}

void Drops::schedule(uint32_t slot, uint32_t now) {
  // Ends fall within a tick: the bucket is of the first tick at or after the end, so that by then it has
  // come.
  const uint32_t ahead = std::clamp((records_[slot].end - now + kTick - 1) / kTick, 1u, kBuckets - 1);
  const uint32_t day = (now / kTick + ahead) % kBuckets;
  bucket_[slot] = day;
  link(on_day_, heads_[day], slot);
}

void Drops::unschedule(uint32_t slot) {
  if (bucket_[slot] == kNone) return;
  unlink(on_day_, heads_[bucket_[slot]], slot);
  bucket_[slot] = kNone;
}

uint32_t Drops::add(const shared::RainDrop& drop, uint32_t cell, uint32_t& first_of_cell, bool ends,
                    uint32_t now) {
  const uint32_t slot = slots_.take();
  if (slot == kNone) return kNone;
  records_[slot] = drop;
  ++live_of_[shared::rainClassOf(drop)];
  cell_[slot] = cell;
  link(in_cell_, first_of_cell, slot);
  if (ends) schedule(slot, now);
  touch(slot);
  return slot;
}

void Drops::remove(uint32_t slot, uint32_t& first_of_cell) {
  unschedule(slot);
  unlink(in_cell_, first_of_cell, slot);
  records_[slot].diameter_m = 0.0f;
  --live_of_[shared::rainClassOf(records_[slot])];
  cell_[slot] = kNone;
  slots_.give(slot);
  touch(slot);
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
    cell_[slot] = bucket_[slot] = kNone;
  }
  heads_.assign(kBuckets, kNone);
}

}  // namespace rg::rain
