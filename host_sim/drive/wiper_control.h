// The wiper motor: from a mode to the share of the sweep over time. Modes change where a cycle ends, as real
// motors park.
#pragma once

#include <string_view>
#include <vector>

namespace host {

enum class WiperMode { off, intermittent, slow, fast };

// "off", "intermittent", "1", "2"; throws std::invalid_argument that names others.
WiperMode wiperModeFrom(std::string_view text);
const char* wiperModeName(WiperMode mode);

// Cycles a minute. FMVSS 104 S4.1.1: the fast one 45 or more, the slow one 20 or more, 15 or more apart.
inline constexpr double kSlowCycles_per_min = 42.0;
inline constexpr double kFastCycles_per_min = 62.0;
inline constexpr double kIntermittentPause_s = 4.0;

// Where the blade is after a tick, as a share of the sweep: 0 at rest, 1 at the far reversal.
struct WiperKnotShare {
  double seconds_into_tick = 0.0;
  double share = 0.0;
};

class WiperMotor {
 public:
  void setMode(WiperMode mode) { wanted_ = mode; }
  void wipeOnce() { once_ = true; }
  WiperMode mode() const { return wanted_; }
  // Advances by the host's tick and gives the knots inside it: its end, and every reversal on the way.
  const std::vector<WiperKnotShare>& tick();
  double share() const { return share_; }

 private:
  bool starts() const;

  WiperMode wanted_ = WiperMode::off;
  bool once_ = false;
  bool running_ = false;
  double phase_ = 0.0;  // 0 .. 1 over a cycle
  double cycle_s_ = 1.0;
  double pause_s_ = 0.0;
  double share_ = 0.0;
  std::vector<WiperKnotShare> knots_;
};

}  // namespace host
