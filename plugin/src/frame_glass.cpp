// What the glass is told each tick: from the world's weather and the vehicle's motion to rain, air and
// gravity as the pane feels them.
#include <algorithm>
#include <cmath>
#include <utility>

#include "frame.h"
#include "glass/pane_map.h"
#include "glass/slide.h"
#include "gravity.h"
#include "rain/hydrometeors.h"

namespace rg {
namespace {

constexpr glm::dvec3 kWeight_mps2{0.0, 0.0, -kGravity_mps2};
constexpr int64_t kShelterTicks =
    6;                          // shelter of a pane is asked anew 20 times a second: 1.4 m of way at 100 km/h
constexpr int kSizeSteps = 16;  // quadrature of a class's mean volume

using rain::Hydrometeor;

// A class by its number, its speed and the diameter of its mean volume: of flakes that of the drop they melt
// to.
glass::SizeClass sizeClass(const rain::InTheAir& air, uint32_t kind) {
  double cubes = 0.0;
  for (int i = 0; i < kSizeSteps; ++i) cubes += std::pow(air.quantile(kind, (i + 0.5) / kSizeSteps), 3.0);
  return {std::cbrt(cubes / kSizeSteps) * 1e-3, air.density_m3[kind], rain::fallClasses()[kind].speed_mps,
          glm::dvec3(0.0)};
}

double delivered_mps(const glass::SizeClass& c) {
  return c.number_per_m3 * std::pow(c.diameter_m, 3.0) * glm::pi<double>() / 6.0 * c.fall_speed_mps;
}

// Of snow, a size's drift groups as one: beside each other they drift nowhere.
glass::SizeClass flakesOfASize(const rain::InTheAir& air, uint32_t first) {
  glass::SizeClass flakes = sizeClass(air, first);
  flakes.number_per_m3 = flakes.fall_speed_mps = 0.0;
  for (uint32_t kind = first; kind < first + rain::kDriftGroups; ++kind) {
    flakes.number_per_m3 += air.density_m3[kind];
    flakes.fall_speed_mps += rain::fallClasses()[kind].speed_mps / rain::kDriftGroups;
  }
  return flakes;
}

struct OnGlass {
  std::array<glass::SizeClass, glass::kMaxSizeClasses>& classes;
  std::array<uint32_t, glass::kMaxSizeClasses>& class_of;
  uint32_t count = 0;
  void add(const glass::SizeClass& c, uint32_t kind) {
    classes[count] = c;
    class_of[count++] = kind;
  }
  // A class's drops all fall at its speed here; the rest of a per cent goes into the number, so that the
  // water delivered by those from `first` on is the asked rate.
  void scale(uint32_t first, double rate_mm_h) {
    double sum_mps = 0.0;
    for (uint32_t i = first; i < count; ++i) sum_mps += delivered_mps(classes[i]);
    for (uint32_t i = first; i < count; ++i) classes[i].number_per_m3 *= rate_mm_h / 3.6e6 / sum_mps;
  }
};

// Stones are not among them: they bounce off.
void fillSizeClasses(const rain::Rates& rates, OnGlass& on_glass) {
  const rain::InTheAir air = rain::InTheAir::of(rates);
  const auto add = [&](Hydrometeor hydrometeor, uint32_t begin, uint32_t end, uint32_t step, auto&& made) {
    if (!(rates[hydrometeor] > 0.0)) return;
    const uint32_t first = on_glass.count;
    for (uint32_t kind = begin; kind < end; kind += step) on_glass.add(made(air, kind), kind);
    on_glass.scale(first, rates[hydrometeor]);
  };
  add(Hydrometeor::kRain, 0, rain::kFirstSnow, 1, sizeClass);
  add(Hydrometeor::kSnow, rain::kFirstSnow, rain::kFirstMelting, rain::kDriftGroups, flakesOfASize);
  add(Hydrometeor::kMeltingSnow, rain::kFirstMelting, rain::kFirstHail, 1, sizeClass);
}

// The fall of what brings the water: of rain that of the mean drop reaching the ground, of snow that of its
// classes; together their mean by water.
double typicalFall_mps(const rain::Rates& rates, const OnGlass& on_glass) {
  const rain::SizeLaw law = rain::SizeLaw::of(std::max(rates[Hydrometeor::kRain], 0.1));
  const double fall_mps = rain::fallSpeed(law.meanDiameterReachingGround_mm());
  double water = rates[Hydrometeor::kRain] / 3.6e6, sum = water * fall_mps;
  for (uint32_t i = 0; i < on_glass.count; ++i) {
    if (on_glass.class_of[i] < rain::kFirstSnow) continue;
    const double of_class = delivered_mps(on_glass.classes[i]);
    water += of_class;
    sum += of_class * on_glass.classes[i].fall_speed_mps;
  }
  return water > 0.0 ? sum / water : fall_mps;
}

}  // namespace

void Frame::tickGlass(const Tick& tick) {
  if (panes_.empty()) return;
  if (const rain::Rates rates = rain::ratesOf(tick.weather);
      rates != glass_rates_ || glass_fall_mps_ == 0.0) {
    glass_rates_ = rates;
    OnGlass on_glass{classes_, class_of_};
    fillSizeClasses(rates, on_glass);
    class_count_ = on_glass.count;
    glass_fall_mps_ = typicalFall_mps(rates, on_glass);
  }
  ++glass_moment_;
  std::vector<std::pair<glass::PaneSim*, glass::PaneTick>> ticks;
  ticks.reserve(panes_.size());
  for (auto& [id, p] : panes_) {
    if (!p.active) continue;
    const auto vehicle = std::ranges::find(tick.vehicles, p.vehicle, &VehicleState::id);
    if (vehicle == tick.vehicles.end()) continue;
    glass::PaneTick t;
    const glm::dquat vehicleFromWorld = glm::conjugate(vehicle->pose.orientation);
    t.index = ++p.tick;
    t.moment = glass_moment_;
    t.run_off = settings_.glass_run_off;
    t.acceleration_mps2 = vehicleFromWorld * (kWeight_mps2 - vehicle->acceleration_mps2);
    t.air_mps =
        vehicleFromWorld * (wind_profile_.air_share * tick.weather.wind_mps - vehicle->pose.velocity_mps);
    t.down = vehicleFromWorld * glm::dvec3(0.0, 0.0, -1.0);
    t.temperature_c = tick.weather.temperature_c;
    t.humidity = tick.weather.humidity;
    t.class_count = class_count_;
    t.classes = classes_;
    const glm::dvec3 wind_mps = vehicleFromWorld * tick.weather.wind_mps;
    for (uint32_t i = 0; i < class_count_; ++i)
      t.classes[i].drift_mps = (wind_profile_.drop_share[class_of_[i]] - wind_profile_.air_share) * wind_mps;
    t.opening_m = openingOf_m(id, p, tick.time_ns);
    if (p.tick % kShelterTicks == 1) updateShelter(p, *vehicle, tick, t.opening_m);
    t.wet_share = p.wet_share;
    for (const WiperMotion& w : tick.wipers) {
      const auto known = wipers_.find(w.wiper);
      if (known == wipers_.end() || known->second.pane != id || t.wiper_count >= t.wipers.size()) continue;
      t.wipers[t.wiper_count++] = {w.wiper, w.from_rad, w.extreme_rad, w.to_rad};
    }
    tickWashes(id, tick, t);
    tickFog(p, t);
    ticks.emplace_back(p.sim.get(), t);
  }
  // A pane's tick needs none of its neighbours' at the same time, see Pillar.
  workers_.share(ticks.size(), [&ticks](size_t i) { ticks[i].first->submit(ticks[i].second); });
  std::erase_if(washes_, [](const WashObject& wash) { return wash.given_pl == wash.volume_pl; });
}

// Vapour and warmth change slowly: ten steps a second. A cabin without vapour costs nothing, and a mirror has
// none behind it.
void Frame::tickFog(PaneObject& p, const glass::PaneTick& tick) const {
  constexpr int64_t kTicks = 12;
  const bool wanted = p.mirror == 0.0 && (settings_.fog_cabin_humidity > 0.0 || !p.fog->empty());
  if (!wanted || tick.index % kTicks != 0) return;
  const glass::FogAir air{tick.temperature_c,           tick.humidity,
                          glm::length(tick.air_mps),    settings_.fog_cabin_temperature_c,
                          settings_.fog_cabin_humidity, settings_.fog_demister * p.demister,
                          settings_.fog_demister_c};
  p.fog->step(air, static_cast<double>(kTicks) / static_cast<double>(kTickHz));
}

// As much of each jet's water as its time has run: shares of the whole, so that all of it comes to the last
// picolitre.
void Frame::tickWashes(uint32_t pane, const Tick& tick, glass::PaneTick& out) {
  for (WashObject& wash : washes_) {
    if (wash.pane != pane || tick.time_ns <= wash.begin_ns) continue;
    const double run =
        static_cast<double>(tick.time_ns - wash.begin_ns) / static_cast<double>(wash.end_ns - wash.begin_ns);
    const int64_t due_pl =
        run >= 1.0 ? wash.volume_pl : static_cast<int64_t>(static_cast<double>(wash.volume_pl) * run);
    out.washings[out.washing_count++] = {wash.jet, due_pl - std::exchange(wash.given_pl, due_pl)};
  }
}

// Each region of the pane looks up along the way its rain comes: the mean drop's, against the wind. The
// pane's own car gives it no shelter: its cabin lies right behind the glass, and its roof is over it only
// where the glass faces down.
void Frame::updateShelter(PaneObject& p, const VehicleState& vehicle, const Tick& tick, double opening_m) {
  const glm::dvec3 slid_m = opening_m * p.sim->slide().direction();
  const double fall_mps = glass_fall_mps_;
  const glm::dvec3 drop_mps =
      wind_profile_.dropShare(fall_mps) * tick.weather.wind_mps - glm::dvec3(0.0, 0.0, fall_mps);
  for (int region = 0; region < glass::kRegions; ++region) {
    const auto centre = p.sim->map().regionCentre(region);
    if (!centre) continue;
    const glm::dvec3 at = vehicle.pose.position_m + vehicle.pose.orientation * (*centre + slid_m);
    p.wet_share[static_cast<size_t>(region)] = field_.openToSky(at, drop_mps, p.vehicle) ? 1.0f : 0.0f;
  }
}

}  // namespace rg
