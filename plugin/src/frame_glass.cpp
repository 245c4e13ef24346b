// What the glass is told each tick: from the world's weather and the vehicle's motion to rain, air and
// gravity as the pane feels them.
#include <algorithm>
#include <cmath>

#include "frame.h"
#include "glass/pane_map.h"
#include "rain/size_law.h"

namespace rg {
namespace {

constexpr glm::dvec3 kGravity_mps2{0.0, 0.0, -9.81};
constexpr int64_t kShelterTicks =
    6;                          // shelter of a pane is asked anew 20 times a second: 1.4 m of way at 100 km/h
constexpr int kSizeSteps = 16;  // quadrature of a class's mean volume

// A class by its number, its speed and the diameter of its mean volume.
glass::SizeClass sizeClass(const rain::SizeLaw& law, const rain::SpeedClass& c) {
  double cubes = 0.0;
  for (int i = 0; i < kSizeSteps; ++i)
    cubes += std::pow(law.quantile(c.from_mm, c.to_mm, (i + 0.5) / kSizeSteps), 3.0);
  return {std::cbrt(cubes / kSizeSteps) * 1e-3, law.numberDensity(c.from_mm, c.to_mm), c.speed_mps,
          glm::dvec3(0.0)};
}

uint32_t sizeClasses(double rate_mm_h, std::array<glass::SizeClass, glass::kMaxSizeClasses>& classes) {
  const rain::SizeLaw law = rain::SizeLaw::of(rate_mm_h);
  if (!(law.n0_per_m3_mm > 0.0)) return 0;
  uint32_t count = 0;
  double delivered_mps = 0.0;
  for (const rain::SpeedClass& c : rain::speedClasses()) {
    classes[count] = sizeClass(law, c);
    delivered_mps += classes[count].number_per_m3 * std::pow(classes[count].diameter_m, 3.0) *
                     glm::pi<double>() / 6.0 * classes[count].fall_speed_mps;
    ++count;
  }
  // A class's drops all fall at its speed here; the rest of a per cent goes into the number, so that the
  // delivered water is the asked rate.
  const double scale = rate_mm_h / 3.6e6 / delivered_mps;
  for (uint32_t i = 0; i < count; ++i) classes[i].number_per_m3 *= scale;
  return count;
}

}  // namespace

void Frame::tickGlass(const Tick& tick) {
  if (panes_.empty()) return;
  if (tick.weather.rain_mm_h != classes_rate_mm_h_) {
    classes_rate_mm_h_ = tick.weather.rain_mm_h;
    class_count_ = sizeClasses(classes_rate_mm_h_, classes_);
  }
  for (auto& [id, p] : panes_) {
    if (!p.active) continue;
    const auto vehicle = std::ranges::find(tick.vehicles, p.vehicle, &VehicleState::id);
    if (vehicle == tick.vehicles.end()) continue;
    glass::PaneTick t;
    const glm::dquat vehicleFromWorld = glm::conjugate(vehicle->pose.orientation);
    t.index = ++p.tick;
    t.acceleration_mps2 = vehicleFromWorld * (kGravity_mps2 - vehicle->acceleration_mps2);
    t.air_mps =
        vehicleFromWorld * (wind_profile_.air_share * tick.weather.wind_mps - vehicle->pose.velocity_mps);
    t.down = vehicleFromWorld * glm::dvec3(0.0, 0.0, -1.0);
    t.temperature_c = tick.weather.temperature_c;
    t.humidity = tick.weather.humidity;
    t.class_count = class_count_;
    t.classes = classes_;
    const glm::dvec3 wind_mps = vehicleFromWorld * tick.weather.wind_mps;
    for (uint32_t i = 0; i < class_count_; ++i)
      t.classes[i].drift_mps = (wind_profile_.drop_share[i] - wind_profile_.air_share) * wind_mps;
    if (p.tick % kShelterTicks == 1) updateShelter(p, *vehicle, tick);
    t.wet_share = p.wet_share;
    for (const WiperMotion& w : tick.wipers) {
      const auto known = wipers_.find(w.wiper);
      if (known == wipers_.end() || known->second.pane != id || t.wiper_count >= t.wipers.size()) continue;
      t.wipers[t.wiper_count++] = {w.wiper, w.from_rad, w.extreme_rad, w.to_rad};
    }
    p.sim->submit(t);
  }
}

// Each region of the pane looks up along the way its rain comes: the mean drop's, against the wind. The
// pane's own car gives it no shelter: its cabin lies right behind the glass, and its roof is over it only
// where the glass faces down.
void Frame::updateShelter(PaneObject& p, const VehicleState& vehicle, const Tick& tick) {
  const rain::SizeLaw law = rain::SizeLaw::of(std::max(tick.weather.rain_mm_h, 0.1));
  const double fall_mps = rain::fallSpeed(law.meanDiameterReachingGround_mm());
  const glm::dvec3 drop_mps =
      wind_profile_.dropShare(fall_mps) * tick.weather.wind_mps - glm::dvec3(0.0, 0.0, fall_mps);
  for (int region = 0; region < glass::kRegions; ++region) {
    const auto centre = p.sim->map().regionCentre(region);
    if (!centre) continue;
    const glm::dvec3 at = vehicle.pose.position_m + vehicle.pose.orientation * *centre;
    p.wet_share[static_cast<size_t>(region)] = field_.openToSky(at, drop_mps, p.vehicle) ? 1.0f : 0.0f;
  }
}

}  // namespace rg
