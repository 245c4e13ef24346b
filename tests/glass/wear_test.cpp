// What a blade leaves: a worn one streaks and smears, drops that stand too high are cut, the blade's end cuts
// what lies across it. Nothing is lost on the way.
#include "glass/wear.h"

#include <gtest/gtest.h>

#include "gl_fixture.h"
#include "glass/water.h"
#include "glass/wiper.h"
#include "scene.h"

namespace rg::test {
namespace {

constexpr double kLevel_rad = 1e-4;  // a pane that lies flat: water rests

TEST(Wear, aNewBladeLeavesTheSameEverywhere) {
  const glass::Wear wear(1e-7, 0.6, 0.0, 5);
  for (double s = -0.3; s <= 0.3; s += 1e-3) EXPECT_EQ(wear.residual_m(s), 1e-7);
  EXPECT_EQ(wear.smear_m(), 0.0);
}

TEST(Wear, moreWearLeavesMoreAndInThinLines) {
  double before_m = 0.0;
  for (const double worn : {0.2, 0.5, 1.0}) {
    const glass::Wear wear(1e-7, 0.6, worn, 5);
    double sum_m = 0.0;
    int lines = 0, points = 0;
    for (double s = -0.3; s <= 0.3; s += 2e-4, ++points) {
      EXPECT_GE(wear.residual_m(s), 1e-7);
      sum_m += wear.residual_m(s);
      lines += wear.residual_m(s) > 4e-6 ? 1 : 0;
    }
    EXPECT_GT(sum_m / points, before_m);
    before_m = sum_m / points;
    EXPECT_GT(lines, 0);
    EXPECT_LT(lines, points / 3);
  }
}

class Worn : public GlTest {
 protected:
  static glass::WiperInfo blade(double wear) {
    glass::WiperInfo info = wiper(kLevel_rad, 0.6);
    info.wear = wear;
    return info;
  }
  static bool isCovered(const Simulation& run, const glass::Wiper& geometry, int texel) {
    const glass::Crossings c = geometry.crossingsAt(glm::dvec3(run.sim->map().texel(texel).position_m));
    return c.count > 0 && glass::Sweep{rad(50), rad(100)}.covers(c.angle_rad[0]);
  }
  // A drop `above_m` from the pivot, where blades at 90 degrees are, on the middle of a texel.
  static void place(Simulation& run, const glass::WiperInfo& info, double above_m, double radius_m,
                    double contact_rad) {
    const glass::PaneMap& map = run.sim->map();
    const glm::dvec3 at = info.pivot_m + above_m * glm::cross(info.axis, info.rest_direction);
    int nearest = 0;
    for (int i = 0; i < map.texelCount(); ++i) {
      const auto away = [&](int k) { return glm::distance(glm::dvec3(map.texel(k).position_m), at); };
      if (map.inside(i) && away(i) < away(nearest)) nearest = i;
    }
    const glm::dvec2 glass_m = map.glassFromGrid(map.middleOf(nearest));
    const glass::PlacedDrop drop{glass_m.x, glass_m.y, radius_m, contact_rad};
    run.sim->placeDrops({&drop, 1});
  }
  static void sweep(Simulation& run, double from, double to, int ticks = 30) {
    glass::PaneTick tick = weather(0.0);
    tick.wiper_count = 1;
    for (int k = 0; k < ticks; ++k) {
      const double b = std::lerp(from, to, (k + 1.0) / ticks);
      tick.wipers[0] = {3, std::lerp(from, to, static_cast<double>(k) / ticks), b, b};
      run.tick(tick);
    }
  }
};

// Streaks lie at the same radii after each stroke, as thick as the edge's nicks say. The glass is of a kind
// that holds films as thin as those where they are.
TEST_F(Worn, streaksAreConcentricAndComeBackAtTheSameRadii) {
  const Mesh mesh = windscreen(0.9, 0.6, kLevel_rad);
  glass::PaneInfo info = paneInfo(mesh);
  info.max_drops = 0;
  Simulation run(gl, info);
  const glass::WiperInfo worn = blade(0.6);
  run.sim->setWiper(3, worn);
  const glass::Wiper geometry(worn, run.sim->map(), 0, 3);
  const glass::Wear wear(worn.residual_film_m, worn.blade_m, worn.wear, 3);
  for (int stroke = 0; stroke < 2; ++stroke) {
    run.run(weather(60.0), 3.0);
    // In one step, so that nothing flows back over what is wiped.
    glass::PaneTick tick = weather(0.0);
    tick.wiper_count = 1;
    tick.wipers[0] = {3, rad(40), rad(100), rad(100)};
    while (run.index % 2 == 0) run.tick(weather(0.0));
    run.tick(tick);
    const std::vector<int32_t> film = run.pane.readFilm();
    int streaks = 0, clean = 0;
    for (int i = 0; i < run.sim->map().texelCount(); ++i) {
      if (!run.sim->map().inside(i)) continue;
      // Texels beside the sweep's edge are run into from there within the step.
      const int columns = run.sim->map().grid().size.x;
      // A piece of the blade that has just come onto the pane runs dry.
      bool amid = run.sim->map().inside(i - 8) && run.sim->map().inside(i + 8) &&
                  isCovered(run, geometry, i - 8) && isCovered(run, geometry, i + 8);
      const auto edgeAt = [&](int k) {
        return wear.residual_m(
            geometry.crossingsAt(glm::dvec3(run.sim->map().texel(k).position_m)).along_m[0]);
      };
      double levelled_m = 0.0;
      for (const int beside : {i, i - 1, i + 1, i - columns, i + columns}) {
        amid = amid && run.sim->map().inside(beside) && isCovered(run, geometry, beside);
        if (amid) levelled_m += std::abs(edgeAt(beside) - edgeAt(i)) / 32.0;  // in a step, where films flow
      }
      if (!amid) continue;
      const double left_m = run.thickness_m(film, i), edge_m = edgeAt(i);
      EXPECT_NEAR(left_m, edge_m, 0.1e-6 + 0.02 * edge_m + levelled_m) << "texel " << i;
      streaks += edge_m > 4e-6 ? 1 : 0;
      clean += edge_m < 0.3e-6 ? 1 : 0;
    }
    EXPECT_GT(streaks, 500);
    EXPECT_GT(clean, 500);
  }
  const glass::PaneStats s = run.stats();
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

// On dry glass the water of one drop becomes an arc behind the blade: where the drop was and on from there,
// as broad as it was, and short.
TEST_F(Worn, onDryGlassABladeSmearsADropIntoAShortArc) {
  const Mesh mesh = windscreen(0.9, 0.6, kLevel_rad);
  const auto smeared = [&](double worn) {
    glass::PaneInfo info = paneInfo(mesh);
    Simulation run(gl, info);
    run.sim->setWiper(3, blade(worn));
    run.tick(weather(0.0));
    place(run, blade(worn), 0.4, 1e-3, 0.5);
    sweep(run, rad(60), rad(120));
    const std::vector<int32_t> film = run.pane.readFilm();
    const glass::Wiper geometry(blade(worn), run.sim->map(), 0, 3);
    const glass::Wear wear(blade(worn).residual_film_m, blade(worn).blade_m, worn, 3);
    double farthest_rad = 0.0;
    int beyond_residual = 0;
    for (int i = 0; i < run.sim->map().texelCount(); ++i) {
      if (!run.sim->map().inside(i) || run.thickness_m(film, i) < 0.5e-6) continue;
      const glass::Crossings c = geometry.crossingsAt(glm::dvec3(run.sim->map().texel(i).position_m));
      EXPECT_GT(c.count, 0);
      const double at_rad = c.angle_rad[0] - rad(90);  // the drop lies above the pivot, 0.4 m off
      EXPECT_GT(at_rad, -0.03);                        // steps end some millimetres before it
      EXPECT_LT(std::abs(c.along_m[0]), 0.02);
      farthest_rad = std::max(farthest_rad, at_rad);
      beyond_residual += run.thickness_m(film, i) > wear.residual_m(c.along_m[0]) + 0.5e-6 ? 1 : 0;
    }
    // Rubber that drags leaves more than its edge alone would.
    EXPECT_EQ(beyond_residual > 0, worn > 0.0);
    const glass::PaneStats s = run.stats();
    EXPECT_EQ(s.caught_pl, sumOf(s));
    EXPECT_EQ(s.drops, 0u);
    return 0.4 * farthest_rad;
  };
  EXPECT_EQ(smeared(0.0), 0.0);  // a new blade carries all of it
  const double arc_m = smeared(0.5);
  EXPECT_GT(arc_m, 0.01);
  EXPECT_LT(arc_m, 0.15);
}

TEST_F(Worn, aDropHigherThanTheLiftIsCut) {
  const Mesh mesh = windscreen(0.9, 0.6, kLevel_rad);
  glass::PaneInfo info = paneInfo(mesh);
  info.glass = glass::Glass::coated;
  Simulation run(gl, info);
  glass::WiperInfo cutting = blade(0.0);
  cutting.lift_m = 1.2e-3;
  run.sim->setWiper(3, cutting);
  run.tick(weather(0.0));
  const double angle = rad(95), radius_m = 2e-3;
  place(run, cutting, 0.4, radius_m, angle);
  place(run, cutting, 0.45, 0.4e-3, angle);  // low enough to be wiped whole
  sweep(run, rad(60), rad(120));
  const double height_m = radius_m * std::tan(0.5 * angle);
  const double kept_m3 = glass::capVolumeAbove(height_m, radius_m, cutting.lift_m);
  // The whole cap less the slice below the plane, by slices.
  const double sphere_m = radius_m / std::sin(angle);
  double slices_m3 = 0.0;
  for (int k = 0; k < 10000; ++k) {
    const double z = cutting.lift_m + (height_m - cutting.lift_m) * (k + 0.5) / 10000.0;
    const double up = z - (height_m - sphere_m);
    slices_m3 += kPi * (sphere_m * sphere_m - up * up) * (height_m - cutting.lift_m) / 10000.0;
  }
  EXPECT_NEAR(kept_m3 / slices_m3, 1.0, 1e-5);
  const glass::PaneStats s = run.stats();
  EXPECT_EQ(s.drops, 1u);
  EXPECT_NEAR(static_cast<double>(s.drops_pl), kept_m3 * 1e15, 1e-5 * kept_m3 * 1e15);  // heights are floats
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

// A drop that lies across the blade's end: part of it goes with the blade, part stays.
TEST_F(Worn, theBladesEndCutsADropThatLiesAcrossIt) {
  const Mesh mesh = windscreen(0.9, 1.0, kLevel_rad);
  glass::WiperInfo ending = wiper(kLevel_rad, 1.0);
  ending.lift_m = 0.02;
  const auto carriedShare = [&](double off_m) {
    Simulation run(gl, paneInfo(mesh));
    run.sim->setWiper(3, ending);
    run.tick(weather(0.0));
    place(run, ending, ending.arm_m + 0.5 * ending.blade_m + off_m, 9e-3, 0.5);
    sweep(run, rad(80), rad(94));
    const glass::PaneStats s = run.stats();
    EXPECT_EQ(s.caught_pl, sumOf(s));
    return static_cast<double>(s.ridge_pl) / static_cast<double>(s.caught_pl);
  };
  // Shares of a circle cut by a chord, 0.83 and 0.17 at 5 mm of 9, on texels of 3 mm.
  EXPECT_NEAR(carriedShare(-5e-3), 0.83, 0.12);
  EXPECT_NEAR(carriedShare(5e-3), 0.17, 0.12);
  EXPECT_EQ(carriedShare(10e-3), 0.0);
}

}  // namespace
}  // namespace rg::test
