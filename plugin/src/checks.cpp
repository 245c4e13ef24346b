#include "checks.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rg {
namespace {

constexpr double kFarthest_m = 1e8;      // beyond this a double no longer resolves a drop (1.5e-8 m)
constexpr double kFastest_mps = 1000.0;  // for bodies and eyes
constexpr uint32_t kMostBodies = 4096, kMostViews = 64, kMostKnots = 65536;
constexpr int32_t kFarthestViewport_px = 32768;  // either way from the target's corner
constexpr double kUnitTolerance = 1e-3;          // header's range for unit quaternions

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

glm::dvec3 readVector(const double v[3], double most, const char* name) {
  for (int i = 0; i < 3; ++i) checkRange(v[i], -most, most, name);
  return {v[0], v[1], v[2]};
}

Pose readPose(const rg_pose& in, const char* name) {
  const std::string prefix = std::string(name) + ".pose.";
  Pose pose;
  pose.position_m = readVector(in.position_m, kFarthest_m, (prefix + "position_m").c_str());
  pose.velocity_mps = readVector(in.velocity_mps, kFastest_mps, (prefix + "velocity_mps").c_str());
  pose.angular_velocity_radps =
      readVector(in.angular_velocity_radps, kFastest_mps, (prefix + "angular_velocity_radps").c_str());
  const glm::dquat q(in.orientation[3], in.orientation[0], in.orientation[1], in.orientation[2]);
  const double length = std::sqrt(glm::dot(q, q));
  if (!(std::abs(length - 1.0) <= kUnitTolerance))
    refuse(prefix + "orientation has length " + number(length) + ", must be 1");
  pose.orientation = glm::normalize(q);
  return pose;
}

VehicleState readVehicle(const rg_vehicle* in) {
  const rg_vehicle v = readStruct(in, "rg_vehicle");
  if (v.id == 0) refuse("rg_vehicle.id is 0");
  VehicleState state;
  state.id = v.id;
  state.pose = readPose(v.pose, "rg_vehicle");
  state.discontinuity = v.discontinuity != 0;
  return state;
}

WeatherState readWeather(const rg_weather* in) {
  const rg_weather w = readStruct(in, "rg_weather");
  checkRange(w.rain_mm_h, 0.0, 300.0, "rg_weather.rain_mm_h");
  checkRange(w.snow_mm_h, 0.0, 300.0, "rg_weather.snow_mm_h");
  checkRange(w.hail_mm_h, 0.0, 300.0, "rg_weather.hail_mm_h");
  checkRange(w.ground_height_m, -kFarthest_m, kFarthest_m, "rg_weather.ground_height_m");
  checkRange(w.temperature_c, -60.0, 60.0, "rg_weather.temperature_c");
  checkRange(w.humidity, 0.0, 1.0, "rg_weather.humidity");
  checkRange(w.visibility_m, 1.0, 1e6, "rg_weather.visibility_m");
  return {w.rain_mm_h,      readVector(w.wind_mps, kStrongestWind_mps, "rg_weather.wind_mps"),
          w.temperature_c,  w.humidity,
          w.snow_mm_h,      w.hail_mm_h,
          w.ground_height_m};
}

glm::dmat4 readMatrix(const double m[16], const char* name) {
  glm::dmat4 result;
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i])) refuse(std::string(name) + "[" + std::to_string(i) + "] is not a number");
    result[i / 4][i % 4] = m[i];
  }
  return result;
}

void checkRigid(const glm::dmat4& m, const char* name) {
  const glm::dmat3 r(m);
  const glm::dmat3 identity = r * glm::transpose(r);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (std::abs(identity[i][j] - (i == j ? 1.0 : 0.0)) > kUnitTolerance)
        refuse(std::string(name) + " is not rigid: it scales or shears");
    }
  }
  if (glm::determinant(r) < 0.0) refuse(std::string(name) + " mirrors");
  if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0)
    refuse(std::string(name) + " has a last row other than 0 0 0 1");
}

