// One of the two that are compared: draws a frame of rain, or an empty one, into the framebuffer that is
// bound.
#pragma once

#include <cstdint>

namespace compare {

inline constexpr int kWidth_px = 1280, kHeight_px = 720;
inline constexpr int kFrameHz = 60;
inline constexpr double kExposure_s = 1.0 / kFrameHz;  // OSG's streaks are as long as a frame lasts
inline constexpr double kFieldOfView_rad = 0.6307;     // vertically: 60 deg across
inline constexpr double kNear_m = 0.1, kFar_m = 500.0;
inline constexpr double kEyeHeight_m = 1.5;

// The n-th frame's: a drive along a straight road.
struct Moment {
  int64_t frame = 0;
  double speed_mps = 0.0;
  double time_s() const { return static_cast<double>(frame) / kFrameHz; }
  int64_t time_ns() const { return frame * INT64_C(1'000'000'000) / kFrameHz; }
  double x_m() const { return speed_mps * time_s(); }
};

class Side {
 public:
  virtual ~Side() = default;
  virtual const char* name() const = 0;
  // Clears, and draws the rain.
  virtual void draw(const Moment& moment) = 0;
  // All of that but the rain.
  virtual void drawEmpty(const Moment& moment) = 0;
  // Streaks that touched the picture in the last draw().
  virtual double streaksSeen() = 0;
};

}  // namespace compare
