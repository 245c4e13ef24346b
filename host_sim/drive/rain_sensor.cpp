#include "drive/rain_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace host {
namespace {

// All unsourced: as such wipers feel. On the glass, where 80 km/h makes some four times the rain's own rate.
constexpr double kSmoothed_s = 1.5;
struct Step {
  WiperMode mode;
  double above_mm_h;
};
constexpr std::array<Step, 3> kSteps{
    {{WiperMode::intermittent, 0.3}, {WiperMode::slow, 12.0}, {WiperMode::fast, 60.0}}};
constexpr double kDownShare = 0.6;  // it goes back below this share of what brought it there
constexpr double kWipedAt_mm = 0.01;
constexpr double kLeastPause_s = 1.0, kLongestPause_s = 20.0;

}  // namespace

void RainSensor::sense(double caught_m3, double area_m2, double time_s) {
  const double passed_s = time_s - time_s_;
  if (begun_ && passed_s > 0.0 && area_m2 > 0.0) {
    const double now_mm_h = std::max(0.0, caught_m3 - caught_m3_) / area_m2 / passed_s * 3.6e6;
    rate_mm_h_ += (now_mm_h - rate_mm_h_) * (1.0 - std::exp(-passed_s / kSmoothed_s));
  }
  begun_ = true;
  caught_m3_ = caught_m3;
  time_s_ = time_s;
  const WiperMode before = mode_;
  mode_ = WiperMode::off;
  for (const Step& step : kSteps) {
    if (rate_mm_h_ > step.above_mm_h * (before >= step.mode ? kDownShare : 1.0)) mode_ = step.mode;
  }
}

double RainSensor::pause_s() const {
  return std::clamp(kWipedAt_mm / std::max(rate_mm_h_, 1e-6) * 3600.0, kLeastPause_s, kLongestPause_s);
}

}  // namespace host
