// A shipped scenario, driven by the host's own simulation on the shipped models, frame by frame, with the
// oracle's hulls beside it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hull.h"
#include "rain/field.h"
#include "rain_only.h"
#include "simulation.h"
#include "variants.h"

namespace oracle {

// How far a streak may lie inside a volume at most. Float places 20 m from the eye are 2 um apart and drops'
// ends are told to 8 us, 0.3 mm at 40 m/s; a drop's own radius, by which streaks stay off, is at least
// 0.25 mm.
inline constexpr double kTolerance_m = 0.5e-3;

#ifdef __SANITIZE_ADDRESS__
inline constexpr double kRarer = 5.0;  // a sanitized build is some ten times slower
#else
inline constexpr double kRarer = 1.0;
#endif
// Between frames that are samples of a drive: not whole ticks, so that they fall on ticks and at fifths
// between.
inline constexpr double kSampledFrame_s = (8.0 * kRarer + 0.2) / 120.0;
inline constexpr double kRareFrame_s = (40.0 * kRarer + 0.2) / 120.0;
// Of a drive of a few seconds, whose ticks cost as much as looking at some frames of it.
inline constexpr double kBriefFrame_s = (16.0 * kRarer + 0.2) / 120.0;

class Drive {
 public:
  explicit Drive(const Variant& variant, double frame_s = kSampledFrame_s);

  // Goes on to the next frame; false after the scenario's end.
  bool next();

  // ---- of the frame ----
  double time_s() const { return static_cast<double>(time_ns_) * 1e-9; }
  int64_t pluginTime_ns() const { return simulation_.pluginTime(time_ns_); }
  rg::ViewState view() const;
  host::CarState car() const { return simulation_.carAt(time_ns_); }
  rg::rain::Field& field() { return *rain_.field; }
  uint32_t capacity_drops() const { return rain_.capacity_drops; }
  // Of a class's drops, as of the last tick.
  glm::dvec3 dropVelocity(uint32_t kind) const;
  double rain_mm_h() const { return simulation_.weather().rain_mm_h; }

  const std::vector<Hull>& roadHulls() const { return road_hulls_; }
  // How deep a segment given in world coordinates lies in the deepest of all volumes, the car's posed as it
  // is at the frame.
  double depth(const glm::dvec3& a, const glm::dvec3& b) const;

  double hardest_braking_mps2 = 0.0;  // seen so far
  bool was_under_cover = false;       // the car was, at some frame

 private:
  struct Models {
    host::CarView car;
    host::RoadView road;
  };
  static const Models& models();
  void brake();

  host::Scenario scenario_;
  host::RainPlugin plugin_;
  RainOnly& rain_;  // the plugin's
  host::Simulation simulation_;
  std::vector<Hull> road_hulls_, car_hulls_;
  std::optional<size_t> brake_for_;
  bool braking_ = false;
  double frame_s_;
  int64_t time_ns_ = 0, frame_ = -1;
};

}  // namespace oracle
