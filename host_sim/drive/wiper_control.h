// The wiper motor: from a mode to the share of the sweep over time. Modes change where a cycle ends, as real
// motors park.
#pragma once

#include <string_view>
#include <vector>

namespace host {

enum class WiperMode { off, intermittent, slow, fast, automatic };

// "off", "intermittent", "1", "2", "auto"; throws std::invalid_argument that names others.
WiperMode wiperModeFrom(std::string_view text);
const char* wiperModeName(WiperMode mode);

// Cycles a minute. FMVSS 104 S4.1.1: the fast one 45 or more, the slow one 20 or more, 15 or more apart.
inline constexpr double kSlowCycles_per_min = 42.0;
inline constexpr double kFastCycles_per_min = 62.0;
inline constexpr double kIntermittentPause_s = 4.0;  // unless told
inline constexpr int kWashCycles = 3;                // after a wash, as cars do

// Where the blade is after a tick, as a share of the sweep: 0 at rest, 1 at the far reversal.
struct WiperKnotShare {
  double seconds_into_tick = 0.0;
  double share = 0.0;
};

class WiperMotor {
 public:
  // Any mode but automatic: that is for a RainSensor to choose.
  void setMode(WiperMode mode, double intermittent_pause_s = kIntermittentPause_s) {
    wanted_ = mode;
    wanted_pause_s_ = intermittent_pause_s;
  }
  // So many cycles from now on, whatever the mode.
  void wipe(int cycles) { owed_ = cycles; }
  WiperMode mode() const { return wanted_; }
  // Advances by the host's tick and gives the knots inside it: its end, and every reversal on the way.
  const std::vector<WiperKnotShare>& tick();
  double share() const { return share_; }

  template <class Fields>
  void visit(Fields& f) {
    f("wanted", wanted_, WiperMode::off, WiperMode::fast), f("wanted_pause_s", wanted_pause_s_);
    f("owed", owed_, 0, 1000), f("running", running_), f("phase", phase_, 0.0, 1.0);
    f("cycle_s", cycle_s_, 0.1, 100.0), f("paused_s", paused_s_), f("share", share_, 0.0, 1.0);
  }

 private:
  bool starts() const;

  WiperMode wanted_ = WiperMode::off;
  double wanted_pause_s_ = kIntermittentPause_s;
  int owed_ = 0;
  bool running_ = false;
  double phase_ = 0.0;  // 0 .. 1 over a cycle
  double cycle_s_ = 1.0;
  double paused_s_ = 1e9;  // since the last cycle
  double share_ = 0.0;
  std::vector<WiperKnotShare> knots_;
};

}  // namespace host
