// The ridge that runs on where its blade turns round, against the motion itself in small steps.
#include "glass/run_on.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/glass_wiper.glsl"

namespace rg::test {
namespace {

using glass::PieceStroke;

constexpr double kPerMinute = 2.0 * std::numbers::pi / 60.0;

// A sheet before a blade that a crank moves, by time: pushed as long as it would fall behind, else on its
// own.
double steppedRunOn_m(double area_m2, const PieceStroke& stroke, const glass::Surface& surface) {
  const auto tan_contact = static_cast<float>(std::tan(surface.advancing_rad));
  const double height_m =
      area_m2 / static_cast<double>(shared::ridgeWidth_m(static_cast<float>(area_m2), tan_contact));
  const double peak_mps = stroke.rate_radps * stroke.half_way_m;
  const double reynolds = 1000.0 * peak_mps * 4.0 * height_m / 1e-3;
  const double k = 0.079 * std::pow(reynolds, -0.25) / (2.0 * height_m);
  const double held =
      0.072 * (std::cos(surface.receding_rad) - std::cos(surface.advancing_rad)) / (1e3 * area_m2);
  const double dt = 2e-6;
  double t = 0.5 * std::numbers::pi / stroke.rate_radps, x = 0.0, v = peak_mps;
  bool alone = false;
  for (; v > 0.0; t += dt) {
    const double blade_mps = peak_mps * std::sin(stroke.rate_radps * t);
    // Its contact lines hold it from when it is on its own.
    if (!alone && v - k * v * v * dt > blade_mps) alone = true;
    v = alone ? v - (k * v * v + held) * dt : blade_mps;
    x += v * dt;
  }
  return std::max(x - stroke.half_way_m, 0.0);
}

TEST(RunOn, isWhatTheMotionStepByStepGives) {
  for (const double cycles : {42.0, 62.0, 80.0}) {
    for (const double area_mm2 : {3.0, 12.0, 60.0}) {
      const PieceStroke stroke{0.45, cycles * kPerMinute};
      const glass::Surface surface = glass::surfaceOf(glass::Glass::dirty);
      const double stepped_m = steppedRunOn_m(area_mm2 * 1e-6, stroke, surface);
      EXPECT_NEAR(glass::runOn_m(area_mm2 * 1e-6, stroke, surface), stepped_m, 2e-3 + 0.01 * stepped_m)
          << cycles << " a minute, " << area_mm2 << " mm^2";
    }
  }
}

TEST(RunOn, isFartherTheFasterAndTheMore) {
  const glass::Surface surface = glass::surfaceOf(glass::Glass::uncoated);
  const auto run = [&](double area_mm2, double cycles) {
    return glass::runOn_m(area_mm2 * 1e-6, {0.45, cycles * kPerMinute}, surface);
  };
  for (double area_mm2 = 0.5; area_mm2 < 150.0; area_mm2 *= 1.3)
    EXPECT_LE(run(area_mm2, 62), run(1.3 * area_mm2, 62));
  EXPECT_LT(run(12, 20), run(12, 42));
  EXPECT_LT(run(12, 42), run(12, 62));
  EXPECT_EQ(run(0.05, 20), 0.0);  // a film does not
  EXPECT_EQ(glass::runOn_m(1e-5, {0.0, 6.0}, surface), 0.0);
}

TEST(RunOn, fromTheLeastVolumeOnItReachesTheEdge) {
  const glass::Surface surface = glass::surfaceOf(glass::Glass::uncoated);
  const PieceStroke stroke{0.45, 62 * kPerMinute};
  constexpr double kPiece_m = 3e-3, kEdge_m = 0.03;
  const int32_t least_pl = glass::leastToRunOn_pl(kEdge_m, kPiece_m, stroke, surface);
  ASSERT_LT(least_pl, glass::kNeverRunsOn);
  const double area_m2 = glass::cubicMetres(least_pl) / kPiece_m;
  EXPECT_GE(glass::runOn_m(1.001 * area_m2, stroke, surface), kEdge_m);
  EXPECT_LT(glass::runOn_m(0.999 * area_m2, stroke, surface), kEdge_m);
  EXPECT_EQ(glass::leastToRunOn_pl(5.0, kPiece_m, stroke, surface), glass::kNeverRunsOn);
}

}  // namespace
}  // namespace rg::test
