// The fixed buffer of live drops: slots, the lists they hang in, and when they end.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "rain/calendar.h"
#include "rain/cells.h"
#include "rain/fetch.h"
#include "saved/archive.h"
#include "shared/rain_streak.glsl"

namespace rg::rain {

// Free slots of a fixed buffer. The lowest goes first, so that the live ones stay together and drawing need
// not look far.
class SlotPool {
 public:
  explicit SlotPool(uint32_t capacity);
  // Takes up to `count`: calls word(at, bits) for each 64 slots of which some are taken, then each(slot) for
  // those. Returns how many there were.
  template <class F, class W>
  uint32_t take(uint32_t count, F&& each, W&& word) {
    count = std::min(count, capacity_ - used_);
    used_ += count;
    for (uint32_t left = count; left > 0;) {
      if (free_[0][lowest_] == 0) findLowest();
      const size_t at = lowest_;
      uint64_t rest = free_[0][at], bits = rest;
      for (; rest != 0 && left > 0; rest &= rest - 1) --left;
      bits &= ~rest;
      takeOf(at, bits);
      word(at, bits);
      for (; bits != 0; bits &= bits - 1)
        each(static_cast<uint32_t>(at * 64) + static_cast<uint32_t>(std::countr_zero(bits)));
    }
    return count;
  }
  // Gives back `count` of the 64 slots `at`, a bit for each.
  void give(size_t at, uint64_t bits, uint32_t count);
  void give(uint32_t slot) { give(slot / 64, uint64_t{1} << (slot % 64), 1); }
  void clear();
  void takeThis(uint32_t slot);  // which is free
  // Calls each(slot) for the next that will be taken, some `count` of them.
  template <class F>
  void forNext(size_t count, F&& each) const {
    for (size_t word = lowest_; word < free_[0].size(); ++word) {
      for (uint64_t bits = free_[0][word]; bits != 0; bits &= bits - 1) {
        if (count-- == 0) return;
        each(static_cast<uint32_t>(word * 64) + static_cast<uint32_t>(std::countr_zero(bits)));
      }
    }
  }
  uint32_t used() const { return used_; }
  uint32_t end() const { return end_; }  // all taken slots lie below
  bool taken(uint32_t slot) const { return (free_[0][slot / 64] >> (slot % 64) & 1u) == 0; }
  uint64_t freeOf(size_t at) const { return free_[0][at]; }  // of the 64 slots, a bit for each

 private:
  static constexpr int kLevels =
      4;  // a bit for each slot; above, a bit for each word that has a free one: 64^4 slots
  void findLowest();
  void takeOf(size_t at, uint64_t bits);

  std::vector<uint64_t> free_[kLevels];
  size_t lowest_ = 0;  // no word of slots before it has a free one
  uint32_t capacity_, used_ = 0, end_ = 0;
};

// Drops by slot, each in a bunch of its cell's, and in the calendar when it has an end. A cell's drops are
// born and die together: bunches say at once where all of them are. What hangs on a drop is kept so that one
// that dies with its cell is not looked at, and one that is born is only written.
class Drops {
 public:
  explicit Drops(uint32_t capacity);

  struct End {
    uint32_t at = 0;     // as RainDrop.end
    bool comes = false;  // false: not before the drop is out of sight
  };
  // Adds up to `count` drops of a class to a cell. `now`: in 1/1024 tick, modulo 2^32, as RainDrop.end.
  // `bunch`: the cell's first, kNone when it is empty. write(i, drop, chance) fills in the i-th drop and its
  // chance, as Candidates', and returns its End. Returns how many found room.
  template <class F>
  uint32_t add(uint32_t count, uint32_t kind, uint32_t cell, uint32_t& bunch, uint32_t now, F&& write) {
    uint32_t added = 0;
    pool_.take(
        count,
        [&](uint32_t slot) {
          if (bunch == kNone || bunches_[bunch].count == Bunch::kMost) bunch = newBunch(bunch);
          bunches_[bunch].slots[bunches_[bunch].count++] = slot;
          Slot& born = slots_[slot];
          const End end = write(added++, born.drop, born.chance);
          born.drop.end = end.at;
          born.cell = cell;
          born.bunch = bunch;
          born.entry = kNoEntry;
          if (end.comes) schedule(slot, now);
        },
        [&](size_t at, uint64_t bits) { touch(at, bits); });
    live_of_[kind] += added;
    return added;
  }
  void remove(uint32_t slot, uint32_t& bunch);
  void removeAll(uint32_t& bunch, uint32_t kind);  // all are of one class
  // To the cache, as they will be wanted soon: room for so many drops, and a bunch.
  void fetchRoom(size_t count) const {
    pool_.forNext(count, [this](uint32_t slot) { fetchToWrite(&slots_[slot]); });
  }
  void fetch(uint32_t bunch) const {
    if (bunch != kNone) fetchToRead(&bunches_[bunch]);
  }
  // Calls each(slot) for the cell's drops; it may remove that one.
  template <class F>
  void forEach(uint32_t bunch, F&& each) {
    while (bunch != kNone) {
      const uint32_t next = bunches_[bunch].next;
      for (uint32_t i = bunches_[bunch].count; i-- > 0;) each(bunches_[bunch].slots[i]);
      bunch = next;
    }
  }
  void setEnd(uint32_t slot, const End& end, uint32_t now);
  void clear();  // without telling the GPU slot by slot: publish all afterwards

