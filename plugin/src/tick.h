// What one fixed tick knows of the host's world. Made by frame/ from the host's samples; read by rain/ and
// glass/, which know nothing of the ABI.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>

namespace rg {

// Ticks lie at k / kTickHz on the host's clock: a tick's time is a function of its index alone, so it never
// depends on how updates fall.
inline constexpr int64_t kTickHz = 120;  // drops on glass and rain; the film runs every second tick
inline constexpr double kTickSeconds = 1.0 / static_cast<double>(kTickHz);
inline constexpr int64_t kLongestCatchUp_s = 4;  // of a longer stall the rest is left out

// floor(k * 1e9 / 120), exact for |k| < 3e11 (80 years).
constexpr int64_t tickTimeNs(int64_t tick) {
  const int64_t seconds = tick >= 0 ? tick / kTickHz : -((-tick + kTickHz - 1) / kTickHz);
  const int64_t rest = tick - seconds * kTickHz;
  return seconds * 1'000'000'000 + rest * 1'000'000'000 / kTickHz;
}

// worldFromBody, and how it moves. World axes, z up, SI.
struct Pose {
  glm::dvec3 position_m{0.0};
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 velocity_mps{0.0};
  glm::dvec3 angular_velocity_radps{0.0};
};

struct VehicleState {
  uint32_t id = 0;
  Pose pose;
  glm::dvec3 acceleration_mps2{0.0};  // world axes, from the difference of velocities between samples
  bool discontinuity = false;
};

inline constexpr double kStrongestWind_mps = 100.0;  // along an axis, as the ABI takes it

inline constexpr double kNoGround_m = -1e8;  // a height that nothing falls to

struct WeatherState {
  double rain_mm_h = 0.0;
  glm::dvec3 wind_mps{0.0};
  double temperature_c = 12.0;
  double humidity = 0.9;
  double snow_mm_h = 0.0, hail_mm_h = 0.0;  // as water
  double ground_height_m = kNoGround_m;     // round the views, world
};

struct ViewState {
  uint32_t id = 0;
  glm::dmat4 eyeFromWorld{1.0};
  glm::dmat4 clipFromEye{1.0};
  bool clip_zero_to_one = false;
  bool reversed_depth = false;
  double exposure_s = 1.0 / 60.0;
  uint32_t vehicle = 0;
  bool discontinuity = false;
  glm::dvec3 eye_velocity_mps{0.0};
};

// Where a wiper stood during the tick: it swept from `from_rad` over any reversal in `extreme_rad` to
// `to_rad`.
struct WiperMotion {
  uint32_t wiper = 0;
  double from_rad = 0.0;
  double extreme_rad = 0.0;  // the reversal inside the tick, = to_rad when there is none
  double to_rad = 0.0;
};

struct Tick {
  int64_t index = 0;    // this tick takes the state from tickTimeNs(index - 1) to tickTimeNs(index)
  int64_t time_ns = 0;  // = tickTimeNs(index): inputs below are of this moment
  WeatherState weather;
  std::span<const VehicleState> vehicles;
  std::span<const ViewState> views;
  std::span<const WiperMotion> wipers;
};

}  // namespace rg
