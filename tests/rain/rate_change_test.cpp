// Rain sets in and fades: a rate that changes is carried down from the ceiling by the drops themselves, the
// fast ones first, and nothing in the picture jumps.
#include <gtest/gtest.h>

#include <algorithm>

#include "measure.h"

namespace rg::rain::test {
namespace {

constexpr double kCeilingAboveEye_m = 10.0;  // the field's: there a new rate begins
constexpr int kFields = 3, kTicks = 720;
constexpr int64_t kChange = 60;  // the tick of the change

struct RateCourse {
  const char* name;
  double before_mm_h, after_mm_h;
  int ramp_ticks;  // 1: a step
  double speed_mps, pitch_rad;
  double rateAt(int64_t tick) const {
    const double done = std::clamp(static_cast<double>(tick - kChange + 1) / ramp_ticks, 0.0, 1.0);
    return std::lerp(before_mm_h, after_mm_h, done);
  }
};
std::ostream& operator<<(std::ostream& out, const RateCourse& c) { return out << c.name; }

// Bands of height relative to the eye.
constexpr std::array<double, 5> kBands_m{-4.0, -0.5, 0.5, 2.5, 7.5};
constexpr size_t kHeights = kBands_m.size() - 1;
int bandOf(double above_eye_m) {
  const auto above = std::ranges::upper_bound(kBands_m, above_eye_m) - kBands_m.begin();
  return above == 0 || static_cast<size_t>(above) == kBands_m.size() ? -1 : static_cast<int>(above) - 1;
}

// A class is counted as far as its smallest drops are seen.
double reachOf(size_t kind) { return kReachPerDiameter * 1e-3 * speedClasses()[kind].from_mm; }

// Space seen by a class, by band and by how long its drops fall there from the ceiling, in ticks.
class SeenSpace {
 public:
  explicit SeenSpace(const ViewState& view) : m3_(kSpeedClasses * kHeights * kTicks, 0.0) {
    constexpr int kAcross = 32, kDeep = 32;
    const double most_u = 1.0 / view.clipFromEye[0][0], most_v = 1.0 / view.clipFromEye[1][1];
    const glm::dmat3 worldFromEye = glm::transpose(glm::dmat3(view.eyeFromWorld));
    for (int i = 0; i < kAcross * kAcross * kDeep; ++i) {
      const double u = most_u * ((i % kAcross + 0.5) / kAcross * 2.0 - 1.0),
                   v = most_v * ((i / kAcross % kAcross + 0.5) / kAcross * 2.0 - 1.0),
                   deep = std::cbrt((i / (kAcross * kAcross) + 0.5) / kDeep);
      const double patch_sr =
          4.0 * most_u * most_v / (kAcross * kAcross) * std::pow(1.0 + u * u + v * v, -1.5);
      const double up = (worldFromEye * glm::normalize(dvec3(u, v, -1.0))).z;
      for (size_t kind = 0; kind < kSpeedClasses; ++kind)
        add(kind, up * deep * reachOf(kind), patch_sr * std::pow(reachOf(kind), 3) / 3.0 / kDeep);
    }
  }
  double m3(size_t kind, size_t band, size_t ticks) const { return m3_[index(kind, band, ticks)]; }

