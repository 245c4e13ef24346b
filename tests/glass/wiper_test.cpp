// Wipers: no gaps at any rate, nothing touched outside the sweep, water goes to the ridge and from there back
// or off.
#include "glass/wiper.h"

#include <gtest/gtest.h>

#include <set>

#include "gl_fixture.h"
#include "scene.h"

namespace rg::test {
namespace {

class Wiping : public GlTest {};

TEST(Sweep, coversEveryTexelOncePerStrokeAtAnyRate) {
  const Mesh mesh = windscreen(1.5, 0.8, rad(30), 0.05);
  const glass::PaneMap map(paneInfo(mesh));
  const glass::Wiper wiper(test::wiper(), map, 0);
  const double from = rad(10), to = rad(150);
  const auto [first, last] = wiper.range({from, to});
  std::multiset<int> whole;
  for (int i = first; i < last; ++i) whole.insert((*wiper.swept())[static_cast<size_t>(i)].texel);
  EXPECT_GT(whole.size(), 40000u);
  for (const double hz : {12.0, 30.0, 60.0, 144.0, 7.3}) {
    for (const bool back : {false, true}) {
      std::multiset<int> swept;
      const double stroke_s = 60.0 / 45.0 / 2.0;  // 45 cycles a minute
      double before = back ? to : from;
      for (int k = 1; before != (back ? from : to); ++k) {
        const double share = std::min(1.0, k / hz / stroke_s);
        const double now = share == 1.0 ? (back ? from : to)
                           : back       ? to + (from - to) * share
                                        : from + (to - from) * share;
        const auto [a, b] = wiper.range({before, now});
        for (int i = a; i < b; ++i) swept.insert((*wiper.swept())[static_cast<size_t>(i)].texel);
        before = now;
      }
      // Both ends are the same up to texels that lie on them to the last bit.
      EXPECT_EQ(swept, whole) << hz << " Hz";
    }
  }
}

// Brute force: the blade as a segment in the plane.
TEST(Sweep, angleOfCrossingIsWhereTheBladeLies) {
  const Mesh mesh = windscreen();
  const glass::PaneMap map(paneInfo(mesh));
  for (const double blade_angle : {0.0, rad(25), rad(-40), rad(90)}) {
    glass::WiperInfo info = test::wiper();
    info.blade_angle_rad = blade_angle;
    const glass::Wiper wiper(info, map, 0);
    const glm::dvec3 side = glm::cross(info.axis, info.rest_direction);
    const auto direction = [&](double angle) {
      return std::cos(angle) * info.rest_direction + std::sin(angle) * side;
    };
    int crossed = 0;
    for (int i = 0; i < map.texelCount(); i += 37) {
      if (!map.inside(i)) continue;
      const glm::dvec3 place(map.texel(i).position_m);
      const glass::Crossings c = wiper.crossingsAt(place);
      for (int k = 0; k < c.count; ++k) {
        const glm::dvec3 middle = info.pivot_m + info.arm_m * direction(c.angle_rad[k]);
        const glm::dvec3 along = direction(c.angle_rad[k] + blade_angle);
        const double s = glm::dot(place - middle, along);
        EXPECT_NEAR(glm::length(place - middle - s * along), 0.0, 1e-6);
        EXPECT_LE(std::abs(s), 0.5 * info.blade_m + 1e-9);
        ++crossed;
      }
    }
    EXPECT_GT(crossed, 100);
  }
}

TEST_F(Wiping, touchesNothingOutsideTheSweepAndCleansInside) {
  const Mesh mesh = windscreen(0.9, 0.6, 1e-4);  // level: the film rests
  glass::PaneInfo info = paneInfo(mesh);
  info.max_drops = 0;
  info.glass = glass::Glass::new_coating;
  Simulation sim(gl, info);
  sim.sim->setWiper(3, wiper(1e-4, 0.6));
  // Half-millimetre drops leave spots of 3 um, and glass of the new coating holds films below 5 um.
  glass::PaneTick mist = weather(0.0);
  mist.class_count = 1;
  mist.classes[0] = {0.5e-3, 600.0, 2.0};
  sim.run(mist, 1.0);
  sim.run(weather(0.0), 0.5);
  const std::vector<int32_t> before = sim.pane.readFilm();
  const double from = rad(40), to = rad(100);
  glass::PaneTick tick = weather(0.0);
  tick.wiper_count = 1;
  for (int k = 0; k < 20; ++k) {
    const double a = from + (to - from) * k / 20.0, b = from + (to - from) * (k + 1) / 20.0;
    tick.wipers[0] = {3, a, b, b};
    sim.tick(tick);
  }
  const std::vector<int32_t> after = sim.pane.readFilm();
  const glass::Wiper blade(wiper(1e-4, 0.6), sim.sim->map(), 0);
  int inside = 0, changed = 0, watered = 0;
  for (int i = 0; i < sim.sim->map().texelCount(); ++i) {
    const size_t t = static_cast<size_t>(i);
    if (!sim.sim->map().inside(i)) continue;
    const glass::Crossings c = blade.crossingsAt(glm::dvec3(sim.sim->map().texel(i).position_m));
    const bool swept = c.count > 0 && glass::Sweep{from, to}.covers(c.angle_rad[0]);
    if (swept) {
      ++inside;
      EXPECT_LE(after[t], 901);  // residual 0.1 um of 9 mm^2
      if (before[t] > 901) ++changed;
    } else {
      ASSERT_EQ(after[t], before[t]) << "texel " << i;
      if (before[t] > 901) ++watered;
    }
  }
  EXPECT_GT(changed, inside / 100);
  EXPECT_GT(watered, 1000);
  const glass::PaneStats s = sim.stats();
  EXPECT_GT(s.ridge_pl, 0);
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

TEST_F(Wiping, ridgeStaysWhereTheBladeTurnsRound) {
  const Mesh mesh = windscreen(0.9, 0.6, 1e-4);
  glass::PaneInfo info = paneInfo(mesh);
  info.max_drops = 0;
  Simulation sim(gl, info);
  sim.sim->setWiper(3, wiper(1e-4, 0.6));
  sim.run(weather(5.0), 4.0);
  glass::PaneTick tick = weather(0.0);
  tick.wiper_count = 1;
  const auto stroke = [&](double a, double extreme, double b) {
    tick.wipers[0] = {3, a, extreme, b};
    sim.tick(tick);
  };
  stroke(rad(40), rad(70), rad(70));
  sim.tick(weather(0.0));
  const int64_t carried = sim.stats().ridge_pl;
  EXPECT_GT(carried, 100'000'000);
  stroke(rad(70), rad(72), rad(71));  // the reversal lies inside the tick
  sim.tick(weather(0.0));
  sim.tick(weather(0.0));
  const glass::PaneStats s = sim.stats();
  // Pieces over the pane put theirs down at 72 degrees; the way back of one degree picks little up.
  EXPECT_LT(s.ridge_pl, carried / 10);
  EXPECT_LT(s.wiped_pl, carried / 3);  // the tip has passed the upper edge
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

TEST_F(Wiping, throwsWaterOffOverThePanesEdge) {
  const Mesh mesh = windscreen(0.5, 0.6, rad(30));
  glass::PaneInfo info = paneInfo(mesh);
  Simulation sim(gl, info);
  sim.sim->setWiper(3, wiper(rad(30), 0.6));
  const WiperMotor motor(3, rad(40), rad(165), 60);  // beyond the pane's side
  sim.run(weather(50.0), 2.0, &motor);
  const glass::PaneStats s = sim.stats();
  EXPECT_GT(s.wiped_pl, 100'000'000);
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

TEST_F(Wiping, leavesNoDropUnderTheBladesWay) {
  const Mesh mesh = windscreen(0.9, 0.6, rad(30));
  Simulation sim(gl, paneInfo(mesh));
  sim.sim->setWiper(3, wiper(rad(30), 0.6));
  sim.run(weather(20.0), 2.0);
  glass::PaneTick tick = weather(0.0);
  tick.wiper_count = 1;
  tick.wipers[0] = {3, rad(30), rad(120), rad(120)};
  const size_t before = sim.sim->snapshot()->drops.size();
  sim.tick(tick);
  const glass::Wiper blade(wiper(rad(30), 0.6), sim.sim->map(), 0);
  const auto drops = sim.sim->snapshot();
  EXPECT_LT(drops->drops.size(), before);
  EXPECT_GT(drops->drops.size(), before / 10);
  for (const shared::GlassDropRecord& drop : drops->drops) {
    const glass::Crossings c =
        blade.crossingsAt(*sim.sim->map().vehicleFromGrid(glm::dvec2(drop.position_m)));
    // float positions: a drop on the very edge may be either side
    const glass::Sweep sweep{rad(30.01), rad(119.99)};
    for (int k = 0; k < c.count; ++k) EXPECT_FALSE(sweep.covers(c.angle_rad[k]));
  }
}

}  // namespace
}  // namespace rg::test
