// No streak is drawn where it is dry, and none is missing where it is not: the shipped scenarios and models,
// frame by frame, against geometry that knows nothing of how the plugin shelters its drops.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "drive.h"
#include "rain/size_law.h"

namespace oracle {
namespace {

using rg::rain::Streak;

struct FieldTally {
  uint64_t frames = 0, streaks = 0, clipped = 0, inside = 0, bounced = 0;
  double deepest_m = -1e30;
};

bool isStraight(uint32_t kind) {
  const auto hydrometeor = rg::rain::fallClasses()[kind].hydrometeor;
  return hydrometeor == rg::rain::Hydrometeor::kRain || hydrometeor == rg::rain::Hydrometeor::kHail;
}

FieldTally tallyOf(Drive& drive) {
  FieldTally t;
  std::vector<Streak> streaks;
  for (; drive.next(); ++t.frames) {
    const rg::ViewState view = drive.view();
    drive.field().streaks(view, drive.pluginTime_ns(), streaks);
    t.streaks += streaks.size();
    for (const Streak& s : streaks) {
      const double whole_m =
          glm::length(drive.dropVelocity(s.kind) - view.eye_velocity_mps) * view.exposure_s;
      // Flakes swing, and stones that bounced go their own way: theirs may be shorter unclipped.
      if (isStraight(s.kind)) t.clipped += glm::distance(s.from_m, s.to_m) < 0.99 * whole_m ? 1u : 0u;
      t.bounced += s.kind == rg::rain::kBouncedClass ? 1u : 0u;
      const double depth_m = drive.depth(s.from_m, s.to_m);
      t.deepest_m = std::max(t.deepest_m, depth_m);
      t.inside += depth_m > kTolerance_m ? 1u : 0u;
    }
  }
  return t;
}

void driveAndJudge(const Variant& variant, double frame_s) {
  Drive drive(variant, frame_s);
  const FieldTally t = tallyOf(drive);
  std::printf("%s: %llu frames, %llu streaks, %llu clipped, %llu bounced, deepest %.3f mm\n",
              nameOf(variant).c_str(), static_cast<unsigned long long>(t.frames),
              static_cast<unsigned long long>(t.streaks), static_cast<unsigned long long>(t.clipped),
              static_cast<unsigned long long>(t.bounced), t.deepest_m * 1e3);
  EXPECT_EQ(t.inside, 0u);
  EXPECT_TRUE(drive.was_under_cover);
  EXPECT_GT(t.streaks, 300 * t.frames) << "rain is seen from under cover too, but for deep in the tunnel";
  if (variant.falls != "snow") {
    EXPECT_GT(t.clipped, t.frames) << "some streaks end at volumes";
  }
  if (variant.falls == "hail") {
    EXPECT_GT(t.bounced, t.frames);
  }
  if (!variant.brake_for.empty()) {
    EXPECT_GT(drive.hardest_braking_mps2, 9.81);
  }
}

class Drives : public ::testing::TestWithParam<Variant> {};
TEST_P(Drives, drawNoStreakInsideAnyVolumeAtAnyFrame) { driveAndJudge(GetParam(), kBriefFrame_s); }
INSTANTIATE_TEST_SUITE_P(Brief, Drives, ::testing::ValuesIn(briefly(kKinds)),
                         [](const auto& v) { return nameOf(v.param); });

class WholeDrives : public ::testing::TestWithParam<Variant> {};
TEST_P(WholeDrives, drawNoStreakInsideAnyVolumeAtAnyFrame) { driveAndJudge(GetParam(), kSampledFrame_s); }
INSTANTIATE_TEST_SUITE_P(LongKinds, WholeDrives, ::testing::ValuesIn(kKinds),
                         [](const auto& v) { return nameOf(v.param); });
INSTANTIATE_TEST_SUITE_P(LongOthers, WholeDrives, ::testing::ValuesIn(kOthers),
                         [](const auto& v) { return nameOf(v.param); });

TEST(Oracle, seesTheRainThatAFieldWithoutShelterDrawsInside) {
  for (const std::string falls : {"", "snow"}) {
    Variant variant = briefly(Variant{.scenario = "canopy", .falls = falls, .sheltered = false});
    variant.changes.insert(variant.changes.end(), {"drive.start_m=1040", "seconds=1.5"});
    Drive drive(variant);
    const FieldTally t = tallyOf(drive);
    EXPECT_GT(t.inside, 100 * t.frames) << falls;
  }
}

// ---- none is missing ----

// Where the car's cabin never was between the rain and the place: before its nose, or higher than its roof.
// (Not with the wind from behind.)
bool beyondTheCar(const Drive& drive, const glm::dvec3& p) {
  const host::CarState car = drive.car();
  const glm::dvec3 q = glm::conjugate(car.orientation) * (p - car.position_m);
  return q.x > 4.0 || q.z > 1.8;
}

// Whether rain comes down to a place past all of the road's volumes, each made smaller (or with a negative
// sign larger) by `margin_m`.
bool reached(const Drive& drive, const glm::dvec3& p, const glm::dvec3& velocity_mps, double margin_m) {
  const glm::dvec3 from = p - velocity_mps * (295.0 / glm::length(velocity_mps));
  return std::ranges::none_of(drive.roadHulls(), [&](const Hull& h) { return h.depth(from, p) > margin_m; });
}

// The number of drops to be seen: the size law's density, times the part of each class's cone that rain
// reaches, found by throwing points.
double expectedDrops(const Drive& drive, const rg::ViewState& view, std::mt19937_64& random) {
  constexpr int kPoints = 200;
  const rg::rain::SizeLaw law = rg::rain::SizeLaw::of(drive.rain_mm_h());
  const glm::dmat4 worldFromEye = glm::inverse(view.eyeFromWorld);
  const double wide = 1.0 / view.clipFromEye[0][0], high = 1.0 / view.clipFromEye[1][1];
  const rg::rain::Visibility visibility;
  std::uniform_real_distribution<double> one(0.0, 1.0);
  double sum = 0.0;
  for (uint32_t kind = 0; kind < rg::rain::kSpeedClasses; ++kind) {
    const rg::rain::SpeedClass& c = rg::rain::speedClasses()[kind];
    const double density = law.numberDensity(c.from_mm, c.to_mm);
    const glm::dvec3 velocity = drive.dropVelocity(kind);
    for (int i = 0; i < kPoints; ++i) {
      const double reach_m = visibility.factor * visibility.reference_px * 1e-3 *
                             law.quantile(c.from_mm, c.to_mm, (i + 0.5) / kPoints);
      const glm::dvec3 along(wide * (2.0 * one(random) - 1.0), high * (2.0 * one(random) - 1.0), -1.0);
      const double deepest_m = reach_m / glm::length(along);
      const glm::dvec3 p(worldFromEye * glm::dvec4(along * (deepest_m * std::cbrt(one(random))), 1.0));
      if (!beyondTheCar(drive, p) || !reached(drive, p, velocity, 0.0)) continue;
      sum += density * 4.0 * wide * high * deepest_m * deepest_m * deepest_m / 3.0 / kPoints;
    }
  }
  return sum;
}

bool inView(const rg::ViewState& view, const glm::dvec3& p) {
  const glm::dvec4 clip = view.clipFromEye * view.eyeFromWorld * glm::dvec4(p, 1.0);
  return clip.w > 0.0 && std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w;
}

class OpenAir : public ::testing::TestWithParam<Variant> {};

// Each frame's drops are others (half a second on, most have fallen past), so that the count is Poisson's; 4
// standard errors, and 2 % for the points thrown and for wakes of volumes beyond the 300 m that a drop's past
// is followed.
TEST_P(OpenAir, holdsTheDropsOfTheSizeLawAndShadowsHoldNone) {
  Drive drive(GetParam());
  std::mt19937_64 random(1);
  std::vector<Streak> streaks;
  double seen = 0.0, expected = 0.0;
  uint64_t in_shadow = 0;
  for (int frame = 0; drive.next(); ++frame) {
    if (frame % 8 != 0) continue;
    const rg::ViewState view = drive.view();
    drive.field().streaks(view, drive.pluginTime_ns(), streaks);
    for (const Streak& s : streaks) {
      const glm::dvec3 velocity = drive.dropVelocity(s.kind);
      in_shadow += reached(drive, s.drop_m, velocity, 0.01) ? 0u : 1u;
      seen += inView(view, s.drop_m) && beyondTheCar(drive, s.drop_m) ? 1.0 : 0.0;
    }
    expected += expectedDrops(drive, view, random);
  }
  std::printf("%s: %.0f drops seen, %.0f expected\n", nameOf(GetParam()).c_str(), seen, expected);
  EXPECT_EQ(in_shadow, 0u);
  EXPECT_GT(expected, 3000.0);
  EXPECT_NEAR(seen, expected, 0.02 * expected + 4.0 * std::sqrt(expected));
}
INSTANTIATE_TEST_SUITE_P(Brief, OpenAir,
                         ::testing::Values(briefly(Variant{.scenario = "tunnel"}),
                                           briefly(Variant{.scenario = "canopy", .camera = "outside"}),
                                           briefly(Variant{.scenario = "canopy",
                                                           .changes = {"weather.wind_y_mps=20",
                                                                       "plugin.wind.roughness_m=0.5"}})),
                         [](const auto& v) { return nameOf(v.param); });
INSTANTIATE_TEST_SUITE_P(
    LongWhole, OpenAir,
    ::testing::Values(Variant{.scenario = "tunnel"}, Variant{.scenario = "canopy"},
                      Variant{.scenario = "canopy", .camera = "outside"},
                      Variant{.scenario = "canopy", .changes = {"weather.wind_y_mps=40"}},
                      Variant{.scenario = "canopy",
                              .changes = {"weather.wind_y_mps=20", "plugin.wind.roughness_m=0.5"}},
                      Variant{.scenario = "tunnel", .changes = {"weather.wind_x_mps=-40"}}),
    [](const auto& v) { return nameOf(v.param); });

// Else the eye would be told to move and stand still, and drops be drawn where they are not.
TEST(Drives, areWhereTheirVelocitySaysFromTheFirstMoment) {
  constexpr double kFrame_s = 1.0 / 480.0;  // four to a tick
  Drive drive(Variant{.scenario = "fast"}, kFrame_s);
  ASSERT_TRUE(drive.next());
  for (int frame = 0; frame < 8; ++frame) {
    const host::CarState before = drive.car();
    ASSERT_TRUE(drive.next());
    EXPECT_NEAR(glm::distance(drive.car().position_m, before.position_m), 130.0 / 3.6 * kFrame_s, 1e-3)
        << frame;
    EXPECT_NEAR(glm::length(before.velocity_mps), 130.0 / 3.6, 0.1) << frame;
  }
}

}  // namespace
}  // namespace oracle
