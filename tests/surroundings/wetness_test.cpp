// Water on open ground: what comes, what runs off, what dries.
#include "surroundings/wetness.h"

#include <gtest/gtest.h>

#include "scene.h"

namespace rg::surroundings::test {
namespace {

void run(Wetness& wetness, Scene& scene, double seconds) {
  const auto until = scene.index + static_cast<int64_t>(seconds * static_cast<double>(kTickHz));
  for (; scene.index < until; ++scene.index) wetness.tick(scene.tick());
}

TEST(Wetness, isWhatFellLessWhatDriedAndRanOff) {
  Scene scene = sceneOnGround(6.0);
  scene.weather.temperature_c = 20.0;
  scene.weather.humidity = 0.5;
  scene.weather.wind_mps = {3.0, 0.0, 0.0};
  const double dries_mm_h = evaporation_mm_h(20.0, 0.5, 3.0);
  Wetness wetness;
  run(wetness, scene, 300.0);
  EXPECT_NEAR(wetness.water_mm(), (6.0 - dries_mm_h) / 12.0, 1e-9);
  run(wetness, scene, 900.0);
  EXPECT_EQ(wetness.water_mm(), kMostOnGround_mm);
  scene.weather.rain_mm_h = 0.0;
  run(wetness, scene, 600.0);
  EXPECT_NEAR(wetness.water_mm(), kMostOnGround_mm - dries_mm_h / 6.0, 1e-9);
  run(wetness, scene, kMostOnGround_mm / dries_mm_h * 3600.0);
  EXPECT_EQ(wetness.water_mm(), 0.0);
}

// Penman's own numbers: 1 mmHg that is missing (at 20 C and 94.3 %) dries 0.35 mm a day in still air.
TEST(Wetness, driesByTheAirsHunger) {
  EXPECT_NEAR(evaporation_mm_h(20.0, 1.0 - 1.0 / 17.54, 0.0) * 24.0, 0.35, 0.01);
  EXPECT_NEAR(evaporation_mm_h(20.0, 0.5, 5.0), 3.7 * evaporation_mm_h(20.0, 0.5, 0.0), 1e-9);
  EXPECT_EQ(evaporation_mm_h(20.0, 1.0, 5.0), 0.0);
}

}  // namespace
}  // namespace rg::surroundings::test
