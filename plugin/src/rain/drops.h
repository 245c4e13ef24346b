// The fixed buffer of live drops: slots, the lists they hang in, and when they end.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rain/cells.h"
#include "shared/rain_streak.glsl"

namespace rg::rain {

// Free slots of a fixed buffer. The lowest goes first, so that the live ones stay together and drawing need
// not look far.
class SlotPool {
 public:
  explicit SlotPool(uint32_t capacity);
  uint32_t take();  // kNone when all are taken
  void give(uint32_t slot);
  void clear();
  uint32_t used() const { return used_; }
  uint32_t end() const { return end_; }  // all taken slots lie below
  bool taken(uint32_t slot) const;

 private:
  static constexpr int kLevels =
      4;  // a bit for each slot; above, a bit for each word that has a free one: 64^4 slots
  std::vector<uint64_t> free_[kLevels];
  uint32_t capacity_, used_ = 0, end_ = 0;
};

// Drops by slot, each in a bunch of its cell's, and in the calendar when it has an end. A cell's drops are
// born and die together: bunches say at once where all of them are.
class Drops {
 public:
  explicit Drops(uint32_t capacity);

  // `now` and ends: in 1/1024 tick, modulo 2^32, as RainDrop.end. `chance`: as Candidate's. `bunch`: the
  // cell's first, kNone when it is empty. kNone when full.
  uint32_t add(const shared::RainDrop& drop, float chance, uint32_t cell, uint32_t& bunch, bool ends,
               uint32_t now);
  void remove(uint32_t slot, uint32_t& bunch);
  void removeAll(uint32_t& bunch);
  // To the cache, as they will be wanted soon: the bunch, and then, when it is there, its drops.
  void fetch(uint32_t bunch) const {
    if (bunch != kNone) __builtin_prefetch(&bunches_[bunch]);
  }
  void fetchDrops(uint32_t bunch) const;
  // Calls each(slot) for the cell's drops; it may remove that one.
  template <class F>
  void forEach(uint32_t bunch, F&& each) {
    while (bunch != kNone) {
      const uint32_t next = bunches_[bunch].next;
      for (uint32_t i = bunches_[bunch].count; i-- > 0;) each(bunches_[bunch].slots[i]);
      bunch = next;
    }
  }
  void setEnd(uint32_t slot, uint32_t end, bool ends, uint32_t now);
  void clear();  // without telling the GPU slot by slot: publish all afterwards

  // Calls expired(slot) for each drop whose end has come; it must remove it. Call for every tick.
  template <class F>
  void expire(uint32_t now, F&& expired) {
    while (static_cast<int32_t>(now - expired_to_) >= static_cast<int32_t>(kTick)) {
      expired_to_ += kTick;
      expireBucket(expired_to_ / kTick, now, expired);
    }
  }
  void startCalendar(uint32_t now) { expired_to_ = now; }

  const shared::RainDrop& operator[](uint32_t slot) const { return records_[slot]; }
  bool ends(uint32_t slot) const { return places_[slot].day != kNone; }
  float chanceOf(uint32_t slot) const { return places_[slot].chance; }
  uint32_t cellOf(uint32_t slot) const { return places_[slot].cell; }
  bool alive(uint32_t slot) const { return slots_.taken(slot); }
  uint32_t live() const { return slots_.used(); }
  uint32_t liveOf(uint32_t kind) const { return live_of_[kind]; }
  uint32_t end() const { return slots_.end(); }
  uint32_t capacity() const { return static_cast<uint32_t>(records_.size()); }

  // Slots written or emptied since the last call of clearChanged, in that order, each once.
  const std::vector<uint32_t>& changed() const { return changed_; }
  void clearChanged();

 private:
  struct Link {
    uint32_t next = kNone, before = kNone;
  };
  struct alignas(64) Bunch {
    static constexpr uint32_t kMost = 14;
    std::array<uint32_t, kMost> slots{};
    uint32_t count = 0, next = kNone;
  };
  // Where a drop hangs: half a line of the cache, as all of it is wanted at once.
  struct alignas(32) Place {
    uint32_t cell = kNone, bunch = kNone, in_bunch = 0;
    uint32_t day = kNone;
    Link on_day;
    float chance = 0.0f;
    uint32_t changed = 0;
  };
  static constexpr uint32_t kTick = 1024;
  static constexpr uint32_t kBuckets = 2048;  // ticks ahead: 17 s

  uint32_t newBunch(uint32_t next);
  void freeBunch(uint32_t bunch, uint32_t& first);
  void schedule(uint32_t slot, uint32_t now);
  void unschedule(uint32_t slot);
  void touch(uint32_t slot);
  void empty(uint32_t slot);

  template <class F>
  void expireBucket(uint32_t tick, uint32_t now, F& expired) {
    uint32_t slot = heads_[tick % kBuckets];
    while (slot != kNone) {
      const uint32_t next = places_[slot].on_day.next;
      if (static_cast<int32_t>(records_[slot].end - now) <= 0) {
        expired(slot);
      } else {  // it was beyond the calendar when it was written in
        unschedule(slot);
        schedule(slot, now);
      }
      slot = next;
    }
  }

  SlotPool slots_;
  std::vector<shared::RainDrop> records_;
  std::vector<Place> places_;
  std::vector<Bunch> bunches_;
  std::vector<uint32_t> free_bunches_;
  std::vector<uint32_t> heads_;  // of the calendar's days
  std::vector<uint32_t> changed_;
  uint32_t expired_to_ = 0;
  std::array<uint32_t, shared::kRainClasses> live_of_{};
};

}  // namespace rg::rain
