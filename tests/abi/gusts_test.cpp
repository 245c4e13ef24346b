// Gusts: the statistics they are asked for, the same for the same seed and tick, and in rain and glass alike.
#include "gusts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rain/wind_profile.h"
#include "small_scene.h"
#include "tick.h"

namespace rg {
namespace {

using glm::dvec3;

// ---- statistics ----

constexpr double kShare = 0.2, kTime_s = 5.0, kMean_mps = 10.0;
constexpr int64_t kEvery = 30;  // ticks between looks
constexpr double kStep_s = kEvery * kTickSeconds;

struct Swings {
  std::vector<double> along, across;  // by the mean, of one seed after the other
};
// 320 000 s, 64 000 gusts: what is found of means is off by some 1 / sqrt(32 000) = 0.6 % of a deviation.
constexpr uint64_t kSeeds = 8;
constexpr size_t kLooks = 160000;
const Swings& swings() {
  static const Swings found = [] {
    Swings s;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
      for (size_t i = 0; i < kLooks; ++i) {
        const dvec3 wind = Gusts{seed, kShare, kTime_s}.at(static_cast<int64_t>(i) * kEvery, {6, 8, 1});
        EXPECT_EQ(wind.z, 1.0);
        s.along.push_back((0.6 * wind.x + 0.8 * wind.y) / kMean_mps - 1.0);
        s.across.push_back((0.6 * wind.y - 0.8 * wind.x) / kMean_mps);
      }
    }
    return s;
  }();
  return found;
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double deviationOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// How what is seen at one look goes with what is seen `later` looks on.
double correlation(const std::vector<double>& values, size_t later) {
  double together = 0.0, alone = 0.0;
  for (size_t seed = 0; seed < kSeeds; ++seed) {
    for (size_t i = seed * kLooks; i + later < (seed + 1) * kLooks; ++i) {
      together += values[i] * values[i + later];
      alone += values[i] * values[i];
    }
  }
  return together / alone;
}

// The mean of so many gusts is off by 0.56 % of a deviation; four of those.
TEST(Gusts, haveTheGivenWindAsTheirMean) {
  EXPECT_NEAR(meanOf(swings().along), 0.0, 0.0225 * kShare);
  EXPECT_NEAR(meanOf(swings().across), 0.0, 0.0225 * kShare);
}

TEST(Gusts, deviateAsAskedAlongTheWindAndByFourFifthsAcross) {
  EXPECT_NEAR(deviationOf(swings().along), kShare, 0.02 * kShare);
  EXPECT_NEAR(deviationOf(swings().across), 1.92 / 2.39 * kShare, 0.02 * kShare);
}

// The sum reaches to where gusts have nothing to do with each other (four knots of the slowest octave, 5.5
// times the integral time), and has an error of about 1.5 %.
TEST(Gusts, lastAsLongAsAsked) {
  for (const auto* values : {&swings().along, &swings().across}) {
    double time_s = 0.5 * kStep_s;
    for (size_t later = 1; static_cast<double>(later) * kStep_s < 5.5 * kTime_s; ++later)
      time_s += correlation(*values, later) * kStep_s;
    EXPECT_NEAR(time_s, kTime_s, 0.06 * kTime_s);
    EXPECT_NEAR(correlation(*values, static_cast<size_t>(6.0 * kTime_s / kStep_s)), 0.0, 0.03);
  }
}

// Along and across, and what one seed has and the next, have nothing to do with each other.
TEST(Gusts, areIndependentAlongAndAcrossAndFromSeedToSeed) {
  double crossed = 0.0, seeds = 0.0;
  const auto& [along, across] = swings();
  for (size_t i = 0; i < along.size(); ++i) crossed += along[i] * across[i];
  for (size_t i = 0; i + kLooks < along.size(); ++i) seeds += along[i] * along[i + kLooks];
  const double n = static_cast<double>(along.size());
  EXPECT_NEAR(crossed / n, 0.0, 0.03 * kShare * kShare);
  EXPECT_NEAR(seeds / n, 0.0, 0.03 * kShare * kShare);
}

// Their spectrum ends: from tick to tick the wind changes by less than a fiftieth of a deviation.
TEST(Gusts, areSmooth) {
  const Gusts gusts{3, kShare, kTime_s};
  double before = gusts.at(0, {kMean_mps, 0, 0}).x, most_mps = 0.0;
  for (int64_t tick = 1; tick < 200000; ++tick) {
    const double now = gusts.at(tick, {kMean_mps, 0, 0}).x;
    most_mps = std::max(most_mps, std::abs(now - before));
    before = now;
  }
  EXPECT_LT(most_mps, 0.02 * kShare * kMean_mps);
}

TEST(Gusts, dependOnSeedAndTickAloneHoweverFarOff) {
  for (const int64_t tick : {INT64_C(-300'000'000'000), INT64_C(-1), INT64_C(0), INT64_C(300'000'000'000)}) {
    const Gusts gusts{7, kShare, kTime_s};
    const dvec3 wind = gusts.at(tick, {kMean_mps, 0, 0}), next = gusts.at(tick + 1, {kMean_mps, 0, 0});
    EXPECT_EQ(wind, gusts.at(tick, {kMean_mps, 0, 0}));
    EXPECT_LT(glm::distance(wind, next), 0.05 * kShare * kMean_mps) << tick;
    EXPECT_NE(wind, (Gusts{8, kShare, kTime_s}.at(tick, {kMean_mps, 0, 0})));
    EXPECT_NE(wind, (Gusts{7 + (UINT64_C(1) << 40), kShare, kTime_s}.at(tick, {kMean_mps, 0, 0})));
  }
}

TEST(Gusts, areNoneWhereNoneAreAskedForAndStayWithinTheStrongestWind) {
  const dvec3 wind(3.3, -4.4, 0.7);
  EXPECT_EQ((Gusts{1, 0.0, kTime_s}.at(12345, wind)), wind);
  EXPECT_EQ((Gusts{1, 0.5, kTime_s}.at(12345, {0, 0, 2})), dvec3(0, 0, 2));
  double strongest = 0.0;
  for (int64_t tick = 0; tick < 100000; ++tick) {
    const dvec3 storm = Gusts{1, 0.5, kTime_s}.at(tick, {100, -100, 100});
    for (int i = 0; i < 3; ++i) strongest = std::max(strongest, std::abs(storm[i]));
  }
  EXPECT_EQ(strongest, 100.0);
}

// ---- through the ABI ----

// A car stands in the wind with an upright pane that faces it.
class WindyCar {
 public:
  explicit WindyCar(uint64_t seed = 1) {
    rg_create_info info;
    api().default_create_info(&info);
    info.seed = seed;
    info.max_drops = 20000;
    if (api().create(&info, &instance_) != RG_OK) throw std::runtime_error(api().last_error(nullptr));
    const std::array<float, 12> positions{1, 0.2f, 1, 1, -0.2f, 1, 1, -0.2f, 1.4f, 1, 0.2f, 1.4f};
    const std::array<float, 8> uvs{0, 0, 1, 0, 1, 1, 0, 1};
    const std::array<uint32_t, 6> indices{0, 2, 1, 0, 3, 2};
    rg_pane_info pane;
    api().default_pane_info(&pane);
    pane.vehicle = test::kCar;
    pane.positions_m = positions.data();
    pane.uvs = uvs.data();
    pane.indices = indices.data();
    pane.vertex_count = 4;
    pane.index_count = 6;
    pane.texel_m = 10e-3;
    pane.max_drops = 0;
    if (api().set_pane(instance_, test::kPane, &pane) != RG_OK)
      throw std::runtime_error(api().last_error(instance_));
  }
  ~WindyCar() { api().destroy(instance_); }
  WindyCar(const WindyCar&) = delete;
  WindyCar& operator=(const WindyCar&) = delete;

