// The size law against the normative table (N0 scaled so that the delivered water is the asked rate).
#include "rain/size_law.h"

#include <gtest/gtest.h>

#include <cmath>

namespace rg::rain {
namespace {

constexpr double kTable = 0.01;  // the table has three to four digits

struct Row {
  double rate, n0, drops, drops_gt1, flux, flux_gt1, mean_air, mean_ground, water;
};
constexpr Row kRows[] = {{1, 7187, 226, 29, 676, 137, 0.74, 0.81, 0.068},
                         {5, 6906, 547, 127, 1816, 629, 0.84, 0.95, 0.279},
                         {10, 6949, 777, 219, 2705, 1115, 0.90, 1.03, 0.513},
                         {25, 7139, 1207, 425, 4494, 2237, 0.98, 1.15, 1.158},
                         {50, 7402, 1666, 676, 6540, 3658, 1.05, 1.26, 2.158},
                         {100, 7813, 2299, 1054, 9515, 5868, 1.14, 1.38, 4.054}};

TEST(SizeLaw, followsTheNormativeTable) {
  for (const Row& row : kRows) {
    const SizeLaw law = SizeLaw::of(row.rate);
    EXPECT_NEAR(law.n0_per_m3_mm, row.n0, kTable * row.n0) << row.rate;
    EXPECT_NEAR(law.numberDensity(0.5, 6), row.drops, kTable * row.drops) << row.rate;
    EXPECT_NEAR(law.numberDensity(1, 6), row.drops_gt1, 0.5 + kTable * row.drops_gt1) << row.rate;
    EXPECT_NEAR(law.flux(0.5, 6), row.flux, kTable * row.flux) << row.rate;
    EXPECT_NEAR(law.flux(1, 6), row.flux_gt1, kTable * row.flux_gt1) << row.rate;
    EXPECT_NEAR(law.meanDiameter_mm(), row.mean_air, 0.005 + kTable * row.mean_air) << row.rate;
    EXPECT_NEAR(law.meanDiameterReachingGround_mm(), row.mean_ground, 0.005 + kTable * row.mean_ground)
        << row.rate;
    EXPECT_NEAR(law.water_g_m3(), row.water, 0.0005 + kTable * row.water) << row.rate;
    EXPECT_NEAR(law.delivered_mm_h(), row.rate, 1e-9 * row.rate);
  }
}

TEST(SizeLaw, classesTileTheLawAndFallWithinATwelfthOfAMetrePerSecond) {
  const SizeLaw law = SizeLaw::of(25);
  double sum = 0.0;
  for (const SpeedClass& c : speedClasses()) {
    sum += law.numberDensity(c.from_mm, c.to_mm);
    EXPECT_LT(std::abs(fallSpeed(c.from_mm) - c.speed_mps), 0.12);
    EXPECT_LT(std::abs(fallSpeed(c.to_mm) - c.speed_mps), 0.12);
  }
  EXPECT_NEAR(sum, law.numberDensity(0.5, 6), 1e-6 * sum);
}

TEST(SizeLaw, moreRainNeverHasFewerDropsOfAnyClass) {
  for (const SpeedClass& c : speedClasses()) {
    double before = 0.0;
    for (double rate = 1e-4; rate <= 300; rate *= 1.1) {
      const double now = SizeLaw::of(rate).numberDensity(c.from_mm, c.to_mm);
      EXPECT_GE(now, before) << c.from_mm << " mm at " << rate;
      before = now;
    }
  }
}

TEST(SizeLaw, quantileInvertsTheShareOfDrops) {
  const SizeLaw law = SizeLaw::of(10);
  for (double u = 0.0; u <= 1.0; u += 0.125) {
    EXPECT_NEAR(law.numberDensity(0.5, law.quantile(0.5, 6, u)) / law.numberDensity(0.5, 6), u, 1e-9);
  }
}

TEST(SizeLaw, takesNonsenseAsNoRainAndTooMuchAsTheMost) {
  EXPECT_EQ(SizeLaw::of(-3).numberDensity(0.5, 6), 0.0);
  EXPECT_EQ(SizeLaw::of(std::nan("")).numberDensity(0.5, 6), 0.0);
  EXPECT_EQ(SizeLaw::of(1e9).rate_mm_h, kMaxRate_mm_h);
}

}  // namespace
}  // namespace rg::rain
