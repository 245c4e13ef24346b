#include "schedule.h"

#include <cmath>
#include <cstdio>
#include <map>

namespace host {
namespace {

std::string shotName(double time_s) {
  char name[64];
  std::snprintf(name, sizeof name, "shot_%.2f.png", time_s);
  return name;
}

int64_t toNs(double seconds) { return static_cast<int64_t>(std::llround(seconds * 1e9)); }

// Between 2 and 45 ms, never alike: Knuth's MMIX generator, upper bits.
int64_t irregularStep(uint64_t& state) {
  state = state * 6364136223846793005ULL + 1442695040888963407ULL;
  return 2'000'000 + static_cast<int64_t>((state >> 33) % 43'000'000);
}

}  // namespace

std::vector<Event> schedule(const Options& options, double seconds) {
  std::map<int64_t, Event> events;
  const int64_t end_ns = toNs(seconds);
  const auto at = [&](int64_t time_ns) -> Event& {
    Event& e = events[time_ns];
    e.time_ns = time_ns;
    return e;
  };
  const bool own_updates = options.update_hz == 0.0 && !options.irregular_updates;
  const bool all_frames = !options.video.empty() || !options.budget.empty() || options.shots_s.empty();
  for (int64_t k = 0;; ++k) {
    const int64_t t = toNs(static_cast<double>(k) / options.fps);
    if (t > end_ns) break;
    if (all_frames) at(t).draw = true;
    if (own_updates) at(t).update = true;
  }
  for (const double shot_s : options.shots_s) {
    if (toNs(shot_s) > end_ns) continue;
    at(toNs(shot_s)).draw = true;
    at(toNs(shot_s)).shot = shotName(shot_s);
    if (own_updates) at(toNs(shot_s)).update = true;
  }
  uint64_t random = 1;
  for (int64_t k = 1, t = 0; !own_updates && t <= end_ns; ++k) {
    at(t).update = true;
    t = options.irregular_updates ? t + irregularStep(random)
                                  : toNs(static_cast<double>(k) / options.update_hz);
  }
  at(end_ns).update = true;
  std::vector<Event> list;
  list.reserve(events.size());
  for (auto& [time, event] : events) list.push_back(std::move(event));
  return list;
}

}  // namespace host
