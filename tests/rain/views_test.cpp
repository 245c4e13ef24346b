// The field for views that cut, that go back in time, and for several at once: eyes, screens and mirrors.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "measure.h"
#include "rain/field.h"

namespace rg::rain::test {
namespace {

std::set<DropKey> liveKeys(Field& field) {
  Upload upload;
  std::vector<LiveDrop> drops;
  liveDrops(field, upload, drops);
  std::set<DropKey> keys;
  for (const LiveDrop& d : drops) keys.insert(d.key);
  EXPECT_EQ(keys.size(), drops.size()) << "a drop is there twice";
  return keys;
}

// Drops of the live ones that a view is to show.
std::set<DropKey> keysInView(Field& field, const ViewState& view) {
  Upload upload;
  std::vector<LiveDrop> drops;
  liveDrops(field, upload, drops);
  std::set<DropKey> keys;
  const Cone cone = coneOf(view);
  for (const LiveDrop& d : drops) {
    if (inVolume(cone, d.place_m, d.reach_m())) keys.insert(d.key);
  }
  return keys;
}

double dropsInView(double rain_mm_h, const ViewState& view) {
  const SizeLaw law = SizeLaw::of(rain_mm_h);
  double sum = 0.0;
  for (size_t kind = 0; kind < kSpeedClasses; ++kind)
    sum += expectedInView(law, kind, solidAngle(coneOf(view)));
  return sum;
}

// Counts of a picture are Poisson's: five standard errors.
void expectFull(Field& field, const ViewState& view, double rain_mm_h, const char* when) {
  const double expected = dropsInView(rain_mm_h, view);
  EXPECT_NEAR(static_cast<double>(keysInView(field, view).size()), expected, 5.0 * std::sqrt(expected))
      << when;
}

// ---- cuts ----

class Cut : public ::testing::TestWithParam<bool> {};

// Told or not: the first picture after it is as full as any, and so are those that follow.
TEST_P(Cut, showsAsMuchRainAtOnceAsBefore) {
  const bool told = GetParam();
  Field field({.capacity = 400000, .seed = 31});
  Scene scene = sceneWithView(50);
  for (int cut = 0; cut < 8; ++cut) {
    for (int i = 0; i < 12; ++i, ++scene.index) {
      const double x = 500.0 * cut + 20.0 * i * kTickSeconds;
      scene.views[0].discontinuity = told && i == 0;
      scene.views[0].eye_velocity_mps = {20, 0, 0};
      look(scene.views[0], {x, -3.0 * cut, 1.5 + cut}, 1.3 * cut);
      field.tick(scene.tick());
      if (i > 2 && i < 11) continue;
      expectFull(field, scene.views[0], 50,
                 ("cut " + std::to_string(cut) + ", tick " + std::to_string(i)).c_str());
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Views, Cut, ::testing::Bool(),
                         [](const auto& told) { return told.param ? "told" : "untold"; });

// ---- back in time ----

TEST(Seeking, backWhileDrivingAndTurningShowsTheSameDropsAsThen) {
  Field field({.capacity = 200000, .seed = 32});
  Scene scene = sceneWithView(25);
  scene.weather.wind_mps = {-3, 2, 0};
  const auto tick = [&](int64_t index) {
    scene.index = index;
    place(scene, 15, 0.8 * static_cast<double>(index) * kTickSeconds);
    field.tick(scene.tick());
  };
  std::vector<std::set<DropKey>> then;
  for (int64_t i = 0; i <= 240; ++i) {
    tick(i);
    if (i % 60 == 0) then.push_back(keysInView(field, scene.views[0]));
  }
  for (const int64_t to : {180, 60, 120, 0}) {
    field.seek(to);
    tick(to);
    const std::set<DropKey> again = keysInView(field, scene.views[0]);
    EXPECT_GT(again.size(), 1000u);
    EXPECT_EQ(again, then[static_cast<size_t>(to / 60)]) << "tick " << to;
  }
}

// ---- several at once ----

struct Channels {
  const char* name;
  std::vector<ViewState> views;
};
std::ostream& operator<<(std::ostream& out, const Channels& c) { return out << c.name; }

ViewState channel(uint32_t id, const dvec3& eye, double heading_rad) {
  ViewState view = viewAt(eye, heading_rad);
  view.id = id;
  return view;
}

// A mirror: looks back, and its projection turns the picture over left to right.
ViewState mirror(uint32_t id, const dvec3& eye) {
  ViewState view = channel(id, eye, 3.0);
  view.clipFromEye = glm::scale(glm::dmat4(1.0), dvec3(-1, 1, 1)) * view.clipFromEye;
  return view;
}

class Several : public ::testing::TestWithParam<Channels> {};

TEST_P(Several, haveTheUnionOfWhatEachHasAndNothingTwice) {
  std::vector<ViewState> views = GetParam().views;
  Field all({.capacity = 400000, .seed = 33});
  std::vector<std::unique_ptr<Field>> each;
  for (size_t i = 0; i < views.size(); ++i)
    each.push_back(std::make_unique<Field>(FieldSettings{.capacity = 400000, .seed = 33}));
  Scene scene = sceneWithView(25);
  // The lattice begins at the first vehicle: the same in all fields.
  scene.vehicles.emplace_back().id = 7;
  for (; scene.index < 60; ++scene.index) {
    for (ViewState& view : views) {
      view.eye_velocity_mps = {15, 0, 0};
      if (scene.index > 0)
        view.eyeFromWorld =
            view.eyeFromWorld * glm::translate(glm::dmat4(1.0), dvec3(-15 * kTickSeconds, 0, 0));
    }
    scene.views = views;
    all.tick(scene.tick());
    for (size_t i = 0; i < views.size(); ++i) {
      scene.views = {views[i]};
      each[i]->tick(scene.tick());
    }
  }
  std::set<DropKey> united;
  size_t sum = 0;
  for (const auto& field : each) {
    const std::set<DropKey> keys = liveKeys(*field);
    united.insert(keys.begin(), keys.end());
    sum += keys.size();
  }
  EXPECT_EQ(liveKeys(all), united);
  EXPECT_LT(united.size(), sum);  // they overlap
  for (const ViewState& view : views) expectFull(all, view, 25, "each view");
}
INSTANTIATE_TEST_SUITE_P(
    Views, Several,
    ::testing::Values(Channels{"stereo", {channel(1, {0, 0.0325, 1.5}, 0), channel(2, {0, -0.0325, 1.5}, 0)}},
                      Channels{"threeScreens",
                               {channel(1, {0, 0, 1.5}, 0), channel(2, {0, 0, 1.5}, 1.0472),
                                channel(3, {0, 0, 1.5}, -1.0472)}},
                      Channels{"cockpitAndMirrors",
                               {channel(1, {0, 0.4, 1.3}, 0), mirror(2, {0.3, 0, 1.4}),
                                mirror(3, {0.8, 0.9, 1.0})}}),
    [](const auto& given) { return given.param.name; });

// A view that is told no more takes its drops along, and leaves the others theirs.
TEST(Several, oneThatEndsLeavesTheOthersAsTheyAre) {
  Field field({.capacity = 400000, .seed = 34});
  Scene scene = sceneWithView(25);
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i, ++scene.index) field.tick(scene.tick());
  };
  run(30);
  scene.views.push_back(channel(2, {0, 0, 1.5}, 2.0));
  run(30);
  EXPECT_GT(liveKeys(field).size(), keysInView(field, scene.views[0]).size() * 3 / 2);
  scene.views.pop_back();
  run(1);
  expectFull(field, scene.views[0], 25, "the one that stays");
  Field alone({.capacity = 400000, .seed = 34});
  Scene other = sceneWithView(25);
  for (; other.index < scene.index; ++other.index) alone.tick(other.tick());
  EXPECT_EQ(field.hash(), alone.hash());
}

// ---- the end of sight ----

// Drops come and go where nothing of them is seen: the fade is full to a little over half of the reach, and
// nothing at its end.
TEST(Reach, fadesToNothingAtItsEnd) {
  Field field({.capacity = 400000, .seed = 35});
  Scene scene = sceneWithView(50);
  for (; scene.index < 30; ++scene.index) field.tick(scene.tick());
  std::vector<Streak> streaks;
  field.streaks(scene.views[0], tickTimeNs(scene.index - 1), streaks);
  int near = 0, far = 0;
  for (const Streak& s : streaks) {
    const double share = glm::distance(s.drop_m, dvec3(0, 0, 1.5)) / (kReachPerDiameter * s.diameter_m);
    if (share < 0.55) {
      EXPECT_EQ(s.fade, 1.0);
      ++near;
    } else if (share > 0.97) {
      EXPECT_LT(s.fade, 0.02);
      ++far;
    }
  }
  EXPECT_GT(near, 100);
  EXPECT_GT(far, 100);
}

// ---- far sight ----

// However far drops are seen, they are those of the same standing field, and as many as the law says.
TEST(Reach, settingItFartherShowsMoreOfTheSameRain) {
  Field field({.capacity = 4000000, .seed = 36});
  Scene scene = sceneWithView(2);
  std::set<DropKey> before;
  for (const double factor : {1.0, 2.0, 3.0, 4.0}) {
    field.setVisibility({.factor = factor, .reference_px = 1.5 * 1663.0});
    field.tick(scene.tick());
    const std::set<DropKey> now = liveKeys(field);
    EXPECT_TRUE(std::ranges::includes(now, before)) << factor;
    EXPECT_GT(now.size(), before.size());
    before = now;
    double in_view = 0.0;
    Upload upload;
    std::vector<LiveDrop> drops;
    liveDrops(field, upload, drops);
    const Cone cone = coneOf(scene.views[0]);
    const double farther = factor * 1.5 / 1.25;
    for (const LiveDrop& d : drops) in_view += inVolume(cone, d.place_m, farther * d.reach_m()) ? 1.0 : 0.0;
    const double expected = std::pow(farther, 3) * dropsInView(2, scene.views[0]);
    EXPECT_NEAR(in_view, expected, 5.0 * std::sqrt(expected)) << factor;
  }
}

}  // namespace
}  // namespace rg::rain::test