// Of each wiper or pane knots ascend, and none is after its sample.
void checkKnotTime(int64_t time_ns, uint32_t id, const rg_sample& in, std::map<uint32_t, int64_t>& latest_ns,
                   const std::string& name) {
  checkTime(time_ns, name.c_str());
  if (time_ns > in.time_ns) refuse(name + " is after its sample");
  const auto [latest, first] = latest_ns.try_emplace(id, time_ns);
  if (!first && latest->second > time_ns) refuse(name + " does not ascend");
  latest->second = time_ns;
}

void readWiperKnots(const rg_sample& in, Sample& out) {
  checkArray(in.wiper_knots, in.wiper_knot_count, sizeof(rg_wiper_knot), sizeof(rg_wiper_knot), kMostKnots,
             "rg_sample.wiper_knots");
  std::map<uint32_t, int64_t> latest_ns;  // of each wiper
  for (uint32_t i = 0; i < in.wiper_knot_count; ++i) {
    const rg_wiper_knot& k = in.wiper_knots[i];
    checkRange(k.angle_rad, -7.0, 7.0, "rg_wiper_knot.angle_rad");
    if (k.wiper == 0) refuse("rg_wiper_knot.wiper is 0");
    checkKnotTime(k.time_ns, k.wiper, in, latest_ns, "rg_wiper_knot.time_ns");
    out.wiper_knots.push_back({k.wiper, {k.time_ns, k.angle_rad}});
  }
}

void readOpenings(const rg_sample& in, Sample& out) {
  checkArray(in.opening_knots, in.opening_knot_count, sizeof(rg_opening_knot), sizeof(rg_opening_knot),
             kMostKnots, "rg_sample.opening_knots");
  std::map<uint32_t, int64_t> latest_ns;  // of each pane
  for (uint32_t i = 0; i < in.opening_knot_count; ++i) {
    const rg_opening_knot& k = in.opening_knots[i];
    checkRange(k.opening_m, 0.0, kWidestOpening_m, "rg_opening_knot.opening_m");
    if (k.pane == 0) refuse("rg_opening_knot.pane is 0");
    checkKnotTime(k.time_ns, k.pane, in, latest_ns, "rg_opening_knot.time_ns");
    out.opening_knots.push_back({k.pane, {k.time_ns, k.opening_m}});
  }
}

template <typename T>
void refuseTwice(std::vector<T> items, const char* name) {
  std::ranges::sort(items, {}, &T::id);
  const auto twice = std::ranges::adjacent_find(items, {}, &T::id);
  if (twice != items.end())
    refuse(std::string(name) + ": id " + std::to_string(twice->id) + " is listed twice");
}

}  // namespace

void checkRange(double value, double least, double most, const char* name) {
  if (value >= least && value <= most) return;  // false for NaN
  refuse(std::string(name) + " is " + number(value) + ", must be " + number(least) + " .. " + number(most));
}

void checkArray(const void* items, uint64_t count, size_t stride, size_t element_size, size_t alignment,
                uint64_t most, const char* name) {
  if (count == 0) return;
  if (items == nullptr) refuse(std::string(name) + " is null but its count is " + std::to_string(count));
  if (count > most)
    refuse(std::string(name) + ": " + std::to_string(count) + " elements, at most " + std::to_string(most) +
           " are taken");
  if (stride < element_size || stride > kLargestStruct || stride % alignment != 0) {
    refuse(std::string(name) + ": stride " + std::to_string(stride) + " fits no version of its elements",
           RG_ERROR_BAD_STRUCT);
  }
}

void checkTime(int64_t time_ns, const char* name) {
  constexpr int64_t kLatest_ns = INT64_C(1) << 61;  // 73 years: sums of two times stay in range
  if (time_ns < -kLatest_ns || time_ns > kLatest_ns)
    refuse(std::string(name) + " is out of range: at most 73 years from 0");
}

