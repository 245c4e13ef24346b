// Snow, sleet and hail through the ABI: what a host tells, what it is told back, and hosts of the first
// header.
#include <cstddef>
#include <vector>

#include "bad_arguments.h"

namespace rg::test {
namespace {

class Precipitation : public BadArguments {
 protected:
  rg_rain_stats statsAfter(int steps) {
    for (int i = 0; i < steps; ++i) {
      scene.expect(scene.step());
      scene.expect(api.step_gpu(scene.instance));
    }
    rg_rain_stats stats{};
    stats.struct_size = sizeof stats;
    scene.expect(api.get_rain_stats(scene.instance, &stats));
    return stats;
  }
  rg_pane_stats pane() const {
    rg_pane_stats stats{};
    stats.struct_size = sizeof stats;
    scene.expect(api.get_pane_stats(scene.instance, kPane, &stats));
    return stats;
  }
};

TEST_F(Precipitation, snowAndHailFallAndAreToldOfEach) {
  scene.rain_mm_h = 2.0;
  scene.snow_mm_h = 4.0;
  scene.hail_mm_h = 300.0;
  scene.temperature_c = 1.0;
  scene.expect(api.reset(scene.instance));
  const rg_rain_stats stats = statsAfter(60);
  EXPECT_EQ(stats.rate_mm_h, 2.0);
  EXPECT_EQ(stats.snow_mm_h, 4.0);
  EXPECT_EQ(stats.hail_mm_h, 300.0);
  EXPECT_GT(stats.live_snow, 100u);
  EXPECT_GT(stats.live_melting, 10u);
  EXPECT_GT(stats.live_hail, 10u);
  EXPECT_GT(stats.bounced, 0u);
  EXPECT_GT(stats.live, stats.live_snow + stats.live_melting + stats.live_hail + stats.live_bounced);
}

TEST_F(Precipitation, ratesOutOfRangeAreRefusedByName) {
  for (const auto& [field, offset] : std::vector<std::pair<const char*, size_t>>{
           {"rg_weather.snow_mm_h", offsetof(rg_weather, snow_mm_h)},
           {"rg_weather.hail_mm_h", offsetof(rg_weather, hail_mm_h)},
           {"rg_weather.ground_height_m", offsetof(rg_weather, ground_height_m)}}) {
    for (const double value : {-2e8, 1e9}) {
      rg_weather weather;
      api.default_weather(&weather);
      std::memcpy(reinterpret_cast<unsigned char*>(&weather) + offset, &value, sizeof value);
      expectRefused(
          field, [&] { return updateWith([&](rg_sample& s) { s.weather = &weather; }); },
          RG_ERROR_BAD_ARGUMENT, field);
    }
  }
}

// A host that was compiled before there was hail: its weather is shorter, and so is what it is told.
TEST_F(Precipitation, hostsOfTheFirstHeaderAreServed) {
  constexpr size_t kWeather = offsetof(rg_weather, hail_mm_h), kStats = offsetof(rg_rain_stats, snow_mm_h);
  rg_weather weather;
  api.default_weather(&weather);
  weather.struct_size = kWeather;
  weather.rain_mm_h = 7.0;
  weather.hail_mm_h = kNaN;  // beyond what it has
  EXPECT_GE(updateWith([&](rg_sample& s) { s.weather = &weather; }), RG_OK);
  weather.struct_size = kWeather + 8;  // no header ever said so
  expectRefused(
      "a weather of half a header", [&] { return updateWith([&](rg_sample& s) { s.weather = &weather; }); },
      RG_ERROR_BAD_STRUCT, "rg_weather");
  rg_rain_stats stats{};
  stats.struct_size = kStats;
  stats.bounced = 77;
  scene.expect(api.get_rain_stats(scene.instance, &stats));
  EXPECT_EQ(stats.struct_size, kStats);
  EXPECT_GT(stats.live, 0u);
  EXPECT_EQ(stats.bounced, 77u);
  // And of each since.
  for (const size_t size :
       {offsetof(rg_rain_stats, ground_water_mm), offsetof(rg_rain_stats, splash_thinning)}) {
    rg_rain_stats later{};
    later.struct_size = static_cast<uint32_t>(size);
    later.splash_thinning = 77.0;
    scene.expect(api.get_rain_stats(scene.instance, &later));
    EXPECT_EQ(later.splash_thinning, 77.0);
  }
}

TEST_F(Precipitation, isSharedOutByTemperatureWhenAskedTo) {
  scene.rain_mm_h = 1.0;
  scene.snow_mm_h = 3.0;
  scene.expect(api.set_parameter(scene.instance, "precipitation.by_temperature", 1.0));
  for (const auto& [celsius, snow_mm_h] : {std::pair{-8.0, 4.0}, {12.0, 0.0}}) {
    scene.temperature_c = celsius;
    const rg_rain_stats stats = statsAfter(4);
    EXPECT_NEAR(stats.snow_mm_h, snow_mm_h, 1e-3);
    EXPECT_NEAR(stats.rate_mm_h, 4.0 - snow_mm_h, 1e-3);
  }
  scene.expect(api.set_parameter(scene.instance, "precipitation.by_temperature", 0.0));
  EXPECT_EQ(statsAfter(4).snow_mm_h, 3.0);
}

// At 10 m/s the pane meets the flakes' water as their law says; what it caught is all accounted for. Stones
// leave nothing.
TEST_F(Precipitation, snowIsCaughtByThePaneAsWaterAndHailIsNot) {
  scene.rain_mm_h = 0.0;
  scene.hail_mm_h = 300.0;
  scene.expect(api.reset(scene.instance));
  statsAfter(60);
  EXPECT_EQ(pane().caught_ml, 0.0);
  scene.hail_mm_h = 0.0;
  scene.snow_mm_h = 5.0;
  scene.temperature_c = -3.0;
  statsAfter(60);
  EXPECT_GT(pane().caught_ml, 0.0);
  EXPECT_LT(pane().ledger_error, 1e-9);
}

}  // namespace
}  // namespace rg::test
