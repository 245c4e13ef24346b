// The field's laws: density, determinism, no allocation, thinning, and no drop where a volume keeps it off.
#include "rain/field.h"

#include <gtest/gtest.h>

#include "allocations.h"
#include "rain/region.h"
#include "rain/size_law.h"
#include "scene.h"

namespace rg::rain::test {
namespace {

// Drives straight on along x, turning the view, `ticks` long; `each` is called after every tick.
template <class F>
void drive(Field& field, Scene& scene, double speed_mps, double turn_radps, int ticks, F&& each) {
  for (int i = 0; i < ticks; ++i, ++scene.index) {
    const double t = static_cast<double>(scene.index) * kTickSeconds;
    scene.views[0].eye_velocity_mps = {speed_mps, 0, 0};
    look(scene.views[0], {speed_mps * t, 0, 1.5}, turn_radps * t);
    for (VehicleState& car : scene.vehicles) {
      car.pose.position_m = {speed_mps * t, 0, 0};
      car.pose.velocity_mps = {speed_mps, 0, 0};
    }
    field.tick(scene.tick());
    each(i);
  }
}

// Volume of the near part of the cone, within `from`..`to` of the eye: the solid angle times the shell.
double shellVolume(const ViewState& view, double from_m, double to_m) {
  const Cone cone = coneOf(view);
  double solid_angle = 0.0;
  for (int half = 0; half < 2; ++half) {  // two spherical triangles (Van Oosterom & Strackee 1983)
    const dvec3 a = cone.corners[0], b = cone.corners[half == 0 ? 1 : 2], c = cone.corners[half == 0 ? 2 : 3];
    solid_angle += 2.0 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))), 1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  }
  return solid_angle * (to_m * to_m * to_m - from_m * from_m * from_m) / 3.0;
}

bool inCone(const Cone& cone, const dvec3& p) {
  for (const dvec3& n : cone.inward) {
    if (glm::dot(n, p - cone.eye_m) < 0.0) return false;
  }
  return true;
}

struct Motion {
  double rate_mm_h, speed_mps, turn_radps;
};
class Density : public ::testing::TestWithParam<Motion> {};

// 5 % as the issue asks, plus 3 standard errors of the count where classes hold few drops.
TEST_P(Density, ofEachSizeIsTheLaws) {
  const Motion motion = GetParam();
  Field field({.capacity = 200000, .seed = 3});
  Scene scene = sceneWithView(motion.rate_mm_h);
  std::array<double, 8> seen{}, expected{};
  std::vector<Streak> streaks;
  const SizeLaw law = SizeLaw::of(motion.rate_mm_h);
  drive(field, scene, motion.speed_mps, motion.turn_radps, 600, [&](int i) {
    if (i % 30 != 29) return;
    ViewState view = scene.views[0];
    field.streaks(view, tickTimeNs(scene.index), streaks);
    const Cone cone = coneOf(view);
    for (const Streak& s : streaks) {
      if (inCone(cone, s.drop_m)) ++seen[s.kind / 4];
    }
    for (size_t kind = 0; kind < kClasses; ++kind) {
      const SpeedClass& c = speedClasses()[kind];
      // Each drop is seen to 1.25 x 1663 times its own diameter.
      constexpr int kSteps = 16;
      for (int k = 0; k < kSteps; ++k) {
        const double a = c.from_mm + (c.to_mm - c.from_mm) * k / kSteps, b = c.from_mm + (c.to_mm - c.from_mm) * (k + 1) / kSteps;
        expected[kind / 4] += law.numberDensity(a, b) * shellVolume(view, 0.0, Visibility{}.factor * 1663.0 * 1e-3 * 0.5 * (a + b));
      }
    }
  });
  for (size_t i = 0; i < seen.size(); ++i) {
    EXPECT_NEAR(seen[i], expected[i], 0.05 * expected[i] + 3.0 * std::sqrt(expected[i])) << "classes " << 4 * i << "..";
  }
}
INSTANTIATE_TEST_SUITE_P(Motions, Density,
                         ::testing::Values(Motion{5, 0, 0}, Motion{50, 0, 0}, Motion{5, 100 * kKmh, 0}, Motion{50, 100 * kKmh, 0},
                                           Motion{5, 0, 1.0472}, Motion{50, 0, 1.0472}));

TEST(Field, isTheSameForTheSameTicksWhereverTheSceneLies) {
  const auto run = [](const dvec3& at) {
    Field field;
    Scene scene = sceneWithView(10, at + dvec3(0, 0, 1.5));
    for (scene.index = 500; scene.index < 600; ++scene.index) field.tick(scene.tick());
    return field.hash();
  };
  EXPECT_EQ(run(dvec3(0.0)), run(dvec3(0.0)));
  EXPECT_EQ(run(dvec3(0.0)), run(dvec3(1'000'000.0, 0.0, 0.0)));
}

TEST(Field, rebaseMovesDropsWithTheWorld) {
  Field a, b;
  Scene scene = sceneWithView(10);
  for (; scene.index < 50; ++scene.index) a.tick(scene.tick()), b.tick(scene.tick());
  b.rebase({-4096.0, 512.0, 0.0});
  Scene moved = scene;
  look(moved.views[0], dvec3(4096.0, -512.0, 1.5), 0.0);
  for (; scene.index < 100; ++scene.index, moved.index = scene.index) a.tick(scene.tick()), b.tick(moved.tick());
  EXPECT_EQ(a.hash(), b.hash());
}

