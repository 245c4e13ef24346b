// The field as a machine: determinism, no allocation, thinning, and no drop where a volume keeps it off.
#include "rain/field.h"

#include <gtest/gtest.h>

#include "allocations.h"
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
  for (; scene.index < 100; ++scene.index, moved.index = scene.index)
    a.tick(scene.tick()), b.tick(moved.tick());
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
  EXPECT_EQ(
      field.stats().live,
      0u);  // the fastest take 10 m / 9.4 m/s from the ceiling to the eye's height less what is seen above it
  drive(field, scene, 0, 0, 1200, [](int) {});
  EXPECT_GT(field.stats().live, 5000u);
}

// Brute force, sharing nothing with the tree, the birth test or the clip: points along each streak as drawn
// against every box.
struct Roof {
  dvec3 low, high;
};
bool anyInside(const std::vector<Streak>& streaks, const std::vector<Roof>& roofs, const dvec3& car) {
  constexpr double kOff_m = 2e-4;  // of float places 20 m from the eye, and of ends told to 8 us
  for (const Streak& s : streaks) {
    for (size_t i = 0; i < roofs.size(); ++i) {
      const dvec3 low = roofs[i].low + kOff_m, high = roofs[i].high - kOff_m, off = i == 0 ? car : dvec3(0.0),
                  from = s.from_m - off, to = s.to_m - off;
      if (glm::any(glm::lessThan(glm::max(from, to), low)) ||
          glm::any(glm::greaterThan(glm::min(from, to), high)))
        continue;  // all of it beyond a face
      for (int k = 0; k <= 16; ++k) {
        const dvec3 p = from + (to - from) * (k / 16.0);
        if (glm::all(glm::greaterThan(p, low)) && glm::all(glm::lessThan(p, high))) return true;
      }
    }
  }
  return false;
}

TEST(Shelter, noStreakIsEverDrawnInsideAVolumeInStormAndBraking) {
  Field field;
  const std::vector<Roof> roofs = {
      {{-2, -0.8, 0.2}, {2, 0.8, 1.9}}, {{10, -6, -1}, {25, 6, 5}}, {{32, -1, 4}, {40, 9, 4.5}}};
  for (uint32_t i = 0; i < roofs.size(); ++i)
    ASSERT_EQ(setBox(field, i + 1, roofs[i].low, roofs[i].high, i == 0 ? 7 : 0), "");
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

// The longest exposure at 290 km/h: half a streak reaches 10 m beyond its drop.
TEST(Shelter, clipsLongStreaksAtVolumesFarBeyondTheirDrops) {
  constexpr double kSpeed_mps = 80.0, kWall_m = 100.0;
  Field field;
  const std::vector<Roof> walls = {{{kWall_m, -50, -10}, {kWall_m + 50, 50, 20}}};
  ASSERT_EQ(setBox(field, 1, walls[0].low, walls[0].high), "");
  Scene scene = sceneWithView(100);
  scene.views[0].exposure_s = 0.25;
  std::vector<Streak> streaks;
  uint64_t clipped = 0;
  drive(field, scene, kSpeed_mps, 0.0, 140, [&](int) {
    field.streaks(scene.views[0], tickTimeNs(scene.index), streaks);
    ASSERT_FALSE(anyInside(streaks, walls, dvec3(0.0))) << "tick " << scene.index;
    for (const Streak& s : streaks) clipped += s.from_m.x > kWall_m - 0.1 || s.to_m.x > kWall_m - 0.1 ? 1 : 0;
  });
  EXPECT_GT(clipped, 100u);
}

}  // namespace
}  // namespace rg::rain::test
