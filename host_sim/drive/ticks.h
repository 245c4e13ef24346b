// The host's own fixed ticks: driver and wipers. They lie where the plugin's lie, so that each of its ticks
// finds a sample of its very moment.
#pragma once

#include <cstdint>

namespace host {

inline constexpr int64_t kHostTickHz = 120;
inline constexpr double kHostTickSeconds = 1.0 / static_cast<double>(kHostTickHz);

constexpr int64_t hostTickNs(int64_t tick) {
  return tick / kHostTickHz * 1'000'000'000 + tick % kHostTickHz * 1'000'000'000 / kHostTickHz;
}
// The last tick at or before a moment >= 0.
constexpr int64_t hostTickAt(int64_t time_ns) {
  int64_t tick =
      time_ns / 1'000'000'000 * kHostTickHz + time_ns % 1'000'000'000 * kHostTickHz / 1'000'000'000;
  while (hostTickNs(tick + 1) <= time_ns) ++tick;
  return tick;
}

}  // namespace host
