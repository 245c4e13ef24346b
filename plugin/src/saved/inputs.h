// What tick.h's structs are made of, for saved states; in the ranges that the ABI takes them in.
#pragma once

#include "saved/archive.h"
#include "tick.h"

namespace rg {

inline constexpr int64_t kLatestTime_ns = INT64_C(1) << 61;  // as the ABI takes it
inline constexpr int64_t kLatestTick = kLatestTime_ns / 1'000'000'000 * kTickHz + kTickHz;
inline constexpr double kAnyNumber = 1e300;  // where the ABI takes any

template <class Archive, class Unit>
void visitUnit(Archive& a, Unit& q) {
  a.within(q.x, -1.1, 1.1), a.within(q.y, -1.1, 1.1), a.within(q.z, -1.1, 1.1), a.within(q.w, -1.1, 1.1);
  if constexpr (Archive::kReads)
    a.require(std::abs(glm::dot(q, q) - 1.0) < 0.01, "a quaternion is not of unit length");
}

template <class Archive>
void visitSaved(Archive& a, saved::Is<Pose> auto& pose) {
  a(pose.position_m);
  visitUnit(a, pose.orientation);
  a(pose.velocity_mps, pose.angular_velocity_radps);
}

template <class Archive>
void visitSaved(Archive& a, saved::Is<VehicleState> auto& vehicle) {
  a(vehicle.id, vehicle.pose, vehicle.acceleration_mps2, vehicle.discontinuity);
}

template <class Archive>
void visitSaved(Archive& a, saved::Is<WeatherState> auto& weather) {
  a.within(weather.rain_mm_h, 0.0, 300.0);
  a.within(weather.wind_mps, -kStrongestWind_mps, kStrongestWind_mps);
  a.within(weather.temperature_c, -60.0, 60.0);
  a.within(weather.humidity, 0.0, 1.0);
  a.within(weather.snow_mm_h, 0.0, 300.0);
  a.within(weather.hail_mm_h, 0.0, 300.0);
  a.within(weather.ground_height_m, -1e8, 1e8);
}

template <class Archive>
void visitSaved(Archive& a, saved::Is<ViewState> auto& view) {
  a(view.id);
  a.within(view.eyeFromWorld, -kAnyNumber, kAnyNumber);
  a.within(view.clipFromEye, -kAnyNumber, kAnyNumber);
  a(view.clip_zero_to_one, view.reversed_depth);
  a.within(view.exposure_s, 0.0, 0.25);
  a(view.vehicle, view.discontinuity, view.eye_velocity_mps);
}

}  // namespace rg