 private:
  static size_t index(size_t kind, size_t band, size_t ticks) {
    return (kind * kHeights + band) * kTicks + ticks;
  }
  void add(size_t kind, double above_eye_m, double m3) {
    const int band = bandOf(above_eye_m);
    const double fallen_s = (kCeilingAboveEye_m - above_eye_m) / speedClasses()[kind].speed_mps;
    if (band >= 0)
      m3_[index(kind, static_cast<size_t>(band), static_cast<size_t>(fallen_s / kTickSeconds))] += m3;
  }
  std::vector<double> m3_;
};

using Series = std::array<std::array<double, kTicks>, kHeights>;

// What the law says: at each place the density of the rate that was when its drops fell through the ceiling.
Series expectedOf(const RateCourse& course, const SeenSpace& space) {
  Series expected{};
  for (size_t kind = 0; kind < kSpeedClasses; ++kind) {
    const SpeedClass& c = speedClasses()[kind];
    std::array<double, kTicks> density_m3{};
    for (size_t t = 0; t < kTicks; ++t)
      density_m3[t] = SizeLaw::of(course.rateAt(static_cast<int64_t>(t))).numberDensity(c.from_mm, c.to_mm);
    for (size_t band = 0; band < kHeights; ++band) {
      for (size_t fallen = 0; fallen < kTicks; ++fallen) {
        const double m3 = space.m3(kind, band, fallen) * kFields;
        if (m3 == 0.0) continue;
        for (size_t t = 0; t < kTicks; ++t) expected[band][t] += m3 * density_m3[t > fallen ? t - fallen : 0];
      }
    }
  }
  return expected;
}

Series seenIn(const RateCourse& course) {
  Series seen{};
  Upload upload;
  std::vector<LiveDrop> drops;
  for (uint64_t seed = 1; seed <= kFields; ++seed) {
    Field field({.capacity = 100000, .seed = seed});
    Scene scene = sceneWithView(course.before_mm_h);
    for (; scene.index < kTicks; ++scene.index) {
      const double x = course.speed_mps * static_cast<double>(scene.index) * kTickSeconds;
      scene.weather.rain_mm_h = course.rateAt(scene.index);
      scene.views[0].eye_velocity_mps = {course.speed_mps, 0, 0};
      look(scene.views[0], {x, 0, 1.5}, 0.0, course.pitch_rad);
      field.tick(scene.tick());
      liveDrops(field, upload, drops);
      const Cone cone = coneOf(scene.views[0]);
      for (const LiveDrop& d : drops) {
        const int band = bandOf(d.place_m.z - cone.eye_m.z);
        if (band >= 0 && inVolume(cone, d.place_m, reachOf(d.kind)))
          ++seen[static_cast<size_t>(band)][static_cast<size_t>(scene.index)];
      }
    }
  }
  return seen;
}

class RateChange : public ::testing::TestWithParam<RateCourse> {};

// Each band's count is within 5 standard errors of chance (some thousand counts are looked at), and 1 % of
// the fuller sky for the space cut in points and time in ticks. From tick to tick the picture's drops become
// more or fewer by 2 % of the fuller sky at most (the sharpest change, a step, takes a second to pass), and 5
// standard errors of those that come and go.
TEST_P(RateChange, comesDownWithTheDropsAndNeverJumps) {
  const RateCourse course = GetParam();
  ViewState view = viewAt({0, 0, 1.5});
  look(view, {0, 0, 1.5}, 0.0, course.pitch_rad);
  const Series expected = expectedOf(course, SeenSpace(view)), seen = seenIn(course);
  std::array<double, kTicks> all{};
  for (size_t band = 0; band < kHeights; ++band) {
    const double fullest = *std::ranges::max_element(expected[band]);
    for (size_t t = 0; t < kTicks; ++t) {
      all[t] += seen[band][t];
      ASSERT_NEAR(seen[band][t], expected[band][t], 0.01 * fullest + 5.0 * std::sqrt(expected[band][t]) + 5.0)
          << "tick " << t << ", from " << kBands_m[band] << " m above the eye";
    }
  }
  const double fullest = *std::ranges::max_element(all);
  ASSERT_GT(fullest, 5000.0);
  for (size_t t = 1; t < kTicks; ++t)
    ASSERT_LT(std::abs(all[t] - all[t - 1]), 0.02 * fullest + 5.0 * std::sqrt(0.1 * fullest)) << "tick " << t;
}
INSTANTIATE_TEST_SUITE_P(Courses, RateChange,
                         ::testing::Values(RateCourse{"setsInWhileDriving", 0, 50, 1, 100 * kKmh, 0},
                                           RateCourse{"ends", 50, 0, 1, 0, 0},
                                           RateCourse{"grows", 5, 50, 240, 10, 0.2}),
                         [](const auto& given) { return given.param.name; });
INSTANTIATE_TEST_SUITE_P(LongCourses, RateChange,
                         ::testing::Values(RateCourse{"setsIn", 0, 50, 1, 0, 0},
                                           RateCourse{"setsInSeenFromBelow", 0, 50, 1, 0, 0.5},
                                           RateCourse{"eases", 50, 10, 1, 0, 0},
                                           RateCourse{"fades", 50, 0, 240, 10, 0.2}),
                         [](const auto& given) { return given.param.name; });

}  // namespace
}  // namespace rg::rain::test