  WindyCar& set(const char* name, double value) {
    EXPECT_EQ(api().set_parameter(instance_, name, value), RG_OK) << api().last_error(instance_);
    return *this;
  }

  // To a tick's time, with a sample at each tick, `ticks_an_update` at once.
  WindyCar& run(int64_t until, int64_t ticks_an_update, double wind_mps) {
    rg_weather weather;
    api().default_weather(&weather);
    weather.rain_mm_h = 50.0;
    weather.wind_mps[0] = -wind_mps;
    rg_vehicle car;
    api().default_vehicle(&car);
    car.id = test::kCar;
    const rg_view view = test::viewAlongX(api(), {0, 0, 1.2}, 64, {});
    while (tick_ < until) {
      std::vector<rg_sample> samples;
      for (int64_t i = 0; i < ticks_an_update && tick_ < until; ++i) {
        rg_sample& sample = samples.emplace_back();
        api().default_sample(&sample);
        sample.time_ns = tickTimeNs(++tick_);
        sample.weather = &weather;
        sample.vehicles = &car;
        sample.vehicle_count = 1;
        sample.views = &view;
        sample.view_count = 1;
      }
      EXPECT_GE(api().update(instance_, tickTimeNs(tick_), samples.data(),
                             static_cast<uint32_t>(samples.size()), sizeof(rg_sample)),
                0)
          << api().last_error(instance_);
    }
    return *this;
  }

  uint64_t hash(rg_hash_kind kind) const {
    uint64_t value = 0;
    EXPECT_EQ(api().get_hash(instance_, kind, &value), RG_OK);
    return value;
  }
  double caught_ml() const {
    rg_pane_stats stats{};
    stats.struct_size = sizeof stats;
    EXPECT_EQ(api().get_pane_stats(instance_, test::kPane, &stats), RG_OK);
    return stats.caught_ml;
  }

