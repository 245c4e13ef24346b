// Wipers: no gaps at any rate, nothing touched outside the sweep, water goes to the ridge and from there back
// or off.
#include "glass/wiper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "gl_fixture.h"
#include "scene.h"
#include "shared/hash.glsl"

namespace rg::test {
namespace {

class Wiping : public GlTest {};

std::multiset<int> sweptBy(const glass::Wiper& wiper, const glass::Sweep& sweep) {
  std::multiset<int> texels;
  for (const shared::SweptRange& range : wiper.ranges(sweep)) {
    for (int i = range.first; i < range.first + range.count; ++i)
      texels.insert((*wiper.swept())[static_cast<size_t>(i)].texel);
  }
  return texels;
}

// A wiper of the windscreen by its geometry alone: single, one of a tandem or opposed pair, a pantograph.
struct Linkage {
  const char* name;
  double pivot_right_m, arm_m, blade_m, blade_angle_rad, turn, from_rad, to_rad;
};
const Linkage kLinkages[] = {
    {"single", 0.0, 0.4, 0.5, 0.0, 0.0, rad(10), rad(150)},
    {"tandem", -0.35, 0.42, 0.52, rad(8), 0.0, rad(5), rad(95)},
    {"opposed", 0.6, 0.45, 0.6, rad(-10), 0.0, rad(10), rad(100)},
    {"blade across its arm", 0.0, 0.3, 0.5, rad(75), 0.0, rad(20), rad(140)},
    {"pantograph", 0.0, 0.5, 0.45, rad(90), -1.0, rad(45), rad(135)},
    {"half a pantograph", 0.1, 0.45, 0.5, rad(50), -0.5, rad(20), rad(150)},
    {"blade that turns ahead", 0.0, 0.4, 0.5, 0.0, 0.15, rad(10), rad(140)},
};

glass::WiperInfo wiperOf(const Linkage& linkage) {
  glass::WiperInfo info = test::wiper();
  info.pivot_m += glm::dvec3(0.0, -linkage.pivot_right_m, 0.0);
  info.arm_m = linkage.arm_m;
  info.blade_m = linkage.blade_m;
  info.blade_angle_rad = linkage.blade_angle_rad;
  info.blade_turn = linkage.turn;
  return info;
}

// A crank's cosine, as motors turn; every reversal is told.
std::vector<glass::Sweep> strokesOf(const Linkage& linkage, double cycles_per_min, double hz) {
  std::vector<glass::Sweep> sweeps;
  const double cycle_s = 60.0 / cycles_per_min;
  double phase = 0.0, angle = linkage.from_rad;
  const auto go = [&](double to_phase) {
    const double to = to_phase == 0.5   ? linkage.to_rad
                      : to_phase == 1.0 ? linkage.from_rad
                                        : linkage.from_rad + (linkage.to_rad - linkage.from_rad) * 0.5 *
                                                                 (1.0 - std::cos(2.0 * kPi * to_phase));
    sweeps.push_back({angle, to});
    angle = to;
    phase = to_phase;
  };
  while (phase < 1.0) {
    const double next = std::min(1.0, phase + 1.0 / hz / cycle_s);
    if (phase < 0.5 && next > 0.5) go(0.5);
    go(next);
  }
  return sweeps;
}

TEST(Sweep, coversEveryTexelOncePerStrokeAtAnyRate) {
  const Mesh mesh = windscreen(1.5, 0.8, rad(30), 0.05);
  const glass::PaneMap map(paneInfo(mesh));
  for (const Linkage& linkage : kLinkages) {
    const glass::Wiper wiper(wiperOf(linkage), map, 0);
    std::multiset<int> whole = sweptBy(wiper, {linkage.from_rad, linkage.to_rad});
    EXPECT_GT(whole.size(), 10000u) << linkage.name;
    whole.merge(sweptBy(wiper, {linkage.to_rad, linkage.from_rad}));
    for (const double cycles_per_min : {20.0, 45.0, 80.0}) {
      for (const double hz : {12.0, 60.0, 144.0, 7.3}) {
        std::multiset<int> swept;
        for (const glass::Sweep& sweep : strokesOf(linkage, cycles_per_min, hz))
          swept.merge(sweptBy(wiper, sweep));
        // Both ways' ends are the same up to texels that lie on them to the last bit.
        EXPECT_EQ(swept, whole) << linkage.name << ", " << cycles_per_min << "/min, " << hz << " Hz";
      }
    }
  }
}

// Brute force: the blade as a stick that is moved in small steps; a texel is passed when it changes sides of
// it between the stick's ends.
TEST(Sweep, coversWhatAStickPasses) {
  const Mesh mesh = windscreen();
  const glass::PaneMap map(paneInfo(mesh));
  constexpr double kUnsure_m = 1e-6;  // beside the stick's ends, or between where steps end
  constexpr int kSteps = 3000;
  for (const Linkage& linkage : kLinkages) {
    const glass::WiperInfo info = wiperOf(linkage);
    const glass::Wiper wiper(info, map, 0);
    const std::multiset<int> swept = sweptBy(wiper, {linkage.from_rad, linkage.to_rad});
    const glm::dvec3 side = glm::cross(info.axis, info.rest_direction);
    const auto direction = [&](double angle) {
      return std::cos(angle) * info.rest_direction + std::sin(angle) * side;
    };
    std::vector<glm::dvec3> middles, alongs;
    for (int n = 0; n <= kSteps; ++n) {
      const double angle = std::lerp(linkage.from_rad, linkage.to_rad, static_cast<double>(n) / kSteps);
      middles.push_back(info.pivot_m + info.arm_m * direction(angle));
      alongs.push_back(direction(info.blade_angle_rad + (1.0 + info.blade_turn) * angle));
    }
    size_t passed = 0, unsure = 0;
    for (int i = 0; i < map.texelCount(); i += 41) {
      if (!map.inside(i)) continue;
      const glm::dvec3 place(map.texel(i).position_m);
      size_t times = 0;
      bool sure = true;
      double before = 0.0;
      for (size_t n = 0; n <= kSteps; ++n) {
        const glm::dvec3 d = place - middles[n];
        const double across = glm::dot(glm::cross(alongs[n], d), info.axis);
        const double beyond = std::abs(glm::dot(alongs[n], d)) - 0.5 * info.blade_m;
        const bool changes = n > 0 && (across < 0.0) != (before < 0.0);
        // Where its line turns about a place within a step, the step tells nothing.
        if (changes && std::abs(beyond) < std::abs(across) + std::abs(before) + kUnsure_m) sure = false;
        if (changes && beyond < 0.0) ++times;
        if ((n == 0 || n == kSteps) && std::abs(across) < kUnsure_m) sure = false;
        before = across;
      }
      if (sure) {
        EXPECT_EQ(swept.count(i), times) << linkage.name << ", texel " << i;
      }
      passed += times;
      unsure += sure ? 0 : 1;
    }
    EXPECT_GT(passed, 300u) << linkage.name;
    EXPECT_LT(unsure, passed / 20) << linkage.name;
  }
}

TEST(Sweep, aPantographsBladeKeepsItsDirection) {
  const glass::PaneMap map(paneInfo(windscreen(0.3, 0.3)));
  const glass::Wiper wiper(wiperOf(kLinkages[4]), map, 0);
  EXPECT_LT(glm::distance(wiper.poseAt(rad(50)).along, wiper.poseAt(rad(130)).along), 1e-12);
}

// Brute force: the blade as a segment in the plane.
TEST(Sweep, angleOfCrossingIsWhereTheBladeLies) {
  const Mesh mesh = windscreen();
  const glass::PaneMap map(paneInfo(mesh));
  for (const Linkage& linkage : kLinkages) {
    const glass::WiperInfo info = wiperOf(linkage);
    const glass::Wiper wiper(info, map, 0);
    int crossed = 0;
    for (int i = 0; i < map.texelCount(); i += 37) {
      if (!map.inside(i)) continue;
      const glm::dvec3 place(map.texel(i).position_m);
      const glass::Crossings c = wiper.crossingsAt(place);
      for (int k = 0; k < c.count; ++k) {
        const glass::BladePose pose = wiper.poseAt(c.angle_rad[k]);
        const double s = glm::dot(place - pose.middle_m, pose.along);
        EXPECT_NEAR(glm::length(place - pose.middle_m - s * pose.along), 0.0, 1e-6);
        EXPECT_NEAR(s, c.along_m[k], 1e-9);
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
  // Drops of 0.3 mm leave spots of 1.6 um, and glass of the new coating holds films below 5 um.
  glass::PaneTick mist = weather(0.0);
  mist.class_count = 1;
  mist.classes[0] = {0.3e-3, 1600.0, 2.0};
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
  // In half a second: a blade that went there in a tick would throw it all off.
  constexpr int kTicks = 60;
  for (int k = 0; k < kTicks; ++k)
    stroke(rad(40 + 30.0 * k / kTicks), rad(40 + 30.0 * (k + 1) / kTicks), rad(40 + 30.0 * (k + 1) / kTicks));
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

// Only drops that the tiles let pass are looked at: each whose middle the blade crosses in a sweep is among
// them, wherever on its texel it lies and however wide it is, and few others are.
TEST(WiperTiles, letEveryDropPassThatASweepCrosses) {
  const glass::PaneMap map(paneInfo(windscreen(1.2, 0.6, rad(30), 0.05)));
  constexpr double kWidest_m = 30e-3;
  for (const Linkage& linkage : kLinkages) {
    const glass::Wiper wiper(wiperOf(linkage), map, 0);
    size_t crossed = 0, passed = 0, looked_at = 0;
    for (double angle = linkage.from_rad; angle < linkage.to_rad; angle += rad(11)) {
      const glass::Sweep sweep{angle, angle + rad(8)};
      const glass::SweptStrip strip = wiper.stripOf(sweep);
      for (int i = 0; i < map.texelCount(); i += 7) {
        const auto n = static_cast<uint32_t>(i);
        const glm::dvec2 in_texel(shared::unitFloat(shared::pcg(n)), shared::unitFloat(shared::pcg(n + 1u)));
        const glm::dvec2 place_m = map.middleOf(i) + map.grid().texel_m * (in_texel - 0.5);
        const double radius_m = i % 2 == 0 ? kWidest_m : 1e-3;
        const auto on_glass = map.vehicleFromGrid(place_m);
        if (!on_glass) continue;
        const glass::TileInPlane& tile = wiper.tiles()[map.tileOf(i)];
        const bool passes = tile.isNear(strip, kWidest_m) && tile.mayCross(strip, place_m, radius_m);
        const glass::Crossings c = wiper.crossingsAt(*on_glass, radius_m);
        const bool is_crossed = std::any_of(c.angle_rad, c.angle_rad + c.count,
                                            [&](double at_rad) { return sweep.covers(at_rad); });
        ASSERT_TRUE(passes || !is_crossed) << linkage.name << " texel " << i;
        crossed += is_crossed, passed += passes, ++looked_at;
      }
    }
    EXPECT_GT(crossed, looked_at / 1000) << linkage.name;
    // A sweep is a wedge, and the strip as wide everywhere as its ends' turns would make it.
    EXPECT_LT(passed, 6 * crossed) << linkage.name;
  }
}

// Wherever on a bowed pane a blade stands, the tile there knows it to be there.
TEST(WiperTiles, knowWhereTheirGlassIs) {
  const glass::PaneMap map(paneInfo(windscreen(1.2, 0.6, rad(30), 0.1)));
  glass::WiperInfo info = wiperOf(kLinkages[0]);
  // Its plane cuts the glass, and sees it bowed.
  info.axis = glm::normalize(info.axis + 0.3 * glm::cross(info.axis, info.rest_direction));
  const glass::Wiper wiper(info, map, 0);
  constexpr double kRounding_m = 1e-6;
  const glm::dvec3 side = glm::cross(info.axis, info.rest_direction);
  double farthest_m = 0.0;
  for (int i = 0; i < map.texelCount(); ++i) {
    const glm::dvec2 corner_m = map.middleOf(i) + 0.499 * map.grid().texel_m;
    const auto on_glass = map.vehicleFromGrid(corner_m);
    if (!on_glass) continue;
    const glm::dvec3 d = *on_glass - info.pivot_m;
    const glass::SweptStrip there{.middle_m = {glm::dot(d, info.rest_direction), glm::dot(d, side)},
                                  .along = {1.0, 0.0},
                                  .near_m = kRounding_m};
    const glass::TileInPlane& tile = wiper.tiles()[map.tileOf(i)];
    ASSERT_TRUE(tile.isNear(there, 0.0) && tile.mayCross(there, corner_m, 0.0)) << "texel " << i;
    farthest_m = std::max(farthest_m, tile.off_m);
  }
  EXPECT_LT(farthest_m, map.grid().texel_m) << "or a drop's texel would tell as much";
}

}  // namespace
}  // namespace rg::test
