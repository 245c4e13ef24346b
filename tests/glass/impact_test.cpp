// What the glass catches against the integral over sizes and surface.
#include "glass/impact.h"

#include <gtest/gtest.h>

#include "scene.h"

namespace rg::test {
namespace {

// physics.md 2: R_eff = R cos a + W V sin a, W the water in the air.
double expectedRate_m3_s(const glass::PaneTick& tick, double area_m2, double slope_rad, double speed_mps) {
  double water = 0.0, rate = 0.0;
  for (uint32_t i = 0; i < tick.class_count; ++i) {
    const double volume =
        tick.classes[i].number_per_m3 * kPi / 6.0 * std::pow(tick.classes[i].diameter_m, 3.0);
    water += volume;
    rate += volume * tick.classes[i].fall_speed_mps;
  }
  return area_m2 * (rate * std::cos(slope_rad) + water * speed_mps * std::sin(slope_rad));
}

TEST(Impact, catchMatchesTheIntegral) {
  const Mesh mesh = windscreen();
  const glass::PaneMap map(paneInfo(mesh));
  for (const double rate : {1.0, 10.0, 100.0}) {
    for (const double kmh : {0.0, 50.0, 130.0}) {
      glass::PaneTick tick = weather(rate, kmh / 3.6);
      const double expected = expectedRate_m3_s(tick, map.area_m2(), rad(30), kmh / 3.6);
      EXPECT_NEAR(glass::catchRate_m3_s(map, tick) / expected, 1.0, 1e-3);  // float normals
      std::vector<glass::Impact> impacts;
      double caught = 0.0, squares = 0.0;
      const int ticks = static_cast<int>(std::lround(60000.0 / (rate * (10.0 + kmh))));
      const int run = std::max(ticks, 240);
      for (int k = 0; k < run; ++k) {
        tick.index = k;
        glass::findImpacts(map, tick, 5, 1, impacts);
        for (const glass::Impact& impact : impacts) {
          const double volume = static_cast<double>(impact.volume_pl) * 1e-15;
          caught += volume;
          squares += volume * volume;
        }
      }
      // 2 % and four standard deviations of the Poisson sum that was drawn.
      const double share = caught / (expected * run * kTickSeconds);
      EXPECT_NEAR(share, 1.0, 0.02 + 4.0 * std::sqrt(squares) / caught)
          << rate << " mm/h, " << kmh << " km/h";
      const double spread = std::sqrt(squares) / std::max(caught, 1e-30);
      EXPECT_LT(spread, 0.02) << "too few drops to tell";
    }
  }
}

// Clanet's D We^(1/4) or D Re^(1/5) across, of drops of one size that fall straight onto level glass, a third
// of it below a roof.
TEST(Impact, lamellaeRunOverAPlaceAsOftenAsTheirAreaSays) {
  const Mesh mesh = windscreen(1.5, 0.8, 1e-4);
  const glass::PaneMap map(paneInfo(mesh));
  glass::PaneTick tick = weather(0.0);
  tick.class_count = 1;
  for (size_t r = 0; r < tick.wet_share.size(); ++r) tick.wet_share[r] = r % 3 == 0 ? 0.0f : 1.0f;
  double open_m2 = 0.0;
  for (int r = 0; r < glass::kRegions; ++r)
    open_m2 +=
        static_cast<double>(tick.wet_share[static_cast<size_t>(r)]) * glm::length(map.regionArea_m2(r));
  for (const double fall_mps : {0.5, 6.5, 25.0}) {
    constexpr double kDiameter_m = 2e-3, kNumber_per_m3 = 400.0;
    tick.classes[0] = {kDiameter_m, kNumber_per_m3, fall_mps};
    const double weber = 1000.0 * fall_mps * fall_mps * kDiameter_m / 0.072,
                 reynolds = 1e6 * fall_mps * kDiameter_m;
    const double across_m = kDiameter_m * std::min(std::pow(weber, 0.25), std::pow(reynolds, 0.2));
    const double expected_hz = kNumber_per_m3 * fall_mps * kPi / 4.0 * across_m * across_m;
    EXPECT_NEAR(glass::lamellae_hz(map, tick) / expected_hz, 1.0, 1e-3) << "float normals";
    // ... and the impacts' sum tells the same.
    std::vector<glass::Impact> impacts;
    double wetted_m2 = 0.0;
    size_t count = 0;
    constexpr int kTicks = 400;
    for (int k = 0; k < kTicks; ++k) {
      tick.index = k;
      glass::findImpacts(map, tick, 5, 1, impacts);
      for (const glass::Impact& impact : impacts)
        wetted_m2 += kPi * std::pow(glass::lamellaRadius_m(impact), 2.0);
      count += impacts.size();
    }
    const double drawn_hz = wetted_m2 / (open_m2 * kTicks * kTickSeconds);
    EXPECT_NEAR(drawn_hz / expected_hz, 1.0, 4.0 / std::sqrt(static_cast<double>(count)) + 1e-3);
  }
  tick.wet_share.fill(0.0f);
  EXPECT_EQ(glass::lamellae_hz(map, tick), 0.0) << "all of it below a roof";
}

TEST(Impact, placesGoByAreaAndIncidence) {
  const Mesh mesh = windscreen(1.5, 0.8, rad(30), 0.25, 40);
  const glass::PaneMap map(paneInfo(mesh));
  glass::PaneTick tick = weather(50.0, 20.0);
  tick.air_mps.y = 8.0;  // wind from the right: the right cheek of a bulging pane catches more
  double right = 0.0, all = 0.0, right_expected = 0.0, all_expected = 0.0;
  std::vector<glass::Impact> impacts;
  for (int k = 0; k < 400; ++k) {
    tick.index = k;
    glass::findImpacts(map, tick, 5, 1, impacts);
    for (const glass::Impact& impact : impacts) {
      all += 1.0;
      if (map.glassFromGrid(impact.place_m).x > 0.2) right += 1.0;
      ASSERT_TRUE(map.inside(impact.texel));
    }
  }
  for (int i = 0; i < map.texelCount(); ++i) {
    if (!map.inside(i)) continue;
    double weight = 0.0;
    for (uint32_t c = 0; c < tick.class_count; ++c) {
      const glm::dvec3 v = tick.air_mps + tick.classes[c].fall_speed_mps * tick.down;
      weight += tick.classes[c].number_per_m3 * std::max(0.0, -glm::dot(v, glm::dvec3(map.texel(i).normal))) *
                static_cast<double>(map.texel(i).area_m2);
    }
    all_expected += weight;
    if (map.glassFromGrid(map.middleOf(i)).x > 0.2) right_expected += weight;
  }
  const double share = right_expected / all_expected;
  EXPECT_NEAR(right / all, share, 4.0 * std::sqrt(share * (1.0 - share) / all));
}

// Glass bent so far round that some of it faces away from the stream that meets it straight: that catches
// nothing, and takes nothing from what the rest catches.
TEST(Impact, glassThatFacesAwayTakesNoneFromTheRest) {
  constexpr double kRadius_m = 0.2, kHalfArc_rad = 2.1;
  Mesh mesh = windscreen(2.0 * kHalfArc_rad * kRadius_m, 0.4, rad(30), 0.0, 40);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double turn = kHalfArc_rad * (2.0 * static_cast<double>(mesh.uvs[i].x) - 1.0);
    mesh.positions[i] = glm::vec3(glm::dvec3(kRadius_m * std::cos(turn), -kRadius_m * std::sin(turn),
                                             0.4 * static_cast<double>(mesh.uvs[i].y)));
  }
  const glass::PaneMap map(paneInfo(mesh));
  glass::PaneTick tick;
  tick.wet_share.fill(1.0f);
  tick.air_mps = -8.0 * map.meanNormal();
  tick.class_count = 1;
  tick.classes[0].diameter_m = 1e-3;
  tick.classes[0].number_per_m3 = 5e3;
  std::vector<glass::Impact> impacts;
  double caught = 0.0;
  constexpr int kTicks = 200;
  for (tick.index = 0; tick.index < kTicks; ++tick.index) {
    glass::findImpacts(map, tick, 5, 1, impacts);
    caught += static_cast<double>(impacts.size());
  }
  const double expected = 5e3 * 8.0 * (2.0 * kRadius_m * 0.4) * kTicks * kTickSeconds;  // its outline's
  // Regions count as their means, those on the border between both too: 2 %. And 4 standard deviations.
  EXPECT_NEAR(caught / expected, 1.0, 0.02 + 4.0 / std::sqrt(expected));
}

TEST(Impact, nothingLandsWhereShelteredOrInTheLee) {
  const Mesh mesh = windscreen();
  const glass::PaneMap map(paneInfo(mesh));
  std::vector<glass::Impact> impacts;
  glass::PaneTick tick = weather(100.0, 20.0);
  tick.wet_share.fill(0.0f);
  glass::findImpacts(map, tick, 5, 1, impacts);
  EXPECT_TRUE(impacts.empty());
  for (int r = 0; r < glass::kRegions; r += 2)
    tick.wet_share[static_cast<size_t>(r)] = 1.0f;  // every other column of regions
  for (tick.index = 0; tick.index < 60; ++tick.index) {
    glass::findImpacts(map, tick, 5, 1, impacts);
    EXPECT_FALSE(impacts.empty());
    for (const glass::Impact& impact : impacts) {
      const int column = impact.texel % map.grid().size.x * glass::kRegionsAcross / map.grid().size.x;
      ASSERT_EQ(column % 2, 0);
    }
  }
  tick = weather(100.0, -60.0);  // backwards: the wind is from behind
  glass::findImpacts(map, tick, 5, 1, impacts);
  EXPECT_TRUE(impacts.empty());
}

}  // namespace
}  // namespace rg::test
