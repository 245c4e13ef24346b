#include "timeline.h"

#include <algorithm>
#include <cmath>

#include "rain/snow_law.h"

namespace rg {
namespace {

constexpr double kSecondsPerNs = 1e-9;

template <typename T>
const T* byId(const std::vector<T>& items, uint32_t id) {
  const auto found = std::ranges::lower_bound(items, id, {}, &T::id);
  return found != items.end() && found->id == id ? &*found : nullptr;
}

WeatherState between(const WeatherState& a, const WeatherState& b, double s) {
  return {std::lerp(a.rain_mm_h, b.rain_mm_h, s),
          glm::mix(a.wind_mps, b.wind_mps, s),
          std::lerp(a.temperature_c, b.temperature_c, s),
          std::lerp(a.humidity, b.humidity, s),
          std::lerp(a.snow_mm_h, b.snow_mm_h, s),
          std::lerp(a.hail_mm_h, b.hail_mm_h, s),
          std::lerp(a.ground_height_m, b.ground_height_m, s)};
}

Pose between(const Pose& a, const Pose& b, double s) {
  return {glm::mix(a.position_m, b.position_m, s), glm::slerp(a.orientation, b.orientation, s),
          glm::mix(a.velocity_mps, b.velocity_mps, s),
          glm::mix(a.angular_velocity_radps, b.angular_velocity_radps, s)};
}

// A rigid eye_from_world turned into the eye's place and orientation, so that it can be interpolated.
glm::dmat4 between(const glm::dmat4& a, const glm::dmat4& b, double s) {
  const glm::dquat qa = glm::quat_cast(glm::dmat3(a)), qb = glm::quat_cast(glm::dmat3(b));
  const glm::dvec3 pa = -(glm::transpose(glm::dmat3(a)) * glm::dvec3(a[3]));
  const glm::dvec3 pb = -(glm::transpose(glm::dmat3(b)) * glm::dvec3(b[3]));
  const glm::dmat3 rotation = glm::mat3_cast(glm::slerp(qa, qb, s));
  glm::dmat4 result(rotation);
  result[3] = glm::dvec4(-(rotation * glm::mix(pa, pb, s)), 1.0);
  return result;
}

glm::dvec3 accelerationBetween(const VehicleState& a, const VehicleState& b, int64_t span_ns) {
  if (b.discontinuity || span_ns <= 0) return glm::dvec3(0.0);
  return (b.pose.velocity_mps - a.pose.velocity_mps) / (static_cast<double>(span_ns) * kSecondsPerNs);
}

// A vehicle at the moment that lies the share s of the way from sample a to sample b; a may equal b.
VehicleState vehicleBetween(const Sample& a, const Sample& b, const VehicleState& in_b, double s) {
  const VehicleState* in_a = byId(a.vehicles, in_b.id);
  VehicleState result = in_b;
  if (in_a == nullptr || &a == &b) return result;
  result.acceleration_mps2 = accelerationBetween(*in_a, in_b, b.time_ns - a.time_ns);
  if (s >= 1.0) return result;
  result.discontinuity = false;
  const double since_a_s = s * static_cast<double>(b.time_ns - a.time_ns) * kSecondsPerNs;
  result.pose = in_b.discontinuity ? extrapolated(in_a->pose, since_a_s) : between(in_a->pose, in_b.pose, s);
  return result;
}

ViewState viewBetween(const Sample& a, const ViewState& in_b, double s) {
  ViewState result = in_b;
  const ViewState* in_a = byId(a.views, in_b.id);
  if (in_a == nullptr || s >= 1.0) return result;
  result.discontinuity = false;
  result.eyeFromWorld =
      in_b.discontinuity ? in_a->eyeFromWorld : between(in_a->eyeFromWorld, in_b.eyeFromWorld, s);
  return result;
}

// Rain and snow together, shared out anew by what the air makes of them.
void shareOut(WeatherState& weather) {
  const double both_mm_h = weather.rain_mm_h + weather.snow_mm_h;
  weather.snow_mm_h = both_mm_h * rain::snowShare(weather.temperature_c, weather.humidity);
  weather.rain_mm_h = both_mm_h - weather.snow_mm_h;
}

double shareBetween(const Sample& a, const Sample& b, int64_t time_ns) {
  if (b.time_ns <= a.time_ns) return 1.0;
  return static_cast<double>(time_ns - a.time_ns) / static_cast<double>(b.time_ns - a.time_ns);
}

double valueAt(const std::vector<Knot>& knots, int64_t time_ns) {
  const auto after = std::ranges::lower_bound(knots, time_ns, {}, &Knot::time_ns);
  if (after == knots.begin()) return after->value;
  const Knot& before = *std::prev(after);
  if (after == knots.end()) return before.value;
  const double s =
      static_cast<double>(time_ns - before.time_ns) / static_cast<double>(after->time_ns - before.time_ns);
  return std::lerp(before.value, after->value, s);
}

// The angle farthest outside of [from, to] that a knot inside the tick reaches: where the blade turned round.
double extremeBetween(const std::vector<Knot>& knots, int64_t begin_ns, int64_t end_ns, double from,
                      double to) {
  double extreme = to, reach = 0.0;
  for (auto k = std::ranges::upper_bound(knots, begin_ns, {}, &Knot::time_ns);
       k != knots.end() && k->time_ns < end_ns; ++k) {
    const double outside = std::max(k->value - std::max(from, to), std::min(from, to) - k->value);
    if (outside > reach) {
      reach = outside;
      extreme = k->value;
    }
  }
  return extreme;
}

template <typename T>
void carryOver(const std::vector<T>& before, std::vector<T>& now, void (*atRest)(T&)) {
  for (const T& item : before) {
    if (byId(now, item.id) != nullptr) continue;
    const auto place = std::ranges::lower_bound(now, item.id, {}, &T::id);
    atRest(*now.insert(place, item));
  }
}

}  // namespace

Pose extrapolated(const Pose& pose, double seconds) {
  Pose result = pose;
  result.position_m += pose.velocity_mps * seconds;
  const double angle_rad = glm::length(pose.angular_velocity_radps) * seconds;
  if (angle_rad != 0.0) {
    const glm::dquat turn = glm::angleAxis(angle_rad, glm::normalize(pose.angular_velocity_radps));
    result.orientation = glm::normalize(turn * pose.orientation);
  }
  return result;
}

void Timeline::add(const Sample& sample) {
  Sample added = sample;
  std::ranges::sort(added.vehicles, {}, &VehicleState::id);
  std::ranges::sort(added.views, {}, &ViewState::id);
  if (!samples_.empty()) {
    carryOver<VehicleState>(samples_.back().vehicles, added.vehicles, [](VehicleState& v) {
      v.pose.velocity_mps = v.pose.angular_velocity_radps = glm::dvec3(0.0);
      v.discontinuity = false;
    });
  }
  addKnots(added.wiper_knots, wiper_knots_);
  addKnots(added.opening_knots, opening_knots_);
  samples_.push_back(std::move(added));
}

void Timeline::addKnots(const std::vector<std::pair<uint32_t, Knot>>& added, Knots& to) {
  for (const auto& [id, knot] : added) {
    std::vector<Knot>& knots = to[id];
    if (!knots.empty() && knots.back().time_ns >= knot.time_ns) {
      if (knots.back().time_ns == knot.time_ns) knots.back() = knot;
      continue;
    }
    knots.push_back(knot);
  }
}

std::pair<const Sample*, const Sample*> Timeline::around(int64_t time_ns) const {
  const auto at = std::ranges::lower_bound(samples_, time_ns, {}, &Sample::time_ns);
  if (at == samples_.begin()) return {&*at, &*at};
  if (at == samples_.end()) return {&samples_.back(), &samples_.back()};
  return {&*std::prev(at), &*at};
}

std::optional<VehicleState> Timeline::vehicleAt(uint32_t id, int64_t time_ns) const {
  if (samples_.empty()) return std::nullopt;
  const auto [a, b] = around(time_ns);
  const VehicleState* in_b = byId(b->vehicles, id);
  if (in_b == nullptr) return std::nullopt;
  VehicleState state = vehicleBetween(*a, *b, *in_b, shareBetween(*a, *b, time_ns));
  if (time_ns > b->time_ns) {
    state.pose = extrapolated(state.pose, static_cast<double>(time_ns - b->time_ns) * kSecondsPerNs);
    state.discontinuity = false;
  }
  return state;
}

std::optional<double> Timeline::wiperAngleAt(uint32_t wiper, int64_t time_ns) const {
  const auto found = wiper_knots_.find(wiper);
  if (found == wiper_knots_.end() || found->second.empty()) return std::nullopt;
  return valueAt(found->second, time_ns);
}

std::optional<double> Timeline::openingAt(uint32_t pane, int64_t time_ns) const {
  const auto found = opening_knots_.find(pane);
  if (found == opening_knots_.end() || time_ns < found->second.front().time_ns) return std::nullopt;
  return valueAt(found->second, time_ns);
}

const Tick& Timeline::tick(int64_t index) {
  const int64_t begin_ns = tickTimeNs(index - 1), end_ns = tickTimeNs(index);
  const auto [a, b] = around(end_ns);
  const double s = shareBetween(*a, *b, end_ns);
  vehicles_.clear();
  for (const VehicleState& v : b->vehicles) vehicles_.push_back(*vehicleAt(v.id, end_ns));
  views_.clear();
  for (const ViewState& v : b->views) views_.push_back(viewBetween(*a, v, s));
  wipers_.clear();
  for (const auto& [wiper, knots] : wiper_knots_) {
    const double from = valueAt(knots, begin_ns), to = valueAt(knots, end_ns);
    wipers_.push_back({wiper, from, extremeBetween(knots, begin_ns, end_ns, from, to), to});
  }
  WeatherState weather = between(a->weather, b->weather, s);
  weather.wind_mps = gusts_.at(index, weather.wind_mps);
  if (by_temperature_) shareOut(weather);
  tick_ = {index, end_ns, weather, vehicles_, views_, wipers_};
  return tick_;
}

void Timeline::prune(int64_t index) {
  const int64_t oldest_ns = tickTimeNs(index) - 1'000'000'000;
  const auto keep = std::ranges::upper_bound(samples_, oldest_ns, {}, &Sample::time_ns);
  if (keep - samples_.begin() > 1) samples_.erase(samples_.begin(), std::prev(keep));
  pruneKnots(oldest_ns, wiper_knots_);
  pruneKnots(oldest_ns, opening_knots_);
}

void Timeline::pruneKnots(int64_t oldest_ns, Knots& all) {
  for (auto& [id, knots] : all) {
    const auto kept = std::ranges::upper_bound(knots, oldest_ns, {}, &Knot::time_ns);
    if (kept - knots.begin() > 1) knots.erase(knots.begin(), std::prev(kept));
  }
}

void Timeline::writeKnots(saved::Writer& a, const Knots& all) {
  const auto count = static_cast<uint32_t>(all.size());
  a(count);
  for (const auto& [id, knots] : all) {
    a(id);
    a.list(knots, knots.size());
  }
}

Timeline::Knots Timeline::readKnots(saved::Reader& a) {
  constexpr uint32_t kMostIds = 1u << 20;
  constexpr size_t kMostKnots = 1u << 26;
  Knots all;
  uint32_t count = 0;
  a.within(count, 0u, kMostIds);
  for (uint32_t i = 0; i < count; ++i) {
    uint32_t id = 0;
    a(id);
    std::vector<Knot>& knots = all[id];
    a.list(knots, kMostKnots);
    a.require(std::ranges::adjacent_find(knots, std::ranges::greater_equal{}, &Knot::time_ns) == knots.end(),
              "knots do not ascend");
  }
  std::erase_if(all, [](const auto& knots) { return knots.second.empty(); });
  return all;
}

void Timeline::write(saved::Writer& a) const {
  a.list(samples_, samples_.size());
  writeKnots(a, wiper_knots_);
  writeKnots(a, opening_knots_);
}

void Timeline::read(saved::Reader& a) {
  constexpr size_t kMostSamples = 1u << 26;
  std::vector<Sample> samples;
  const auto ascends = [](const auto& items, auto key) {
    return std::ranges::adjacent_find(items, std::ranges::greater_equal{}, key) == items.end();
  };
  a.list(samples, kMostSamples);
  a.require(ascends(samples, &Sample::time_ns), "samples do not ascend");
  for (const Sample& s : samples)
    a.require(ascends(s.vehicles, &VehicleState::id) && ascends(s.views, &ViewState::id),
              "ids do not ascend");
  Knots wiper_knots = readKnots(a), opening_knots = readKnots(a);
  if (!a.commits()) return;
  samples_ = std::move(samples);
  wiper_knots_ = std::move(wiper_knots);
  opening_knots_ = std::move(opening_knots);
}

void Timeline::removeVehicle(uint32_t id) {
  for (Sample& s : samples_) std::erase_if(s.vehicles, [id](const VehicleState& v) { return v.id == id; });
}

void Timeline::removeWiper(uint32_t id) { wiper_knots_.erase(id); }
void Timeline::removeOpening(uint32_t pane) { opening_knots_.erase(pane); }

void Timeline::clear() {
  samples_.clear();
  wiper_knots_.clear();
  opening_knots_.clear();
}

void Timeline::rebase(const glm::dvec3& shift_m) {
  for (Sample& s : samples_) {
    for (VehicleState& v : s.vehicles) v.pose.position_m -= shift_m;
    for (ViewState& v : s.views) v.eyeFromWorld[3] += glm::dvec4(glm::dmat3(v.eyeFromWorld) * shift_m, 0.0);
  }
}

}  // namespace rg
