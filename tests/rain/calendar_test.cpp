// The calendar of ends against a plain list, through turns of it, ends beyond it and clearings up.
#include "rain/calendar.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace rg::rain {
namespace {

constexpr uint32_t kTick = 1024;

// `slots` drops that end, are told another end, or go before it, at random for `ticks`; ends up to
// `most_ticks` ahead. Each end must come at the first tick at or after it, and no other.
void run(uint32_t slots, int ticks, uint32_t most_ticks, double change) {
  struct Wanted {
    uint32_t end = 0, number = 0;
  };
  Calendar calendar(slots);
  std::map<uint32_t, Wanted> wanted;  // by slot
  std::mt19937 random(slots);
  uint32_t now = 0u - 700u * kTick;  // through the counter's turn
  calendar.start(now);
  const auto isRight = [&](const Calendar::Entry& entry) {
    const auto found = wanted.find(entry.slot);
    return found != wanted.end() && found->second.number == entry.number;
  };
  const auto write = [&](uint32_t slot, uint32_t end) {
    wanted[slot] = {end, calendar.write(slot, end, now, isRight)};
  };
  uint64_t ended = 0;
  for (int tick = 0; tick < ticks; ++tick) {
    now += kTick;
    calendar.turnTo(
        now, [](const Calendar::Entry&) {},
        [&](const Calendar::Entry& entry) {
          if (!isRight(entry)) return;
          const uint32_t end = wanted[entry.slot].end;
          if (static_cast<int32_t>(end - now) > 0) {
            write(entry.slot, end);
          } else {
            ASSERT_LT(now - end, kTick);
            wanted.erase(entry.slot);
            ++ended;
          }
        });
    for (const auto& [slot, w] : wanted) ASSERT_GT(static_cast<int32_t>(w.end - now), 0) << "never came";
    for (int i = 0; i < static_cast<int>(change * slots); ++i) {
      const uint32_t slot = static_cast<uint32_t>(random() % slots);
      if (random() % 3 == 0)
        wanted.erase(slot);
      else
        write(slot, now + 1 + static_cast<uint32_t>(random() % (most_ticks * kTick)));
    }
  }
  // Where all is told anew about once a tick, few live to their end: 2/3 of the slots are written in a tick,
  // and of each entry 1 / most_ticks comes in its time. 80 in the last of the tests below, whose error is 9.
  EXPECT_GT(ended, 50u);
}

TEST(Calendar, bringsEachEndAtItsTick) { run(50, 3000, 40, 0.05); }
TEST(Calendar, keepsEndsThatLieBeyondIt) { run(200, 9000, 6000, 0.005); }
// Nearly all that is written is soon wrong, so that it must be cleared up again and again.
TEST(Calendar, hasRoomForWhatIsToldAnewAllTheTime) { run(800, 300, 2000, 1.0); }

}  // namespace
}  // namespace rg::rain