TEST(Field, seekingBackUnderSteadyWeatherFindsTheSameRain) {
  Field field;
  Scene scene = sceneWithView(10);
  scene.weather.wind_mps = {3, 1, 0};
  for (; scene.index <= 100; ++scene.index) field.tick(scene.tick());
  const uint64_t then = field.hash();
  for (; scene.index < 400; ++scene.index) field.tick(scene.tick());
  field.seek(100);
  scene.index = 100;
  field.tick(scene.tick());
  EXPECT_EQ(field.hash(), then);
}

TEST(Field, allocatesNothingInATick) {
  Field field;
  Scene scene = sceneWithView(50);
  scene.vehicles.emplace_back().id = 7;
  ASSERT_EQ(setBox(field, 1, {-2, -0.8, 0}, {2, 0.8, 1.7}, 7), "");
  drive(field, scene, 100 * kKmh, 0.5, 200, [](int) {});
  const uint64_t before = allocations;
  drive(field, scene, 100 * kKmh, 0.5, 200, [](int) {});
  EXPECT_EQ(allocations - before, 0u);
}

TEST(Field, fullBufferThinsAllSizesByTheSameShareAndSaysSo) {
  Field field({.capacity = 2000, .seed = 1});
  Scene scene = sceneWithView(50);
  drive(field, scene, 30 * kKmh, 0.0, 240, [](int) {});
  const FieldStats stats = field.stats();
  EXPECT_LT(stats.thinning, 0.5);
  EXPECT_LE(stats.live, 2000u);
  EXPECT_GT(stats.live, 1500u);
}

TEST(Field, newRainFillsTheSkyFromAbove) {
  Field field({.capacity = 200000, .seed = 1});
  Scene scene = sceneWithView(0);
  drive(field, scene, 0, 0, 10, [](int) {});
  EXPECT_EQ(field.stats().live, 0u);
  scene.weather.rain_mm_h = 50;
  drive(field, scene, 0, 0, 60, [](int) {});
  EXPECT_EQ(field.stats().live, 0u);  // the fastest take 10 m / 9.4 m/s from the ceiling to the eye's height less what is seen above it
  drive(field, scene, 0, 0, 1200, [](int) {});
  EXPECT_GT(field.stats().live, 5000u);
}

// Brute force, sharing nothing with the tree, the birth test or the clip: points along each streak as drawn against every box.
struct Roof {
  dvec3 low, high;
};
bool anyInside(const std::vector<Streak>& streaks, const std::vector<Roof>& roofs, const dvec3& car) {
  constexpr double kRounding_m = 2e-4;  // of float places 20 m from the eye, and of ends told to 8 us
  for (const Streak& s : streaks) {
    for (int k = 0; k <= 16; ++k) {
      const dvec3 p = s.from_m + (s.to_m - s.from_m) * (k / 16.0);
      for (size_t i = 0; i < roofs.size(); ++i) {
        const dvec3 q = i == 0 ? p - car : p;
        if (glm::all(glm::greaterThan(q, roofs[i].low + kRounding_m)) && glm::all(glm::lessThan(q, roofs[i].high - kRounding_m))) return true;
      }
    }
  }
  return false;
}

TEST(Shelter, noStreakIsEverDrawnInsideAVolumeInStormAndBraking) {
  Field field;
  const std::vector<Roof> roofs = {{{-2, -0.8, 0.2}, {2, 0.8, 1.9}}, {{10, -6, -1}, {25, 6, 5}}, {{32, -1, 4}, {40, 9, 4.5}}};
  for (uint32_t i = 0; i < roofs.size(); ++i) ASSERT_EQ(setBox(field, i + 1, roofs[i].low, roofs[i].high, i == 0 ? 7 : 0), "");
  Scene scene = sceneWithView(30);
  scene.weather.wind_mps = {5, -40, 0};
  scene.vehicles.emplace_back().id = 7;
  scene.views[0].vehicle = 7;
  std::vector<Streak> streaks;
  double x = -10.0, v = 100 * kKmh;
  uint64_t drawn = 0;
  for (; scene.index < 420; ++scene.index) {
    if (scene.index > 100 && v > 0.0) v = std::max(0.0, v - 9.81 * kTickSeconds);
    x += v * kTickSeconds;
    scene.vehicles[0].pose.position_m = {x, 0, 0};
    scene.vehicles[0].pose.velocity_mps = {v, 0, 0};
    scene.views[0].eye_velocity_mps = {v, 0, 0};
    look(scene.views[0], {x, 0.3, 1.5}, 0.0);
    field.tick(scene.tick());
    for (const int64_t after_ns : {int64_t{0}, int64_t{5'000'000}}) {
      const double car_x = x + v * static_cast<double>(after_ns) * 1e-9;
      ViewState view = scene.views[0];
      look(view, {car_x, 0.3, 1.5}, 0.0);
      field.streaks(view, tickTimeNs(scene.index) + after_ns, streaks);
      drawn += streaks.size();
      ASSERT_FALSE(anyInside(streaks, roofs, {car_x, 0, 0})) << "tick " << scene.index;
    }
  }
  EXPECT_GT(drawn, 100000u);
  EXPECT_GT(field.stats().sheltered_at_birth, 1000u);
}

}  // namespace
}  // namespace rg::rain::test
