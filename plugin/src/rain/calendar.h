// When which drop ends: a calendar queue (Brown 1988) of slots by tick. What is written in stays until its
// day or a clearing up: drops that are gone by then cost nothing when they go. Whoever asks tells which
// entries are still right, by the number that each got when it was written.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "rain/cells.h"

namespace rg::rain {

class Calendar {
 public:
  struct Entry {
    uint32_t slot = 0, number = 0;
  };

  // Of so many drops, each of which has one right entry at most.
  explicit Calendar(uint32_t capacity);
  void start(uint32_t now);  // empty

  // Times are in 1/1024 tick, modulo 2^32, as RainDrop.end. Returns the number, never 0. `isRight(entry)` is
  // asked when there is no room: what is no longer right is thrown out.
  template <class F>
  uint32_t write(uint32_t slot, uint32_t end, uint32_t now, F&& isRight) {
    if (free_ == kNone) clearUp(isRight);
    // Ends fall within a tick: the day is the first tick at or after the end, so that by then it has come.
    const uint32_t ahead = std::clamp((end - now + kTick - 1) / kTick, 1u, kDays - 1);
    written_ = std::max(written_ + 1, 1u);
    const Entry entry{slot, written_};
    put((now / kTick + ahead) % kDays, entry);
    return entry.number;
  }

  // Calls come(entry) for each entry whose day has come, also those that are no longer right, and those that
  // lay beyond the calendar when they were written in, whose end is still to come; and soon(entry) a few
  // entries before it does. Call for every tick.
  template <class S, class F>
  void turnTo(uint32_t now, S&& soon, F&& come) {
    while (static_cast<int32_t>(now - turned_to_) >= static_cast<int32_t>(kTick)) {
      turned_to_ += kTick;
      takeOut(days_[turned_to_ / kTick % kDays], soon, come);
    }
  }

 private:
  static constexpr uint32_t kTick = 1024;
  static constexpr uint32_t kDays = 2048;  // ticks ahead: 17 s
  struct alignas(64) Page {                // a line of the cache
    static constexpr uint32_t kMost = 7;
    std::array<Entry, kMost> entries;
    uint32_t count = 0, next = kNone;
  };

  void put(uint32_t day, Entry entry) {
    uint32_t& first = days_[day];
    if (first == kNone || pages_[first].count == Page::kMost) {
      const uint32_t page = free_;
      free_ = pages_[page].next;
      pages_[page].count = 0;
      pages_[page].next = first;
      first = page;
    }
    Page& page = pages_[first];
    page.entries[page.count++] = entry;
  }

  template <class F>
  void forEntries(uint32_t page, F&& each) const {
    if (page == kNone) return;
    for (uint32_t i = 0; i < pages_[page].count; ++i) each(pages_[page].entries[i]);
  }

  // What is put in meanwhile, on the same day a turn later too, is not met.
  template <class S, class F>
  void takeOut(uint32_t& day, S&& soon, F&& each) {
    uint32_t page = day;
    day = kNone;
    forEntries(page, soon);
    while (page != kNone) {
      const Page taken = pages_[page];
      pages_[page].next = free_;
      free_ = page;
      page = taken.next;
      forEntries(page, soon);
      for (uint32_t i = 0; i < taken.count; ++i) each(taken.entries[i]);
    }
  }

  template <class F>
  void clearUp(F&& isRight) {
    for (uint32_t day = 0; day < kDays; ++day) {
      takeOut(
          days_[day], [](const Entry&) {},
          [&](const Entry& entry) {
            if (isRight(entry)) put(day, entry);
          });
    }
  }

  std::vector<Page> pages_;
  std::array<uint32_t, kDays> days_{};  // first pages
  uint32_t free_ = kNone;               // pages
  uint32_t turned_to_ = 0, written_ = 0;
};

}  // namespace rg::rain