 private:
  const rg_api& api() const { return *library_.api; }
  // Its own, so that nothing keeps the library loaded when the car is gone.
  test::PluginLibrary library_;
  rg_instance* instance_ = nullptr;
  int64_t tick_ = 0;
};

constexpr double kGusty = 0.3, kBreeze_mps = 8.0;

TEST(GustyState, isTheSameHoweverTimeIsCut) {
  const auto hashes = [](int64_t ticks_an_update) {
    WindyCar car;
    car.set("wind.gust_share", kGusty).set("wind.gust_time_s", 5).set("wind.roughness_m", 0.1);
    car.run(300, ticks_an_update, kBreeze_mps);
    return std::pair(car.hash(RG_HASH_RAIN), car.hash(RG_HASH_STATE));
  };
  const auto at_each_tick = hashes(1);
  EXPECT_EQ(hashes(1), at_each_tick);
  EXPECT_EQ(hashes(7), at_each_tick);
  EXPECT_EQ(hashes(300), at_each_tick);
}

TEST(GustyState, dependsOnTheSeedTheGustsAndTheProfile) {
  const auto hash = [](uint64_t seed, double share, double roughness_m) {
    WindyCar car(seed);
    car.set("wind.gust_share", share).set("wind.roughness_m", roughness_m);
    return car.run(60, 10, kBreeze_mps).hash(RG_HASH_RAIN);
  };
  const uint64_t plain = hash(1, 0, 0);
  EXPECT_NE(hash(1, kGusty, 0), plain);
  EXPECT_NE(hash(1, 0, 0.1), plain);
  EXPECT_NE(hash(2, kGusty, 0), hash(1, kGusty, 0));
}

// Water that the wind drives against an upright pane: sum over sizes of N V_D and their share of the wind.
// Some 27 000 drops, of which the heavy ones count most: 2 %, four standard errors of it are 8.
TEST(GustyState, rainDrivesAgainstGlassWithTheWindThatDropsHave) {
  constexpr double kWind_mps = 10.0, kArea_m2 = 0.16, kSeconds = 10.0;
  for (const double roughness_m : {0.0, 0.1}) {
    const rain::WindProfile profile = rain::WindProfile::of(roughness_m, 1.5);
    const rain::SizeLaw law = rain::SizeLaw::of(50.0);
    double water_m3_m3 = 0.0;  // weighted with the drops' share
    for (double d_mm = 0.505; d_mm < 6.0; d_mm += 0.01) {
      water_m3_m3 += law.numberDensity(d_mm - 0.005, d_mm + 0.005) * 3.14159265 / 6.0 *
                     std::pow(1e-3 * d_mm, 3) * profile.dropShare(rain::fallSpeed(d_mm));
    }
    WindyCar car;
    car.set("wind.roughness_m", roughness_m).run(static_cast<int64_t>(kSeconds * kTickHz), 60, kWind_mps);
    const double expected_ml = 1e6 * water_m3_m3 * kWind_mps * kArea_m2 * kSeconds;
    EXPECT_NEAR(car.caught_ml(), expected_ml, 0.08 * expected_ml) << "z0 " << roughness_m;
  }
}

// In gusts the pane catches, second by second, what the wind at those ticks drives against it.
TEST(GustyState, glassHasTheSameGustsAsTheRain) {
  constexpr int64_t kTicks = 2400;
  WindyCar gusty, calm;
  gusty.set("wind.gust_share", 0.5).set("wind.gust_time_s", 5);
  double gusty_before = 0.0, calm_before = 0.0, together = 0.0, alone = 0.0;
  for (int64_t tick = 120; tick <= kTicks; tick += 120) {
    const double gusty_ml = gusty.run(tick, 30, kBreeze_mps).caught_ml(),
                 calm_ml = calm.run(tick, 30, kBreeze_mps).caught_ml();
    double wind_mps = 0.0;  // mean of the second, towards the pane
    for (int64_t k = tick - 119; k <= tick; ++k)
      wind_mps += std::max(0.0, -Gusts{1, 0.5, 5.0}.at(k, {-kBreeze_mps, 0, 0}).x) / 120.0;
    const double by_wind = wind_mps / kBreeze_mps - 1.0,
                 by_water = (gusty_ml - gusty_before) / (calm_ml - calm_before) - 1.0;
    together += by_wind * by_water;
    alone += by_wind * by_wind;
    gusty_before = gusty_ml;
    calm_before = calm_ml;
  }
  // The slope of water on wind; a second's catch is off by 7 %, against gusts of 50 % in twenty seconds.
  EXPECT_NEAR(together / alone, 1.0, 0.2);
}

}  // namespace
}  // namespace rg
