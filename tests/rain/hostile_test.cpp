// A field that is told nonsense: it answers in time, draws nothing that is not a number, and is itself again
// when told sense.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "measure.h"
#include "rain/field.h"

namespace rg::rain::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                 kInfinite = std::numeric_limits<double>::infinity();

struct Nonsense {
  const char* name;
  std::function<void(Scene&)> spoil;
  int64_t until = 240;  // tick by which all is as it was
};
std::ostream& operator<<(std::ostream& out, const Nonsense& n) { return out << n.name; }

const std::vector<Nonsense> kNonsense = {
    {"eyeNotANumber", [](Scene& s) { s.views[0].eyeFromWorld[3].x = kNan; }},
    {"eyeInfinite", [](Scene& s) { s.views[0].eyeFromWorld[3].z = kInfinite; }},
    {"eyeBeyondTheMoon", [](Scene& s) { s.views[0].eyeFromWorld[3].x = 1e300; }},
    {"turnNotANumber", [](Scene& s) { s.views[0].eyeFromWorld[0].x = kNan; }},
    {"turnNull", [](Scene& s) { s.views[0].eyeFromWorld = glm::dmat4(0.0); }},
    {"frustumNotANumber", [](Scene& s) { s.views[0].clipFromEye[0][0] = kNan; }},
    {"frustumNull", [](Scene& s) { s.views[0].clipFromEye = glm::dmat4(0.0); }},
    {"frustumOfNoWidth", [](Scene& s) { s.views[0].clipFromEye[0][0] = 1e300; }},
    {"frustumReversed", [](Scene& s) { s.views[0].clipFromEye[2] *= -1.0; }},
    {"frustumTurnedOver",
     [](Scene& s) {
       s.views[0].clipFromEye[0][0] *= -1.0;
       s.views[0].clipFromEye[1][1] *= -1.0;
     }},
    {"frustumOfAlmostAllAround",
     [](Scene& s) { s.views[0].clipFromEye[0][0] = s.views[0].clipFromEye[1][1] = 1e-6; }},
    {"frustumOrthographic", [](Scene& s) { s.views[0].clipFromEye = glm::dmat4(1.0); }},
    {"eyeVelocityNotANumber", [](Scene& s) { s.views[0].eye_velocity_mps.y = kNan; }},
    {"eyeVelocityAbsurd", [](Scene& s) { s.views[0].eye_velocity_mps = dvec3(1e30); }},
    {"exposureNotANumber", [](Scene& s) { s.views[0].exposure_s = kNan; }},
    {"exposureOfAYear", [](Scene& s) { s.views[0].exposure_s = 3e7; }},
    {"windNotANumber", [](Scene& s) { s.weather.wind_mps.x = kNan; }},
    {"windInfinite", [](Scene& s) { s.weather.wind_mps.y = -kInfinite; }},
    {"windOf10000mps",
     [](Scene& s) {
       s.weather.wind_mps = {-1e4, 1e4, 1e4};
     },
     1000},  // till what it blew up through the canopy is down again
    {"windAbsurd",
     [](Scene& s) {
       s.weather.wind_mps = {1e12, 0, 0};
     }},
    {"rainNotANumber", [](Scene& s) { s.weather.rain_mm_h = kNan; }},
    {"rainNegative", [](Scene& s) { s.weather.rain_mm_h = -5; }},
    {"rainOf1e9mmh", [](Scene& s) { s.weather.rain_mm_h = 1e9; }, 1000},
    {"rainAbsurd", [](Scene& s) { s.weather.rain_mm_h = 1e30; }, 1000},
    {"carNotANumber", [](Scene& s) { s.vehicles[0].pose.position_m.x = kNan; }},
    {"carVelocityInfinite", [](Scene& s) { s.vehicles[0].pose.velocity_mps.x = kInfinite; }},
    {"carSpinsAbsurdly", [](Scene& s) { s.vehicles[0].pose.angular_velocity_radps.z = 1e18; }},
    {"carOrientationNull", [](Scene& s) { s.vehicles[0].pose.orientation = glm::dquat(0, 0, 0, 0); }},
    {"noViews", [](Scene& s) { s.views.clear(); }},
};

