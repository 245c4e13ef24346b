#include "drive/wiper_control.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "drive/ticks.h"

namespace host {

WiperMode wiperModeFrom(std::string_view text) {
  if (text == "off" || text == "0") return WiperMode::off;
  if (text == "intermittent") return WiperMode::intermittent;
  if (text == "1") return WiperMode::slow;
  if (text == "2") return WiperMode::fast;
  if (text == "auto") return WiperMode::automatic;
  throw std::invalid_argument("wiper mode \"" + std::string(text) +
                              "\" is none of off, intermittent, 1, 2, auto");
}

const char* wiperModeName(WiperMode mode) {
  switch (mode) {
    case WiperMode::off:
      return "off";
    case WiperMode::intermittent:
      return "intermittent";
    case WiperMode::slow:
      return "1";
    case WiperMode::fast:
      return "2";
    case WiperMode::automatic:
      return "auto";
  }
  return "off";
}

bool WiperMotor::starts() const {
  if (owed_ > 0 || wanted_ == WiperMode::slow || wanted_ == WiperMode::fast) return true;
  return wanted_ == WiperMode::intermittent && paused_s_ >= wanted_pause_s_ - 1e-9;
}

// A crank turns at a constant rate, so the blade goes as a cosine and stands for a moment at its reversals.
const std::vector<WiperKnotShare>& WiperMotor::tick() {
  knots_.clear();
  if (!running_) {
    paused_s_ += kHostTickSeconds;
    if (starts()) {
      running_ = true;
      phase_ = 0.0;
      cycle_s_ = 60.0 / (wanted_ == WiperMode::fast ? kFastCycles_per_min : kSlowCycles_per_min);
      owed_ = std::max(0, owed_ - 1);
    }
  }
  if (running_) {
    const double before = phase_;
    phase_ += kHostTickSeconds / cycle_s_;
    if (before < 0.5 && phase_ >= 0.5) knots_.push_back({(0.5 - before) * cycle_s_, 1.0});
    if (phase_ >= 1.0) {
      knots_.push_back({(1.0 - before) * cycle_s_, 0.0});
      running_ = false;
      paused_s_ = 0.0;
      phase_ = 0.0;
    }
    share_ = 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * phase_));
  }
  knots_.push_back({kHostTickSeconds, share_});
  return knots_;
}

}  // namespace host
