// The fogged inner side: dew point, mass transfer, ledger, and the demister that clears it from below.
#include "glass/fog.h"

#include <gtest/gtest.h>

#include <random>

#include "glass/water.h"
#include "scene.h"

namespace rg::test {
namespace {

using glass::Fog, glass::FogAir;
constexpr double kStep_s = 0.1;  // as Frame steps it

class FoggedPane : public ::testing::Test {
 protected:
  FoggedPane() : mesh_(windscreen()), map_(paneInfo(mesh_)), fog_(map_) {}
  // Warmth of the glass before anything has condensed.
  double glassAtFirst_c(FogAir air) const {
    Fog other(map_);
    air.cabin_humidity = air.demister = 0.0;
    other.step(air, 1e-9);
    return other.glassAt_c({16, 8});
  }
  static double area_m2(const Fog& fog) {
    double sum = 0.0;
    for (int k = 0; k < Fog::kCells.x * Fog::kCells.y; ++k)
      sum += fog.areaAt_m2({k % Fog::kCells.x, k / Fog::kCells.x});
    return sum;
  }
  static double mass_kg_m2(const Fog& fog) {
    return static_cast<double>(fog.stats().on_glass_pl) * 1e-12 / area_m2(fog);
  }

  Mesh mesh_;
  glass::PaneMap map_;
  Fog fog_;
  FogAir winter_{5.0, 0.9, 10.0, 20.0, 0.6};
};

TEST_F(FoggedPane, fogsAtTheDewPointAndNotAboveIt) {
  const double glass_c = glassAtFirst_c(winter_);
  const double at_dew = glass::saturatedVapour_kg_m3(glass_c) / glass::saturatedVapour_kg_m3(winter_.cabin_c);
  winter_.cabin_humidity = at_dew * 0.995;
  for (int k = 0; k < 600; ++k) fog_.step(winter_, kStep_s);
  EXPECT_TRUE(fog_.empty());
  winter_.cabin_humidity = at_dew * 1.005;
  for (int k = 0; k < 600; ++k) fog_.step(winter_, kStep_s);
  EXPECT_FALSE(fog_.empty());
}

TEST_F(FoggedPane, aDryCabinNeverFogs) {
  winter_.cabin_humidity = 0.0;
  for (int k = 0; k < 600; ++k) fog_.step(winter_, kStep_s);
  EXPECT_EQ(fog_.stats().condensed_pl, 0);
}

// EN 673's warmth of the glass, Chilton & Colburn's transfer: numbers put in by hand here.
TEST_F(FoggedPane, condensesAsHeatAndVapourGoTogether) {
  const double out = 7.2 * std::pow(10.0, 0.78) + 4.4;
  const double glass_c = (out * 5.0 + 8.0 * 20.0) / (out + 8.0);
  EXPECT_NEAR(glassAtFirst_c(winter_), glass_c, 1e-6);
  const double transfer_mps = 3.6 / (1.2 * 1006.0 * std::pow(0.85, 2.0 / 3.0));
  const double expected_kg_m2 =
      transfer_mps * kStep_s *
      (0.6 * glass::saturatedVapour_kg_m3(20.0) - glass::saturatedVapour_kg_m3(glass_c));
  fog_.step(winter_, kStep_s);
  EXPECT_NEAR(mass_kg_m2(fog_) / expected_kg_m2, 1.0, 1e-3);  // Le^(2/3) is rounded to three digits
  EXPECT_NEAR(area_m2(fog_), 1.5 * 0.8, 0.03);                // texels at the edge count whole or not at all
}

TEST_F(FoggedPane, shorterStepsGiveTheSame) {
  Fog fine(map_);
  for (int k = 0; k < 1200; ++k) fog_.step(winter_, kStep_s);
  for (int k = 0; k < 12000; ++k) fine.step(winter_, kStep_s / 10.0);
  EXPECT_NEAR(mass_kg_m2(fog_) / mass_kg_m2(fine), 1.0, 1e-3);  // the glass takes minutes to warm
}

TEST_F(FoggedPane, losesNoPicolitreInAnyWeather) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int hour = 0; hour < 20; ++hour) {
    const FogAir air{30.0 * share(random) - 10.0,
                     share(random),
                     40.0 * share(random),
                     15.0 + 15.0 * share(random),
                     share(random),
                     share(random) < 0.5 ? 0.0 : share(random),
                     50.0};
    for (int k = 0; k < 600; ++k) fog_.step(air, 1.0);
    const glass::FogStats s = fog_.stats();
    ASSERT_EQ(s.condensed_pl, s.on_glass_pl + s.evaporated_pl + s.drained_pl);
    double cells_pl = 0.0;
    for (int k = 0; k < Fog::kCells.x * Fog::kCells.y; ++k) {
      const glm::ivec2 cell(k % Fog::kCells.x, k / Fog::kCells.x);
      cells_pl += fog_.massAt_kg_m2(cell) * fog_.areaAt_m2(cell) * 1e12;
    }
    ASSERT_NEAR(cells_pl, static_cast<double>(s.on_glass_pl), 1.0);
  }
  EXPECT_GT(fog_.stats().evaporated_pl, 0);
}

TEST_F(FoggedPane, theDemisterClearsItFromBelow) {
  for (int k = 0; k < 2400; ++k) fog_.step(winter_, kStep_s);
  const double before = mass_kg_m2(fog_);
  winter_.demister = 1.0;
  for (int k = 0; k < 300; ++k) fog_.step(winter_, kStep_s);
  std::vector<std::pair<double, double>> column;  // height and mass
  for (int y = 0; y < Fog::kCells.y; ++y) {
    if (fog_.areaAt_m2({16, y}) > 0.0)
      column.emplace_back(fog_.heightAt_m({16, y}), fog_.massAt_kg_m2({16, y}));
  }
  std::ranges::sort(column);
  EXPECT_EQ(column.front().second, 0.0);
  EXPECT_GT(column.back().second, 0.5 * before);
  for (size_t k = 1; k < column.size(); ++k) EXPECT_GE(column[k].second, column[k - 1].second);
  for (int k = 0; k < 6000; ++k) fog_.step(winter_, kStep_s);
  EXPECT_TRUE(fog_.empty());
}

}  // namespace
}  // namespace rg::test
