#include "schedule.h"

#include <cmath>
#include <cstdio>
#include <map>

#include "scenario.h"

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

std::vector<Event> schedule(const Options& options, double seconds, int64_t begin_ns) {
  const int64_t first_ns = options.shots_s.empty() ? begin_ns : toNs(options.shots_s.front()),
                save_ns = toNs(options.save_at_s.value_or(seconds));
  if (toNs(seconds) < begin_ns || first_ns < begin_ns || (!options.save.empty() && save_ns < begin_ns))
    throw InputError("--restore: the saved moment, " + std::to_string(static_cast<double>(begin_ns) * 1e-9) +
                     " s, lies after the end, a shot or --save-at");
  if (!options.save.empty() && save_ns > toNs(seconds))
    throw InputError("--save-at lies after the end of the run");
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
  if (!options.save.empty()) at(save_ns).update = at(save_ns).save = true;
  events.erase(events.begin(), events.lower_bound(begin_ns));
  std::vector<Event> list;
  list.reserve(events.size());
  for (auto& [time, event] : events) list.push_back(std::move(event));
  return list;
}

}  // namespace host
