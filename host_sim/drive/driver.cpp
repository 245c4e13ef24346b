#include "drive/driver.h"

#include <algorithm>
#include <cmath>

#include "drive/ticks.h"

namespace host {
namespace {

// A calm driver in a family car (Bosbach 2005 puts comfort at 2 m/s^2 lengthwise; bends are taken at 2 to 3
// by most).
constexpr double kAccelerate_mps2 = 1.8;
constexpr double kBrake_mps2 = 2.2;
constexpr double kCorner_mps2 = 2.4;
constexpr double kHardBrake_mps2 = 9.0;  // a person at the keys: tyres' limit on a damp road
constexpr double kThrottle_mps2 = 3.0;
constexpr double kTopSpeed_mps = 60.0;
constexpr double kWheelbase_m = 2.6;
constexpr double kJerk_s = 0.35;                // the foot's time constant
constexpr double kSpring_s = 0.25;              // the body's on its springs
constexpr double kPitch_rad_per_mps2 = 0.0035;  // 0.2 deg of dive per m/s^2: 1.7 deg in a full braking
constexpr double kRoll_rad_per_mps2 = 0.006;
constexpr double kMostSteer_rad = 0.55;
constexpr double kCrawl_mps = 0.8;  // so that a stop is reached in finite time

double relaxed(double value, double target, double time_constant_s) {
  return target + (value - target) * std::exp(-kHostTickSeconds / time_constant_s);
}

}  // namespace

Driver::Driver(const Route& route, const DrivePlan& plan) : route_(route), plan_(plan) {
  std::ranges::sort(plan_.stops, {}, &Stop::at_m);
  planSpeeds();
  state_.way_m = plan_.start_m;
  while (next_stop_ < plan_.stops.size() && plan_.stops[next_stop_].at_m < state_.way_m) ++next_stop_;
  state_.speed_mps = wantedSpeed(state_.way_m);
  const glm::dvec3 d = route_.direction(state_.way_m);
  heading_rad_ = std::atan2(d.y, d.x);
  settle(state_);
  state_.velocity_mps = d * state_.speed_mps;
}

// Backward over the way: no faster than from where the next metre's speed is still reached by braking.
void Driver::planSpeeds() {
  const double end_m = route_.length_m();
  limits_mps_.assign(static_cast<size_t>(end_m) + 2, kTopSpeed_mps);
  for (size_t m = 0; m < limits_mps_.size(); ++m) {
    const double bend = std::abs(route_.curvature_per_m(static_cast<double>(m)));
    limits_mps_[m] =
        std::min(plan_.speed_mps.at(static_cast<double>(m)), std::sqrt(kCorner_mps2 / std::max(bend, 1e-5)));
  }
  if (!route_.closed()) limits_mps_.back() = 0.0;
  for (const Stop& stop : plan_.stops) {
    if (stop.at_m >= 0.0 && stop.at_m < end_m) limits_mps_[static_cast<size_t>(stop.at_m)] = 0.0;
  }
  for (size_t m = limits_mps_.size() - 1; m-- > 0;) {
    limits_mps_[m] =
        std::min(limits_mps_[m], std::sqrt(limits_mps_[m + 1] * limits_mps_[m + 1] + 2.0 * kBrake_mps2));
  }
}

double Driver::wantedSpeed(double way_m) const {
  const double m = route_.closed() ? std::fmod(way_m, route_.length_m()) : way_m;
  const double last = static_cast<double>(limits_mps_.size() - 1);
  if (m >= last) return route_.closed() ? limits_mps_.front() : 0.0;
  const auto i = static_cast<size_t>(std::max(0.0, m));
  return std::lerp(limits_mps_[i], limits_mps_[i + 1], std::clamp(m - static_cast<double>(i), 0.0, 1.0));
}

void Driver::tick() {
  const CarState before = state_;
  double wanted = wantedSpeed(state_.way_m);
  if (next_stop_ < plan_.stops.size()) {
    const double left_m = plan_.stops[next_stop_].at_m - state_.way_m;
    const bool there = left_m < 0.05;
    wanted =
        there ? 0.0
              : std::max(std::min(wanted, std::sqrt(2.0 * kBrake_mps2 * std::max(left_m, 0.0))), kCrawl_mps);
    if (there) {
      state_.speed_mps = 0.0;
      waiting_s_ += kHostTickSeconds;
      if (waiting_s_ >= plan_.stops[next_stop_].seconds) {
        waiting_s_ = 0.0;
        limits_mps_[static_cast<size_t>(plan_.stops[next_stop_].at_m)] =
            limits_mps_[static_cast<size_t>(plan_.stops[next_stop_].at_m) + 1];
        ++next_stop_;
        planSpeeds();
      }
    }
  } else if (wanted > 0.0) {
    wanted = std::max(wanted, kCrawl_mps);
  }
  const double push = std::clamp((wanted - state_.speed_mps) / kJerk_s, -1.6 * kBrake_mps2, kAccelerate_mps2);
  state_.acceleration_mps2 = relaxed(state_.acceleration_mps2, push, kJerk_s / 2);
  state_.speed_mps = std::max(0.0, state_.speed_mps + state_.acceleration_mps2 * kHostTickSeconds);
  if (wanted == 0.0 && state_.speed_mps < 0.05) state_.speed_mps = state_.acceleration_mps2 = 0.0;
  state_.way_m += state_.speed_mps * kHostTickSeconds;
  const glm::dvec3 d = route_.direction(state_.way_m);
  heading_rad_ = std::atan2(d.y, d.x);
  state_.steering_rad = std::atan(kWheelbase_m * route_.curvature_per_m(state_.way_m));
  settle(before);
}

void Driver::tick(const Controls& controls) {
  const CarState before = state_;
  double push = controls.throttle * kThrottle_mps2 -
                controls.brake * kHardBrake_mps2 * (state_.speed_mps > 0.0 ? 1.0 : 0.0);
  push -= 0.0008 * state_.speed_mps * state_.speed_mps + 0.15;  // air and rolling resistance
  state_.acceleration_mps2 =
      state_.speed_mps <= 0.0 && push < 0.0 ? 0.0 : relaxed(state_.acceleration_mps2, push, 0.1);
  state_.speed_mps =
      std::clamp(state_.speed_mps + state_.acceleration_mps2 * kHostTickSeconds, 0.0, kTopSpeed_mps);
  // The faster, the smaller the angle the wheel is turned to: what tyres hold.
  const double most = std::min(
      kMostSteer_rad, std::atan(kWheelbase_m * 7.0 / std::max(1.0, state_.speed_mps * state_.speed_mps)));
  state_.steering_rad = relaxed(state_.steering_rad, controls.steer * most, 0.15);
  heading_rad_ += std::tan(state_.steering_rad) / kWheelbase_m * state_.speed_mps * kHostTickSeconds;
  state_.position_m +=
      glm::dvec3(std::cos(heading_rad_), std::sin(heading_rad_), 0.0) * (state_.speed_mps * kHostTickSeconds);
  state_.way_m = route_.nearestWay(state_.position_m, state_.way_m);
  settle(before);
}

void Driver::giveBack() {
  by_hand_ = false;
  state_.way_m = route_.nearestWay(state_.position_m, -1.0);
  next_stop_ = 0;
  while (next_stop_ < plan_.stops.size() && plan_.stops[next_stop_].at_m < state_.way_m) ++next_stop_;
}

// The pose from way (or place) and heading; velocities are what takes the tick before here.
void Driver::settle(const CarState& before) {
  const glm::dvec3 on_route = route_.position(state_.way_m), along = route_.direction(state_.way_m);
  if (by_hand_)
    state_.position_m.z = on_route.z;
  else
    state_.position_m = on_route;
  const double slope_rad = std::asin(std::clamp(along.z, -1.0, 1.0));
  const double sideways_mps2 =
      state_.speed_mps * state_.speed_mps * std::tan(state_.steering_rad) / kWheelbase_m;
  pitch_rad_ = relaxed(pitch_rad_, kPitch_rad_per_mps2 * state_.acceleration_mps2, kSpring_s);
  roll_rad_ = relaxed(roll_rad_, kRoll_rad_per_mps2 * sideways_mps2, kSpring_s);
  const glm::dquat yaw = glm::angleAxis(heading_rad_, glm::dvec3(0.0, 0.0, 1.0));
  const glm::dquat nose_up = glm::angleAxis(-(slope_rad + pitch_rad_), glm::dvec3(0.0, 1.0, 0.0));
  const glm::dquat lean = glm::angleAxis(roll_rad_, glm::dvec3(1.0, 0.0, 0.0));
  state_.orientation = glm::normalize(yaw * nose_up * lean);
  state_.velocity_mps = (state_.position_m - before.position_m) / kHostTickSeconds;
  if (glm::length(state_.velocity_mps) > kTopSpeed_mps * 1.5) state_.velocity_mps = along * state_.speed_mps;
  glm::dquat turned = state_.orientation * glm::conjugate(before.orientation);
  if (turned.w < 0.0) turned = -turned;
  state_.angular_velocity_radps = 2.0 * glm::dvec3(turned.x, turned.y, turned.z) / kHostTickSeconds;
  if (glm::length(state_.angular_velocity_radps) > 20.0) state_.angular_velocity_radps = glm::dvec3(0.0);
  state_.driven_m += state_.speed_mps * kHostTickSeconds;
}

CarState Driver::at(double seconds) const {
  CarState later = state_;
  later.position_m += state_.velocity_mps * seconds;
  const double angle_rad = glm::length(state_.angular_velocity_radps) * seconds;
  if (angle_rad != 0.0) {
    later.orientation = glm::normalize(
        glm::angleAxis(angle_rad, glm::normalize(state_.angular_velocity_radps)) * state_.orientation);
  }
  later.driven_m += state_.speed_mps * seconds;
  return later;
}

}  // namespace host
