// The wind in the rain: how much of it drops of each size have near the ground, and how their streaks slant.
#include <gtest/gtest.h>

#include <algorithm>

#include "measure.h"
#include "rain/field.h"
#include "rain/wind_profile.h"

namespace rg::rain::test {
namespace {

constexpr double kGravity_mps2 = 9.81;

// ---- the profile ----

TEST(WindProfile, airFollowsTheLogarithmicLaw) {
  // U(z) = (u* / 0.4) ln(z / z0): by hand, ln(50) / ln(333.3), ln(15) / ln(100), ln(4) / ln(20).
  EXPECT_NEAR(WindProfile::of(0.03, 1.5).air_share, 0.6734, 1e-4);
  EXPECT_NEAR(WindProfile::of(0.1, 1.5).air_share, 0.5880, 1e-4);
  EXPECT_NEAR(WindProfile::of(0.5, 2.0).air_share, 0.4628, 1e-4);
  EXPECT_EQ(WindProfile::of(0.1, 10.0).air_share, 1.0);
}

// A drop falls from 60 m through the profile, its drag going with the square of its speed through the air and
// holding it at its terminal speed: steps of Runge and Kutta's, nothing linearised.
double sidewaysOf(double fall_mps, double roughness_m, double height_m, double wind_mps) {
  const auto windAt = [&](double z) {
    return wind_mps * std::log(z / roughness_m) / std::log(10.0 / roughness_m);
  };
  struct State {
    double z, u, w;
    State plus(const State& d, double s) const { return {z + s * d.z, u + s * d.u, w + s * d.w}; }
  };
  const auto slope = [&](const State& s) {
    const double past = windAt(s.z) - s.u,
                 drag = kGravity_mps2 * std::hypot(past, s.w) / (fall_mps * fall_mps);
    return State{s.w, drag * past, -kGravity_mps2 - drag * s.w};
  };
  State s{60.0, windAt(60.0), -fall_mps};
  constexpr double kStep_s = 1e-3;
  while (s.z > height_m) {
    const State a = slope(s), b = slope(s.plus(a, 0.5 * kStep_s)), c = slope(s.plus(b, 0.5 * kStep_s)),
                d = slope(s.plus(c, kStep_s));
    s = s.plus({a.z + 2 * b.z + 2 * c.z + d.z, a.u + 2 * b.u + 2 * c.u + d.u, a.w + 2 * b.w + 2 * c.w + d.w},
               kStep_s / 6.0);
  }
  return s.u;
}

// Within 2 %: what the closed form leaves out, the faster fall of a drop that the air passes, and the 60 m.
TEST(WindProfile, dropsHaveTheWindThatTheyFellThrough) {
  for (const double roughness_m : {0.03, 0.5}) {
    for (const double height_m : {1.5, 3.0}) {
      const WindProfile profile = WindProfile::of(roughness_m, height_m);
      for (const double fall_mps : {2.03, 4.0, 6.5, 8.0, 9.2}) {
        EXPECT_NEAR(profile.dropShare(fall_mps), sidewaysOf(fall_mps, roughness_m, height_m, 8.0) / 8.0,
                    0.02 * profile.dropShare(fall_mps))
            << fall_mps << " m/s, z0 " << roughness_m << ", " << height_m << " m";
      }
    }
  }
}

TEST(WindProfile, heavierDropsKeepMoreOfTheWindAboveAndNoneLessThanTheAir) {
  const WindProfile profile = WindProfile::of(0.1, 1.5);
  double before = profile.air_share;
  for (uint32_t kind = 0; kind < kSpeedClasses; ++kind) {
    EXPECT_GT(profile.drop_share[kind], before);
    before = profile.drop_share[kind];
  }
  EXPECT_LT(before, 1.0);
  // Flakes go with the air; stones bring the wind of heights above the 10 m it is stated at.
  for (uint32_t kind = kFirstSnow; kind < kFirstMelting; ++kind) {
    EXPECT_GT(profile.drop_share[kind], profile.air_share);
    EXPECT_LT(profile.drop_share[kind], 1.1 * profile.air_share);
  }
  for (uint32_t kind = kFirstHail; kind < kBouncedClass; ++kind) {
    EXPECT_GT(profile.drop_share[kind], before);
    before = profile.drop_share[kind];
  }
}

TEST(WindProfile, isNoneWithoutRoughnessAndWithinItsRangeForNonsense) {
  for (const WindProfile& none : {WindProfile{}, WindProfile::of(0.0, 1.5), WindProfile::of(-1.0, 1.5),
                                  WindProfile::of(std::nan(""), 1.5), WindProfile::of(0.1, std::nan(""))}) {
    EXPECT_EQ(none.air_share, 1.0);
    for (uint32_t kind = 0; kind < kBouncedClass; ++kind) EXPECT_EQ(none.drop_share[kind], 1.0);
  }
  for (const WindProfile& most : {WindProfile::of(1e300, -1e300), WindProfile::of(1e-300, 1e300)}) {
    EXPECT_GE(most.air_share, 0.0);
    EXPECT_LE(most.air_share, 1.0);
    for (const double share : most.drop_share) EXPECT_TRUE(share >= 0.0 && share < 1.5) << share;
  }
}

// Another roughness changes how drops go on, not where they are.
TEST(WindProfile, aChangeMovesNoDrop) {
  Field field({.capacity = 200000, .seed = 4});
  Scene scene = sceneWithView(25);
  scene.weather.wind_mps = {6, -3, 0};
  Upload upload;
  std::vector<LiveDrop> drops;
  for (; scene.index < 240; ++scene.index) field.tick(scene.tick());
  liveDrops(field, upload, drops);
  std::map<DropKey, dvec3> before;
  for (const LiveDrop& d : drops) before[d.key] = d.place_m;
  field.setWindProfile(WindProfile::of(0.5, 1.5));
  field.tick(scene.tick());
  liveDrops(field, upload, drops);
  size_t stayed = 0;
  for (const LiveDrop& d : drops) {
    const auto was = before.find(d.key);
    if (was == before.end()) continue;
    ++stayed;
    // A tick's way at 11 m/s and less.
    ASSERT_LT(glm::distance(d.place_m, was->second), 0.1);
  }
  EXPECT_GT(stayed, drops.size() / 2);
}

// ---- slant ----

struct Slant {
  const char* name;
  dvec3 wind_mps, eye_mps;
  double roughness_m;
};
std::ostream& operator<<(std::ostream& out, const Slant& s) { return out << s.name; }

// The angle between each streak and the way of its drop past the eye, in closed form by its diameter alone.
// Classes fall together: a drop's speed is up to 0.12 m/s off its own, and with it its share of the wind.
void expectSlant(const Field& field, const ViewState& view, int64_t tick, const WindProfile& profile,
                 const dvec3& wind_mps) {
  std::vector<Streak> streaks;
  field.streaks(view, tickTimeNs(tick), streaks);
  ASSERT_GT(streaks.size(), 500U);
  for (const Streak& s : streaks) {
    const double fall_mps = fallSpeed(1e3 * s.diameter_m);
    const dvec3 past = profile.dropShare(fall_mps) * wind_mps - dvec3(0, 0, fall_mps) - view.eye_velocity_mps;
    const double off = 0.121 + std::abs(profile.dropShare(fall_mps + 0.12) - profile.dropShare(fall_mps)) *
                                   glm::length(wind_mps);
    const dvec3 along = glm::normalize(s.to_m - s.from_m);
    ASSERT_LT(glm::length(glm::cross(along, glm::normalize(past))), off / glm::length(past) + 1e-4)
        << 1e3 * s.diameter_m << " mm";
    ASSERT_GT(glm::dot(along, past), 0.0);
  }
}

class Slants : public ::testing::TestWithParam<Slant> {};

TEST_P(Slants, byTheSizeOfTheDrop) {
  const Slant slant = GetParam();
  Field field({.capacity = 200000, .seed = 6});
  const WindProfile profile = WindProfile::of(slant.roughness_m, 1.5);
  field.setWindProfile(profile);
  Scene scene = sceneWithView(50);
  scene.weather.wind_mps = slant.wind_mps;
  for (; scene.index < 120; ++scene.index) {
    const double t = static_cast<double>(scene.index) * kTickSeconds;
    scene.views[0].eye_velocity_mps = slant.eye_mps;
    look(scene.views[0], dvec3(0, 0, 1.5) + slant.eye_mps * t, 0.3);
    field.tick(scene.tick());
  }
  expectSlant(field, scene.views[0], scene.index - 1, profile, slant.wind_mps);
}
INSTANTIATE_TEST_SUITE_P(Streaks, Slants,
                         ::testing::Values(Slant{"standingInStillAir", {0, 0, 0}, {0, 0, 0}, 0},
                                           Slant{"standing", {3, -4, 0}, {0, 0, 0}, 0},
                                           Slant{"driving", {3, -4, 0}, {100 * kKmh, 0, 0}, 0},
                                           Slant{"standingOverGrass", {-2, 8, 0}, {0, 0, 0}, 0.03},
                                           Slant{"drivingThroughASuburb", {5, 5, 0}, {50 * kKmh, 2, 0}, 1.0}),
                         [](const auto& given) { return given.param.name; });

// The wind backs by a right angle in a second: drops of all sizes go with it at every tick.
TEST(Slant, turnsWithTheWind) {
  Field field({.capacity = 200000, .seed = 6});
  Scene scene = sceneWithView(50);
  for (; scene.index < 240; ++scene.index) {
    const double turned = 1.5708 * std::clamp(static_cast<double>(scene.index - 60) / 120.0, 0.0, 1.0);
    scene.weather.wind_mps = 7.0 * dvec3(std::cos(turned), std::sin(turned), 0.0);
    field.tick(scene.tick());
    if (scene.index % 40 == 39)
      expectSlant(field, scene.views[0], scene.index, WindProfile{}, scene.weather.wind_mps);
  }
}

// A 2 mm drop exposed for 10 ms: 6.6 cm standing, 28.5 cm at 100 km/h; leaning by 65 deg at 50 km/h, 77 deg
// at 100. Within 2 %, and 1 deg: its class's speed is up to 0.12 m/s off.
TEST(Slant, ofATwoMillimetreDropIsWhatIsKnown) {
  struct Known {
    double kmh, long_m, lean_deg;
  };
  for (const Known& known : {Known{0, 0.066, 0}, Known{50, 0.0, 65}, Known{100, 0.285, 77}}) {
    Field field({.capacity = 200000, .seed = 8});
    Scene scene = sceneWithView(50);
    scene.views[0].exposure_s = 0.01;
    for (; scene.index < 60; ++scene.index) {
      place(scene, known.kmh * kKmh, 0.0);
      field.tick(scene.tick());
    }
    std::vector<Streak> streaks;
    field.streaks(scene.views[0], tickTimeNs(scene.index - 1), streaks);
    int found = 0;
    for (const Streak& s : streaks) {
      if (std::abs(s.diameter_m - 2e-3) > 0.02e-3) continue;
      ++found;
      const dvec3 way = s.to_m - s.from_m;
      if (known.long_m > 0.0) {
        EXPECT_NEAR(glm::length(way), known.long_m, 0.02 * known.long_m);
      }
      EXPECT_NEAR(glm::degrees(std::atan2(std::hypot(way.x, way.y), -way.z)), known.lean_deg, 1.0);
    }
    EXPECT_GT(found, 20);
  }
}

}  // namespace
}  // namespace rg::rain::test