  // Calls expired(slot) for each drop whose end has come; it must remove it. Call for every tick.
  template <class F>
  void expire(uint32_t now, F&& expired) {
    calendar_.turnTo(
        now, [&](const Calendar::Entry& entry) { fetchToWrite(&slots_[entry.slot]); },
        [&](const Calendar::Entry& entry) {
          if (!isRight(entry)) return;
          if (static_cast<int32_t>(slots_[entry.slot].drop.end - now) > 0) {
            schedule(entry.slot, now);
          } else {
            fetch(slots_[entry.slot].bunch);
            due_.push_back(entry.slot);
          }
        });
    for (const uint32_t slot : due_) expired(slot);
    due_.clear();
  }
  void startCalendar(uint32_t now) { calendar_.start(now); }

  // A cell's drops, as they lie in its bunches. What is read goes into slots that are free; scheduleAll()
  // when all are there.
  void write(saved::Writer& a, uint32_t bunch) const;
  void read(saved::Reader& a, uint32_t kind, uint32_t cell, uint32_t& bunch);
  void scheduleAll(uint32_t now);

  // What a slot holds that is alive; else what it held.
  const shared::RainDrop& operator[](uint32_t slot) const { return slots_[slot].drop; }
  bool ends(uint32_t slot) const { return slots_[slot].entry != kNoEntry; }
  float chanceOf(uint32_t slot) const { return slots_[slot].chance; }
  uint32_t cellOf(uint32_t slot) const { return slots_[slot].cell; }
  bool alive(uint32_t slot) const { return pool_.taken(slot); }
  uint32_t live() const { return pool_.used(); }
  uint32_t liveOf(uint32_t kind) const { return live_of_[kind]; }
  uint32_t end() const { return pool_.end(); }
  uint32_t capacity() const { return static_cast<uint32_t>(slots_.size()); }

  // How many slots were written or emptied since they were last taken.
  uint32_t changed() const { return changes_; }
  // Calls each(slot, record) for them, ascending; an empty slot's record is an empty one.
  template <class F>
  void takeChanged(F&& each) {
    static constexpr shared::RainDrop kNothing{};
    for (size_t at = 0; changes_ > 0; ++at) {
      const uint64_t free = pool_.freeOf(at);
      for (uint64_t bits = std::exchange(changed_[at], 0); bits != 0; bits &= bits - 1, --changes_) {
        const auto bit = static_cast<uint32_t>(std::countr_zero(bits));
        const uint32_t slot = static_cast<uint32_t>(at * 64) + bit;
        each(slot, *((free >> bit & 1u) != 0 ? &kNothing : &slots_[slot].drop));
      }
    }
  }

 private:
  struct alignas(64) Bunch {
    static constexpr uint32_t kMost = 14;
    std::array<uint32_t, kMost> slots{};
    uint32_t count = 0, next = kNone;
  };
  static constexpr uint32_t kNoEntry = 0, kToBeScheduled = 1;
  // A drop, where it hangs, and the number of its entry in the calendar: a line of the cache.
  struct alignas(64) Slot {
    shared::RainDrop drop{};
    uint32_t cell = kNone, bunch = kNone, entry = kNoEntry;
    float chance = 0.0f;
  };

  bool isRight(const Calendar::Entry& entry) const {
    return alive(entry.slot) && slots_[entry.slot].entry == entry.number;
  }
  uint32_t newBunch(uint32_t next);
  void freeBunch(uint32_t bunch, uint32_t& first);
  void schedule(uint32_t slot, uint32_t now);
  void touch(size_t at, uint64_t bits);
  void touch(uint32_t slot) { touch(slot / 64, uint64_t{1} << (slot % 64)); }

  SlotPool pool_;
  std::vector<Slot> slots_;
  std::vector<Bunch> bunches_;
  std::vector<uint32_t> free_bunches_;
  Calendar calendar_;
  std::vector<uint32_t> due_;      // in this tick
  std::vector<uint64_t> changed_;  // a bit for each slot
  uint32_t changes_ = 0;           // bits set
  std::array<uint32_t, shared::kRainClasses> live_of_{};
};

}  // namespace rg::rain