std::string readName(const char* name, const char* field) {
  constexpr size_t kLongestName = 63;  // header
  if (name == nullptr) return {};
  const size_t length = strnlen(name, kLongestName + 1);
  if (length > kLongestName) refuse(std::string(field) + " is longer than 63 bytes");
  return std::string(name, length);
}

ViewState readView(const rg_view* in) {
  const rg_view v = readStruct(in, "rg_view");
  if (v.id == 0) refuse("rg_view.id is 0");
  if (v.viewport_px[2] <= 0 || v.viewport_px[3] <= 0 || v.viewport_px[2] > 32768 ||
      v.viewport_px[3] > 32768) {
    refuse("rg_view.viewport_px has size " + std::to_string(v.viewport_px[2]) + " x " +
           std::to_string(v.viewport_px[3]) + ", must be 1 .. 32768");
  }
  for (int i = 0; i < 2; ++i)
    checkRange(v.viewport_px[i], -kFarthestViewport_px, kFarthestViewport_px, "rg_view.viewport_px");
  ViewState state;
  state.id = v.id;
  state.eyeFromWorld = readMatrix(v.eye_from_world, "rg_view.eye_from_world");
  checkRigid(state.eyeFromWorld, "rg_view.eye_from_world");
  state.clipFromEye = readMatrix(v.projection, "rg_view.projection");
  if (!(std::abs(glm::determinant(state.clipFromEye)) > 0.0) || state.clipFromEye[0][0] == 0.0 ||
      state.clipFromEye[1][1] == 0.0) {
    refuse("rg_view.projection has no inverse: the view has no volume");
  }
  if (state.clipFromEye[2][3] == 0.0)
    refuse("rg_view.projection is orthographic: rain is seen from an eye, in perspective");
  state.clip_zero_to_one = v.clip_zero_to_one != 0;
  state.reversed_depth = v.reversed_depth != 0;
  checkRange(v.exposure_s, 1e-5, 0.25, "rg_view.exposure_s");
  state.exposure_s = v.exposure_s;
  state.vehicle = v.vehicle;
  state.discontinuity = v.discontinuity != 0;
  state.eye_velocity_mps = readVector(v.eye_velocity_mps, kFastest_mps, "rg_view.eye_velocity_mps");
  return state;
}

Sample readSample(const rg_sample* in, const Sample* before) {
  const rg_sample s = readStruct(in, "rg_sample");
  checkTime(s.time_ns, "rg_sample.time_ns");
  Sample out;
  out.time_ns = s.time_ns;
  if (s.weather != nullptr)
    out.weather = readWeather(s.weather);
  else if (before != nullptr)
    out.weather = before->weather;
  checkArray(s.vehicles, s.vehicle_count, s.vehicle_stride, kFirstSize<rg_vehicle>, kMostBodies,
             "rg_sample.vehicles");
  for (uint32_t i = 0; i < s.vehicle_count; ++i)
    out.vehicles.push_back(readVehicle(element(s.vehicles, s.vehicle_stride, i)));
  refuseTwice(out.vehicles, "rg_sample.vehicles");
  checkArray(s.views, s.view_count, s.view_stride, kFirstSize<rg_view>, kMostViews, "rg_sample.views");
  for (uint32_t i = 0; i < s.view_count; ++i)
    out.views.push_back(readView(element(s.views, s.view_stride, i)));
  refuseTwice(out.views, "rg_sample.views");
  if (s.views == nullptr && before != nullptr) {
    out.views = before->views;
    for (ViewState& view : out.views) view.discontinuity = false;
  }
  readWiperKnots(s, out);
  readOpenings(s, out);
  return out;
}

rg_create_info readCreateInfo(const rg_create_info* in) {
  const rg_create_info info = readStruct(in, "rg_create_info");
  checkRange(info.max_drops, 1000.0, 4000000.0, "rg_create_info.max_drops");
  return info;
}

}  // namespace rg
