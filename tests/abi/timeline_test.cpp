// Ticks from samples: exact at samples, linear between, independent of how updates cut time.
#include "timeline.h"

#include <gtest/gtest.h>

namespace rg {
namespace {

constexpr double kExact = 1e-12;  // a few roundings of doubles near 1
constexpr double kNsRounding =
    1e-6;  // ticks lie on whole nanoseconds: 30 m/s x 1 ns, and the same again in a second's interpolation

Sample sampleAt(int64_t time_ns, double x_m, double speed_mps) {
  Sample s;
  s.time_ns = time_ns;
  s.weather.rain_mm_h = 10.0;
  VehicleState v;
  v.id = 1;
  v.pose.position_m = {x_m, 0.0, 0.0};
  v.pose.velocity_mps = {speed_mps, 0.0, 0.0};
  s.vehicles.push_back(v);
  ViewState view;
  view.id = 1;
  s.views.push_back(view);
  return s;
}

TEST(Timeline, ticksLieAtExactMultiplesOfTheirPeriodOnBothSidesOfZero) {
  EXPECT_EQ(tickTimeNs(0), 0);
  EXPECT_EQ(tickTimeNs(120), 1'000'000'000);
  EXPECT_EQ(tickTimeNs(1), 8'333'333);
  EXPECT_EQ(tickTimeNs(-120), -1'000'000'000);
  for (int64_t k = -500; k < 500; ++k) EXPECT_LT(tickTimeNs(k), tickTimeNs(k + 1));
}

TEST(Timeline, aTickBetweenTwoSamplesIsLinear) {
  Timeline t;
  t.add(sampleAt(0, 0.0, 30.0));
  t.add(sampleAt(1'000'000'000, 30.0, 40.0));
  const Tick& tick = t.tick(60);
  EXPECT_NEAR(tick.vehicles[0].pose.position_m.x, 15.0, kNsRounding);
  EXPECT_NEAR(tick.vehicles[0].pose.velocity_mps.x, 35.0, kNsRounding);
  EXPECT_NEAR(tick.vehicles[0].acceleration_mps2.x, 10.0, kExact * 10);
}

TEST(Timeline, aTickAtASampleHasTheSamplesOwnBits) {
  Timeline t;
  t.add(sampleAt(tickTimeNs(3), 0.1, 30.0));
  t.add(sampleAt(tickTimeNs(4), 0.7, 30.0));
  EXPECT_EQ(t.tick(4).vehicles[0].pose.position_m.x, 0.7);
}

TEST(Timeline, beyondTheLastSampleABodyGoesOn) {
  Timeline t;
  t.add(sampleAt(0, 0.0, 30.0));
  EXPECT_NEAR(t.tick(120).vehicles[0].pose.position_m.x, 30.0, kNsRounding);
}

TEST(Timeline, nothingIsInterpolatedAcrossATeleport) {
  Timeline t;
  t.add(sampleAt(0, 0.0, 0.0));
  Sample far = sampleAt(1'000'000'000, 1000.0, 0.0);
  far.vehicles[0].discontinuity = true;
  t.add(far);
  EXPECT_NEAR(t.tick(119).vehicles[0].pose.position_m.x, 0.0, kExact);
  EXPECT_EQ(t.tick(120).vehicles[0].pose.position_m.x, 1000.0);
  EXPECT_EQ(t.tick(120).vehicles[0].acceleration_mps2.x, 0.0);
}

TEST(Timeline, aReversalInsideATickIsKept) {
  Timeline t;
  Sample s = sampleAt(0, 0.0, 0.0);
  s.wiper_knots = {{1, {0, 1.0}}};
  t.add(s);
  Sample next = sampleAt(tickTimeNs(1), 0.0, 0.0);
  next.wiper_knots = {{1, {4'000'000, 1.2}}, {1, {tickTimeNs(1), 0.9}}};
  t.add(next);
  const WiperMotion w = t.tick(1).wipers[0];
  EXPECT_DOUBLE_EQ(w.from_rad, 1.0);
  EXPECT_DOUBLE_EQ(w.extreme_rad, 1.2);
  EXPECT_DOUBLE_EQ(w.to_rad, 0.9);
}

TEST(Timeline, ticksAreTheSameHoweverSamplesArriveInUpdates) {
  const auto run = [](int samples_per_update) {
    Timeline t;
    std::vector<double> seen;
    int64_t next = 0;
    for (int k = 0; k <= 240; ++k) {
      t.add(sampleAt(tickTimeNs(k), 0.3 * k, 36.0));
      if (k % samples_per_update != 0 && k != 240) continue;
      for (; next <= k; ++next) {
        const Tick& tick = t.tick(next);
        seen.push_back(tick.vehicles[0].pose.position_m.x + tick.vehicles[0].acceleration_mps2.x);
      }
      t.prune(next - 1);
    }
    return seen;
  };
  EXPECT_EQ(run(1), run(7));
  EXPECT_EQ(run(1), run(100));
}

}  // namespace
}  // namespace rg
