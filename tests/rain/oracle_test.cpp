// The live drops against an oracle that knows nothing of the field's bookkeeping: it goes through every cell
// of the standing lattice near the eye, and follows each drop back in time against every volume as it then
// stood.
#include <gtest/gtest.h>

#include <set>

#include "measure.h"
#include "rain/field.h"
#include "standing_drops.h"

namespace rg::rain::test {
namespace {

constexpr uint64_t kSeed = 21;

struct Roof {
  dvec3 low, high;
  bool on_car = false;
};

struct Trip {
  const char* name;
  double speed_mps, brake_mps2, turn_radps;
  dvec3 wind_mps;
  std::vector<Roof> roofs;
  dvec3 gust_mps{0.0};  // swings of the wind, once in `gust_s`
  double gust_s = 1.0;
  // A prediction may be off by 1 cm before it is taken anew, and the wind's past by as much and 4 cm for each
  // second back: within that of a roof, and as much again, either is right.
  double doubt_m = 0.02;
  double roughness_m = 0.0;
  uint32_t one_of = 1;  // so many drops is asked of: there are many flakes, and they come a long way
  double rain_mm_h = 25.0, snow_mm_h = 0.0, hail_mm_h = 0.0, temperature_c = 12.0;
  WeatherState weather() const {
    WeatherState w;
    w.rain_mm_h = rain_mm_h;
    w.snow_mm_h = snow_mm_h;
    w.hail_mm_h = hail_mm_h;
    w.temperature_c = temperature_c;
    w.ground_height_m = 0.0;
    return w;
  }
  WindProfile profile() const { return WindProfile::of(roughness_m, 1.5); }
  double turnsAt(double t) const { return 2.0 * 3.14159265358979 * t / gust_s; }
  dvec3 windAt(double t) const { return wind_mps + gust_mps * std::sin(turnsAt(t)); }
  // How far the wind carries from 0 to t.
  dvec3 carriedAt(double t) const {
    return wind_mps * t + gust_mps * ((1.0 - std::cos(turnsAt(t))) / turnsAt(1.0));
  }
  // Where the car is; it brakes from 1 s on.
  double xAt(double t) const {
    const double stop = brake_mps2 > 0.0 ? speed_mps / brake_mps2 : 1e9, b = std::clamp(t - 1.0, 0.0, stop);
    const double after = std::max(0.0, t - 1.0 - stop);
    return speed_mps * (t - after) - 0.5 * brake_mps2 * b * b;
  }
  double speedAt(double t) const { return std::max(0.0, speed_mps - brake_mps2 * std::max(0.0, t - 1.0)); }
};
std::ostream& operator<<(std::ostream& out, const Trip& t) { return out << t.name; }

// Whether the straight way from a to b meets the box grown by `more_m`.
bool meetsBox(const Roof& roof, const dvec3& a, const dvec3& b, double more_m) {
  double from = 0.0, to = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = roof.low[axis] - more_m - a[axis], high = roof.high[axis] + more_m - a[axis],
                 way = b[axis] - a[axis];
    if (std::abs(way) < 1e-12) {
      if (low > 0.0 || high < 0.0) return false;
      continue;
    }
    from = std::max(from, std::min(low / way, high / way));
    to = std::min(to, std::max(low / way, high / way));
  }
  return from <= to;
}

// Back in steps of a tick (of slow flakes: of a few) to above every roof, each roof where it then was.
bool wasSheltered(const Trip& trip, const LiveDrop& d, double now_s, double more_m) {
  const double share = trip.profile().drop_share[d.kind];
  const dvec3 own(fallClasses()[d.kind].drift_mps, 0.0);
  const auto placeAt = [&](double t) {
    return d.place_m + share * (trip.carriedAt(t) - trip.carriedAt(now_s)) +
           (own + dvec3(0, 0, d.velocity_mps.z)) * (t - now_s);
  };
  const double step_s = std::max(1.0, std::floor(2.0 / -d.velocity_mps.z)) * kTickSeconds;
  for (double t = now_s; t > now_s - 40.0; t -= step_s) {
    const dvec3 b = placeAt(t), a = placeAt(t - step_s);
    if (b.z > 12.0) return false;
    const dvec3 car_b(trip.xAt(t), 0, 0), car_a(trip.xAt(t - step_s), 0, 0);
    for (const Roof& roof : trip.roofs) {
      const bool meets =
          roof.on_car ? meetsBox(roof, a - car_a, b - car_b, more_m) : meetsBox(roof, a, b, more_m);
      if (meets) return true;
    }
  }
  return false;
}

// Compares at each so many ticks: at every 48th most drops are others than at the last, as those that are
// seen furthest have fallen 3 m.
void compare(const Trip& trip, int every) {
  Field field({.capacity = 200000, .seed = kSeed});
  field.setWindProfile(trip.profile());
  uint32_t id = 0;
  for (const Roof& roof : trip.roofs)
    ASSERT_EQ(setBox(field, ++id, roof.low, roof.high, roof.on_car ? 7 : 0), "");
  Scene scene = sceneWithView(25);
  scene.vehicles.emplace_back().id = 7;
  scene.weather = trip.weather();
  const InTheAir air = InTheAir::of(ratesOf(scene.weather));
  Upload upload;
  std::vector<LiveDrop> live;
  uint64_t compared = 0, sheltered = 0;
  scene.index = -480;  // long enough before for the car to have a past
  for (; scene.index <= 480; ++scene.index) {
    const double t = static_cast<double>(scene.index) * kTickSeconds;
    scene.weather.wind_mps = trip.windAt(t);
    scene.vehicles[0].pose.position_m = {trip.xAt(t), 0, 0};
    scene.vehicles[0].pose.velocity_mps = {trip.speedAt(t), 0, 0};
    scene.views[0].eye_velocity_mps = {trip.speedAt(t), 0, 0};
    look(scene.views[0], {trip.xAt(t), 0, 1.5}, trip.turn_radps * t);
    field.tick(scene.tick());
    if (scene.index < 0 || scene.index % (trip.one_of > 1 ? 2 * every : every) != 0) continue;
    liveDrops(field, upload, live);
    const Cone cone = coneOf(scene.views[0]);
    std::set<DropKey> alive;
    for (const LiveDrop& d : live) alive.insert(d.key);
    uint64_t lost = 0, ghosts = 0;
    for (const LiveDrop& d : standingDrops(kSeed, upload.picture, cone, air, trip.one_of)) {
      ++compared;
      // A stone that is down has bounced.
      const double above_m = d.place_m.z - 0.5 * d.diameter_m;
      const bool is_stone = fallClasses()[d.kind].hydrometeor == Hydrometeor::kHail;
      if (is_stone && above_m < 1e-3) {
        if (above_m < -1e-3 && alive.contains(d.key)) ++ghosts;
        continue;
      }
      const bool lives = alive.contains(d.key), surely_dry = wasSheltered(trip, d, t, -trip.doubt_m);
      if (lives && surely_dry) ++ghosts;
      if (!lives && !wasSheltered(trip, d, t, trip.doubt_m)) ++lost;
      sheltered += surely_dry ? 1 : 0;
    }
    EXPECT_EQ(lost, 0u) << "tick " << scene.index;
    EXPECT_EQ(ghosts, 0u) << "tick " << scene.index;
  }
  EXPECT_GT(compared, trip.one_of > 1 ? 1000u : 20000u);
  EXPECT_GE(sheltered, trip.roofs.empty() ? 0u : trip.one_of > 1 ? 100u : 1000u);
  EXPECT_EQ(field.stats().thinning, 1.0);
}

const std::vector<Roof> kStreet = {
    {{-2, -0.8, 0.2}, {2, 0.8, 1.9}, true}, {{30, -6, 4}, {50, 6, 4.5}}, {{75, -1, 3}, {90, 9, 3.2}}};
const std::vector<Roof> kCanopies = {
    {{12, -6, 3}, {20, 6, 3.2}}, {{26, -1, 3}, {40, 9, 3.2}}, {{46, -8, 3}, {60, 1, 3.1}}};
const std::vector<Roof> kBridges = {
    {{25, -9, 8}, {32, 9, 9}}, {{45, -9, 8}, {50, 9, 9}}, {{60, -2, 8}, {80, 3, 9}}};
Trip inSnow(Trip trip, double snow_mm_h, double temperature_c) {
  trip.rain_mm_h = 0.0;
  trip.snow_mm_h = snow_mm_h;
  trip.temperature_c = temperature_c;
  trip.one_of = 16;
  return trip;
}
Trip inHail(Trip trip) {
  trip.rain_mm_h = 5.0;
  trip.hail_mm_h = 100.0;
  return trip;
}
const auto kTrips = ::testing::Values(
    Trip{"openRoad", 100 * kKmh, 0, 0, {3, 1, 0}, {}}, Trip{"turning", 0, 0, 1.0472, {0, 0, 0}, {}},
    Trip{"throughStreet", 20, 0, 0, {-2, 6, 0}, kStreet},
    Trip{"braking", 100 * kKmh, 9.81, 0, {5, -20, 0}, kStreet},
    Trip{"brakingInASquall", 80 * kKmh, 9.81, 0, {5, -15, 0}, kStreet, {4, 8, 0}, 3, 0.1},
    Trip{"belowCanopiesInGusts", 15, 0, 0, {-1, 2, 0}, kCanopies, {6, 5, 0}, 2, 0.1, 0.1},
    Trip{"belowBridgesInGusts", 20, 0, 0, {-4, 2, 0}, kBridges, {4, 3, 0}, 2, 0.2},
    inSnow({"snowThroughStreet", 15, 0, 0, {-1, 2, 0}, kStreet}, 0.5, -5),
    inSnow({"sleetBraking", 60 * kKmh, 9.81, 0, {2, -3, 0}, kStreet}, 0.5, 1),
    inHail({"hailBelowCanopies", 15, 0, 0, {3, 5, 0}, kCanopies}));

class Oracle : public ::testing::TestWithParam<Trip> {};
TEST_P(Oracle, findsTheSameLiveDrops) { compare(GetParam(), 48); }
INSTANTIATE_TEST_SUITE_P(Trips, Oracle, kTrips, [](const auto& given) { return given.param.name; });

class OracleAtMoreTicks : public ::testing::TestWithParam<Trip> {};
TEST_P(OracleAtMoreTicks, findsTheSameLiveDrops) { compare(GetParam(), 8); }
INSTANTIATE_TEST_SUITE_P(Long, OracleAtMoreTicks, kTrips, [](const auto& given) { return given.param.name; });

// Whoever looked when: a field that has just been taken to the tick has the drops of one that ran there.
TEST(Seeking, findsTheDropsOfTheFieldThatRan) {
  Field ran({.capacity = 200000, .seed = kSeed}), sought({.capacity = 200000, .seed = kSeed});
  for (Field* field : {&ran, &sought}) ASSERT_EQ(setBox(*field, 1, {30, -6, 4}, {50, 6, 4.5}), "");
  Scene scene = sceneWithView(25);
  scene.weather.wind_mps = {-2, 6, 0};
  place(scene, 20, 0.0);
  sought.tick(scene.tick());
  for (; scene.index <= 200; ++scene.index) {
    place(scene, 20, 0.0);
    ran.tick(scene.tick());
  }
  scene.index = 200;
  sought.seek(200);
  sought.tick(scene.tick());
  Upload upload;
  std::vector<LiveDrop> a, b;
  liveDrops(ran, upload, a);
  liveDrops(sought, upload, b);
  std::set<DropKey> of_a, of_b;
  for (const LiveDrop& d : a) of_a.insert(d.key);
  for (const LiveDrop& d : b) of_b.insert(d.key);
  EXPECT_GT(of_a.size(), 1000u);
  EXPECT_EQ(of_a, of_b);
}

}  // namespace
}  // namespace rg::rain::test
