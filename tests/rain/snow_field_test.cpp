// Snow, sleet and hail in the field: as many of each class as the law says, water as asked, none inside of
// volumes, the same at every machine and cut, and nothing where nothing falls.
#include <gtest/gtest.h>

#include "measure.h"
#include "rain/hail_law.h"
#include "rain/snow_law.h"

namespace rg::rain::test {
namespace {

struct Kind {
  const char* name;
  double rain_mm_h, snow_mm_h, hail_mm_h, temperature_c;
  WeatherState weather() const {
    WeatherState w;
    w.rain_mm_h = rain_mm_h;
    w.snow_mm_h = snow_mm_h;
    w.hail_mm_h = hail_mm_h;
    w.temperature_c = temperature_c;
    w.wind_mps = {2, 1, 0};
    w.ground_height_m = -30.0;  // below all that is seen: no stone is missing
    return w;
  }
};
std::ostream& operator<<(std::ostream& out, const Kind& k) { return out << k.name; }
const Kind kKinds[] = {{"snow", 0, 1.0, 0, -4}, {"sleet", 3, 2.0, 0, 1}, {"hail", 0, 0, 100, 10}};

// Water that a particle brings down, mm/h m3: to be divided by the space it was counted in.
double waterOf(const LiveDrop& d) {
  const Hydrometeor h = fallClasses()[d.kind].hydrometeor;
  const double mm = 1e3 * d.diameter_m;
  double mm3 = 0.0;
  if (h == Hydrometeor::kSnow) mm3 = 0.037 * std::pow(mm, 1.9);
  if (h == Hydrometeor::kHail) mm3 = 0.9 * std::acos(-1.0) / 6.0 * mm * mm * mm;
  return 3.6e-3 * mm3 * -d.velocity_mps.z;
}

class KindOf : public ::testing::TestWithParam<Kind> {};

// 26 m apart, so that each look is at other particles (they are seen to 25 m at most, and most to 12): counts
// are Poisson's. Chi-square over the classes is below mean + 5 sigma of itself. The water in each look's
// space sums to the rate within 1 % and 4 standard errors, which the sum itself tells.
TEST_P(KindOf, fillsTheViewAsItsLawSaysAndBringsDownWhatWasAsked) {
  const Kind kind = GetParam();
  Field field({.capacity = 400000, .seed = 8});
  Scene scene = sceneWithView(0.0);
  scene.weather = kind.weather();
  const InTheAir air = InTheAir::of(ratesOf(scene.weather));
  const double solid_angle = solidAngle(coneOf(scene.views[0]));
  std::array<double, kClasses> seen{}, expected{};
  double water[kHydrometeors] = {}, variance[kHydrometeors] = {};
  Upload upload;
  std::vector<LiveDrop> drops;
  constexpr int kLooks = 30;
  for (int look_at = 0; look_at < kLooks; ++look_at) {
    scene.index = 10 * look_at;
    look(scene.views[0], {26.0 * look_at, 0, 1.5}, 0.0);
    scene.views[0].discontinuity = true;
    field.tick(scene.tick());
    liveDrops(field, upload, drops);
    const Cone cone = coneOf(scene.views[0]);
    for (const LiveDrop& d : drops) {
      if (!inVolume(cone, d.place_m, d.reach_m())) continue;
      ++seen[d.kind];
      const double per_look = waterOf(d) / (solid_angle * std::pow(d.reach_m(), 3) / 3.0) / kLooks;
      const auto h = static_cast<uint32_t>(fallClasses()[d.kind].hydrometeor);
      water[h] += per_look;
      variance[h] += per_look * per_look;
    }
  }
  EXPECT_EQ(field.stats().thinning, 1.0);
  double chi_square = 0.0;
  int classes = 0;
  for (uint32_t k = 0; k < kClasses; ++k) {
    constexpr int kSteps = 400;
    for (int i = 0; i < kSteps && air.density_m3[k] > 0.0; ++i) {
      LiveDrop d;
      d.kind = k;
      d.diameter_m =
          1e-3 * drawnDiameter_mm(fallClasses()[k].hydrometeor, air.quantile(k, (i + 0.5) / kSteps));
      expected[k] += kLooks * air.density_m3[k] * solid_angle * std::pow(d.reach_m(), 3) / 3.0 / kSteps;
    }
    EXPECT_TRUE(air.density_m3[k] > 0.0 || seen[k] == 0.0) << "class " << k;
    if (expected[k] < 20.0) continue;
    ++classes;
    chi_square += (seen[k] - expected[k]) * (seen[k] - expected[k]) / expected[k];
  }
  EXPECT_GT(classes, 5);
  EXPECT_LT(chi_square, classes + 5.0 * std::sqrt(2.0 * classes));
  for (const Hydrometeor h : {Hydrometeor::kSnow, Hydrometeor::kHail}) {
    const auto i = static_cast<uint32_t>(h);
    EXPECT_NEAR(water[i], air.rates[h], 0.01 * air.rates[h] + 4.0 * std::sqrt(variance[i]));
  }
}

TEST_P(KindOf, isTheSameWhoeverTicksIt) {
  uint64_t hashes[2] = {};
  for (uint64_t& hash : hashes) {
    Field field({.capacity = 200000, .seed = 5});
    Scene scene = sceneWithView(0.0);
    scene.weather = GetParam().weather();
    scene.weather.ground_height_m = 0.0;
    for (; scene.index < 120; ++scene.index) {
      place(scene, 15.0, 0.0);
      field.tick(scene.tick());
    }
    hash = field.hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

// Each particle as wide as it is drawn, flutter, bounce and long exposures and all, against every box.
TEST_P(KindOf, isNeverDrawnInsideAVolumeInStormAndBraking) {
  const std::vector<std::pair<dvec3, dvec3>> boxes = {
      {{-2, -0.8, 0.2}, {2, 0.8, 1.9}}, {{10, -6, -1}, {25, 6, 5}}, {{32, -1, 4}, {40, 9, 4.5}}};
  Field field({.capacity = 200000, .seed = 6});
  for (uint32_t i = 0; i < boxes.size(); ++i)
    ASSERT_EQ(setBox(field, i + 1, boxes[i].first, boxes[i].second, i == 0 ? 7 : 0), "");
  Scene scene = sceneWithView(0.0);
  scene.weather = GetParam().weather();
  scene.weather.wind_mps = {3, -12, 0};
  scene.weather.ground_height_m = 0.0;
  scene.vehicles.emplace_back().id = 7;
  scene.views[0].exposure_s = 0.08;
  std::vector<Streak> streaks;
  double x = -20.0, speed = 20.0;
  uint64_t looked_at = 0, bounced = 0;
  for (; scene.index < 480; ++scene.index) {
    if (x > 0.0) speed = std::max(0.0, speed - 9.81 * kTickSeconds);
    x += speed * kTickSeconds;
    scene.vehicles[0].pose.position_m = {x, 0, 0};
    scene.vehicles[0].pose.velocity_mps = {speed, 0, 0};
    scene.views[0].eye_velocity_mps = {speed, 0, 0};
    look(scene.views[0], {x, 0, 1.5}, 0.3 * std::sin(0.02 * static_cast<double>(scene.index)));
    field.tick(scene.tick());
    if (scene.index % 4 != 0) continue;
    field.streaks(scene.views[0], tickTimeNs(scene.index) + 3'000'000, streaks);
    const dvec3 car(x + 0.003 * speed, 0, 0);
    for (const Streak& s : streaks) {
      ++looked_at;
      bounced += s.kind == kBouncedClass ? 1u : 0u;
      const double more_m =
          0.5 * s.diameter_m - 3e-4;  // floats 20 m off, ends told to 8 us, 1 cm of prediction shared
      for (size_t i = 0; i < boxes.size(); ++i) {
        for (int k = 0; k <= 8; ++k) {
          const dvec3 p = s.from_m + (s.to_m - s.from_m) * (k / 8.0) - (i == 0 ? car : dvec3(0.0));
          ASSERT_FALSE(glm::all(glm::greaterThan(p, boxes[i].first - more_m)) &&
                       glm::all(glm::lessThan(p, boxes[i].second + more_m)))
              << "tick " << scene.index << " box " << i << " class " << s.kind;
        }
      }
    }
  }
  EXPECT_GT(looked_at, 20000u);
  EXPECT_TRUE(GetParam().hail_mm_h == 0.0 || bounced > 500u) << bounced;
}
INSTANTIATE_TEST_SUITE_P(Kinds, KindOf, ::testing::ValuesIn(kKinds),
                         [](const auto& given) { return given.param.name; });

// A flake swings about its way, no further than its law says, and smoothly.
TEST(Snow, swingsAboutAStraightWay) {
  Field field({.capacity = 100000, .seed = 2});
  Scene scene = sceneWithView(0.0);
  scene.weather.snow_mm_h = 1.0;
  scene.weather.temperature_c = -5.0;
  scene.views[0].exposure_s = 1e-4;
  field.tick(scene.tick());
  Upload upload;
  field.publishAll(upload);
  std::map<uint32_t, dvec3> straight;
  std::vector<Streak> streaks, later;
  field.streaks(scene.views[0], tickTimeNs(scene.index), streaks);
  for (size_t i = 0; i < upload.slots.size(); ++i)
    straight[upload.slots[i]] = liveDropOf(upload.records[i], upload.picture).place_m;
  double furthest = 0.0;
  for (const Streak& s : streaks) {
    const dvec3 off = s.drop_m - straight.at(s.slot);
    EXPECT_NEAR(glm::length(off), 1.5 * s.diameter_m, 2e-4 + 0.01 * s.diameter_m);
    EXPECT_NEAR(off.z, 0.0, 1e-3);
    furthest = std::max(furthest, glm::length(off));
  }
  EXPECT_GT(furthest, 0.01);
  field.streaks(scene.views[0], tickTimeNs(scene.index) + 1'000'000, later);
  std::map<uint32_t, dvec3> then;
  for (const Streak& s : later) then[s.slot] = s.drop_m;
  for (const Streak& s : streaks) {
    // 1 ms at less than 4 m/s.
    EXPECT_TRUE(!then.contains(s.slot) || glm::distance(then[s.slot], s.drop_m) < 4e-3);
  }
}

TEST(Precipitation, classesOfNothingHaveNoCells) {
  Field rain({.capacity = 100000, .seed = 2});
  Scene scene = sceneWithView(10.0);
  for (; scene.index < 60; ++scene.index) rain.tick(scene.tick());
  const auto of = rain.stats().live_of;
  EXPECT_GT(of[0], 0u);
  EXPECT_EQ(of[1] + of[2] + of[3] + of[4], 0u);
  Field dry({.capacity = 100000, .seed = 2});
  Scene nothing = sceneWithView(0.0);
  for (; nothing.index < 60; ++nothing.index) dry.tick(nothing.tick());
  EXPECT_EQ(dry.stats().live, 0u);
}

TEST(Precipitation, turnsFromRainToSnowAndBackLeavingNothing) {
  Field field({.capacity = 200000, .seed = 2});
  Scene scene = sceneWithView(5.0);
  for (; scene.index < 120; ++scene.index) field.tick(scene.tick());
  scene.weather.rain_mm_h = 0.0;
  scene.weather.snow_mm_h = 1.0;
  scene.weather.temperature_c = -5.0;
  for (; scene.index < 360; ++scene.index) field.tick(scene.tick());
  const auto few_flakes = field.stats().live_of[1];
  for (; scene.index < 2400; ++scene.index) field.tick(scene.tick());
  EXPECT_EQ(field.stats().live_of[0], 0u);
  EXPECT_GT(field.stats().live_of[1], 1000u);
  EXPECT_LT(few_flakes, field.stats().live_of[1] / 2);  // it came from above
  scene.weather.snow_mm_h = 0.0;
  for (; scene.index < 8000; ++scene.index) field.tick(scene.tick());
  EXPECT_EQ(field.stats().live, 0u);
}

}  // namespace
}  // namespace rg::rain::test