class Hostile : public ::testing::TestWithParam<Nonsense> {};

TEST_P(Hostile, nonsenseForSomeTicksDoesNoLastingHarm) {
  Field field({.capacity = 200000, .seed = 1});
  ASSERT_EQ(setBox(field, 1, {-2, -0.8, 0.2}, {2, 0.8, 1.9}, 7), "");
  ASSERT_EQ(setBox(field, 2, {5, -6, 4}, {25, 6, 4.5}), "");
  Scene sane = sceneWithView(25);
  sane.vehicles.emplace_back().id = 7;
  std::vector<Streak> streaks;
  for (; sane.index < GetParam().until; ++sane.index) {
    Scene scene = sane;
    if (sane.index >= 20 && sane.index < 30) GetParam().spoil(scene);
    field.tick(scene.tick());
    if (scene.views.empty()) continue;
    field.streaks(scene.views[0], tickTimeNs(scene.index), streaks);
    for (const Streak& s : streaks) {
      ASSERT_TRUE(std::isfinite(s.from_m.x + s.from_m.y + s.from_m.z + s.to_m.x + s.to_m.y + s.to_m.z))
          << "tick " << sane.index;
    }
    ASSERT_LE(field.stats().live, 200000u);
  }
  // As much rain as in a field that was never told nonsense.
  Field untouched({.capacity = 200000, .seed = 2});
  ASSERT_EQ(setBox(untouched, 1, {-2, -0.8, 0.2}, {2, 0.8, 1.9}, 7), "");
  ASSERT_EQ(setBox(untouched, 2, {5, -6, 4}, {25, 6, 4.5}), "");
  Scene calm = sceneWithView(25);
  calm.vehicles.emplace_back().id = 7;
  for (; calm.index < 60; ++calm.index) untouched.tick(calm.tick());
  EXPECT_NEAR(static_cast<double>(field.stats().live) / static_cast<double>(untouched.stats().live), 1.0,
              0.15);
}
INSTANTIATE_TEST_SUITE_P(Told, Hostile, ::testing::ValuesIn(kNonsense),
                         [](const auto& given) { return given.param.name; });

TEST(Hostile, fieldOfAbsurdSizeOrVisibilityStaysWithinItsRange) {
  for (const uint32_t capacity : {0u, 0xffffffffu}) {
    Field field({.capacity = capacity, .seed = 1});
    field.setVisibility({.factor = kNan, .reference_px = -kInfinite});
    field.setVisibility({.factor = 1e30, .reference_px = 1e30});
    Scene scene = sceneWithView(300);
    scene.views[0].exposure_s = 0.0;
    for (; scene.index < 3; ++scene.index) field.tick(scene.tick());
    EXPECT_LE(field.stats().live, 4'000'000u);
    EXPECT_GE(field.stats().live, 500u);
  }
}

TEST(Hostile, volumeOfNoSizeIsRefusedAndChangesNothing) {
  Field field, other;
  EXPECT_NE(setBox(field, 1, {0, 0, 1}, {0, 0, 1}), "");
  EXPECT_NE(setBox(field, 2, {0, 0, 1}, {5, 0, 1}), "");
  EXPECT_NE(setBox(field, 3, {kNan, 0, 1}, {5, 5, 2}), "");
  EXPECT_NE(setBox(field, 4, {-kInfinite, 0, 1}, {5, 5, 2}), "");
  EXPECT_FALSE(field.removeVolume(1));
  Scene scene = sceneWithView(25);
  for (; scene.index < 20; ++scene.index) field.tick(scene.tick()), other.tick(scene.tick());
  EXPECT_EQ(field.hash(), other.hash());
}

}  // namespace
}  // namespace rg::rain::test
