// The laws of the rain beyond, and how it moves: without GL.
#include "rain/beyond.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "rain/beyond_pattern.h"
#include "rain/size_law.h"
#include "scene.h"
#include "shared/rain_look.glsl"

namespace rg::rain::test {
namespace {

constexpr double kReach = 1.2 * 1663.0;  // the default settings'

// What particles take of a way of `to_m` from the eye, size by size as streak.vert fades them.
double takenByParticles(double rate_mm_h, double to_m) {
  const SizeLaw law = SizeLaw::of(rate_mm_h);
  double sum = 0.0;
  constexpr int kSizes = 400, kSteps = 400;
  for (int i = 0; i < kSizes; ++i) {
    const double step_mm = (kLargest_mm - kSmallest_mm) / kSizes;
    const double d_mm = kSmallest_mm + (i + 0.5) * step_mm;
    const double cover_per_m = law.numberDensity(d_mm - 0.5 * step_mm, d_mm + 0.5 * step_mm) *
                               glm::pi<double>() / 4.0 * d_mm * d_mm * 1e-6;
    const double reach_m = kReach * d_mm * 1e-3;
    double faded_m = 0.0;
    for (int k = 0; k < kSteps; ++k)
      faded_m += (1.0 - glm::smoothstep(0.6 * reach_m, reach_m, (k + 0.5) * to_m / kSteps)) * to_m / kSteps;
    sum += cover_per_m * faded_m;
  }
  return sum;
}

double opticalDepth(double rate_mm_h, double gain, double to_m) {
  const ParticlesShare particles = particlesShare(rate_mm_h, kReach);
  shared::RainOpen open{};
  shared::rainAddOpen(open, 0.0f, static_cast<float>(to_m), static_cast<float>(particles.mean_m));
  const glm::vec4 depths = shared::rainOpticalDepths(
      open, glm::vec4(extinction_per_m(rate_mm_h), gain * particles.at_eye_per_m, particles.mean_m, 1.0));
  return static_cast<double>(depths.x + depths.y + depths.z + depths.w);
}

TEST(RainBeyond, withWhatParticlesTakeHasWebersExtinction) {
  for (const double rate : {0.1, 1.0, 10.0, 100.0, 300.0}) {
    for (const double to_m : {10.0, 30.0, 100.0, 500.0}) {
      const double whole = extinction_per_m(rate) * to_m;
      // The short form of what particles take is off by some per cent of it, where that is a third of all.
      EXPECT_NEAR(opticalDepth(rate, 1.0, to_m) + takenByParticles(rate, to_m), whole, 0.03 * whole)
          << rate << " mm/h to " << to_m << " m";
    }
  }
}

TEST(RainBeyond, movesAsTheDropsThatCoverMost) {
  for (const double rate : {1.0, 25.0, 100.0}) {
    const SizeLaw law = SizeLaw::of(rate);
    double cover = 0.0, moving = 0.0;
    constexpr int kSizes = 2000;
    for (int i = 0; i < kSizes; ++i) {
      const double step_mm = (kLargest_mm - kSmallest_mm) / kSizes, d_mm = kSmallest_mm + (i + 0.5) * step_mm;
      const double here = law.numberDensity(d_mm - 0.5 * step_mm, d_mm + 0.5 * step_mm) * d_mm * d_mm;
      cover += here * glm::pi<double>() / 4.0 * 1e-6;
      moving += here * fallSpeed(d_mm) * glm::pi<double>() / 4.0 * 1e-6;
    }
    EXPECT_NEAR(law.cover_per_m(), cover, 1e-4 * cover);
    EXPECT_NEAR(law.meanSpeedSeen_mps(), moving / cover, 1e-3);
  }
}

TEST(RainBeyond, neverTakesLightBack) {
  for (const double gain : {0.0, 1.0, 2.5, 50.0}) {
    for (double to_m = 0.0; to_m < 30.0; to_m += 0.5) EXPECT_GE(opticalDepth(50.0, gain, to_m), 0.0);
  }
}

TEST(RainBeyond, countsEachMetreOfOpenAirInOneLayer) {
  shared::RainOpen open{};
  shared::rainAddOpen(open, 10.0f, 20.0f, 1.0f);
  shared::rainAddOpen(open, 30.0f, 25.0f, 1.0f);  // overlapped by what came before: nothing
  shared::rainAddOpen(open, 39.0f, 140.0f, 1.0f);
  EXPECT_FLOAT_EQ(open.near_m, 6.0f);
  EXPECT_FLOAT_EQ(open.middle_m, 5.0f);
  EXPECT_FLOAT_EQ(open.far_m, 60.0f);
  EXPECT_FLOAT_EQ(open.haze_m, 40.0f);
}

// ---- motion ----

BeyondPicture tickTo(Scene& scene, Beyond& beyond, int64_t index) {
  for (; scene.index <= index; ++scene.index) beyond.tick(scene.tick(), WindProfile{});
  BeyondPicture picture;
  beyond.describe(kReach, picture);
  return picture;
}

shared::RainBeyond blockOf(const BeyondPicture& picture, const ViewState& view, int64_t time_ns) {
  shared::RainBeyond block;
  EXPECT_TRUE(setUpBeyond(picture, view, time_ns, {}, 1.0, 0.3, 0.9, block));
  return block;
}

// Turns of the pattern between two pictures less than a turn apart, the sense of the fall being positive.
double turned(float from, float to) {
  const double turns = static_cast<double>(from) - static_cast<double>(to);
  return turns - std::floor(turns);
}

TEST(RainBeyond, movesByTimeOfDrawingAsItDoesByTicks) {
  Scene scene = sceneWithView(20.0);
  scene.views[0].eye_velocity_mps = {20, 0, 0};
  Beyond beyond;
  const BeyondPicture early = tickTo(scene, beyond, 100), late = tickTo(scene, beyond, 107);
  const auto drawn = blockOf(early, scene.views[0], tickTimeNs(107)),
             ticked = blockOf(late, scene.views[0], tickTimeNs(107));
  for (glm::length_t layer = 0; layer < 3; ++layer) {
    const double apart = turned(drawn.scroll[layer], ticked.scroll[layer]);
    EXPECT_LT(std::min(apart, 1.0 - apart), 1e-5) << layer;  // as far as floats resolve a turn
  }
}

TEST(RainBeyond, fartherRainMovesSlower) {
  Scene scene = sceneWithView(20.0);
  Beyond beyond;
  const BeyondPicture picture = tickTo(scene, beyond, 10);
  const auto now = blockOf(picture, scene.views[0], tickTimeNs(10)),
             then = blockOf(picture, scene.views[0], tickTimeNs(11));
  double before_rad = 1.0;
  for (glm::length_t layer = 0; layer < 3; ++layer) {
    const double moved_rad = turned(now.scroll[layer], then.scroll[layer]) * 2.0 * glm::pi<double>() /
                             static_cast<double>(now.repeats[layer]) * static_cast<double>(now.repeats.w);
    EXPECT_GT(moved_rad, 0.0);
    EXPECT_LT(moved_rad, 0.6 * before_rad);  // layers are more than 1.6 times as far apart
    before_rad = moved_rad;
  }
}

TEST(RainBeyond, comesFromWhereTheEyeSeesDropsComeFrom) {
  Scene scene = sceneWithView(20.0);
  scene.views[0].eye_velocity_mps = {25, 0, 0};
  Beyond beyond;
  const auto block = blockOf(tickTo(scene, beyond, 1), scene.views[0], tickTimeNs(1));
  const double fall_mps = SizeLaw::of(20.0).meanSpeedSeen_mps();
  const dvec3 expected = glm::normalize(dvec3(25.0, 0.0, fall_mps));
  EXPECT_LT(glm::distance(dvec3(block.axis), expected), 1e-5);
  EXPECT_GT(fall_mps, 4.0);  // between the smallest drops' speed and the largest's
  EXPECT_LT(fall_mps, 9.0);
}

TEST(RainBeyond, mapMovesAllThatIsEquallyFarAlike) {
  // A drop that passes at distance r moves on the map by way / r, wherever it is seen: Mercator's projection.
  for (double angle = 0.2; angle < 2.9; angle += 0.3) {
    const double way = 1e-3;
    const glm::vec3 here(std::cos(angle), std::sin(angle), 0.0),
        there(std::cos(angle) - way, std::sin(angle), 0.0);
    const glm::vec2 moved = shared::rainMap(there) - shared::rainMap(here);
    EXPECT_NEAR(moved.x, 0.0f, 1e-6f);
    EXPECT_NEAR(moved.y, way, 0.02 * way) << angle;  // floats resolve it to a per cent
  }
}

TEST(RainBeyond, hasNothingToDrawWithoutRainShareOrView) {
  Scene scene = sceneWithView(0.0);
  Beyond beyond;
  shared::RainBeyond block;
  EXPECT_FALSE(setUpBeyond(tickTo(scene, beyond, 1), scene.views[0], 0, {}, 1.0, 0.3, 0.9, block));
  scene.weather.rain_mm_h = 20.0;
  const BeyondPicture picture = tickTo(scene, beyond, 3);
  EXPECT_FALSE(setUpBeyond(picture, scene.views[0], 0, {.share = 0.0}, 1.0, 0.3, 0.9, block));
  ViewState flat = scene.views[0];
  flat.clipFromEye = glm::dmat4(std::nan(""));
  EXPECT_FALSE(setUpBeyond(picture, flat, 0, {}, 1.0, 0.3, 0.9, block));
}

// ---- the pattern ----

TEST(RainPattern, ofTheProjectsOwnIsAlwaysTheSameAndUsesItsRange) {
  const RainPattern a = generatePattern(), b = generatePattern();
  EXPECT_EQ(a.rgba, b.rgba);
  EXPECT_GT(a.mean, 0.2);               // enough steps of 1/255 for what is below the mean
  EXPECT_GT(a.greatest / a.mean, 2.0);  // streaks stand out
  EXPECT_LT(a.greatest / a.mean, 3.3);  // and can be drawn in a downpour
}

// How alike the pattern is to itself so many rows farther along the fall: 1 the same, 0 by chance.
double alikeAlong(const RainPattern& pattern, uint32_t rows) {
  double both = 0.0, square = 0.0;
  for (uint32_t y = 0; y < pattern.height_px; ++y) {
    for (uint32_t x = 0; x < pattern.width_px; ++x) {
      const auto rain = [&](uint32_t row) {
        return pattern.rgba[4 * (row % pattern.height_px * pattern.width_px + x) + 3] / 255.0 - pattern.mean;
      };
      both += rain(y) * rain(y + rows);
      square += rain(y) * rain(y);
    }
  }
  return both / square;
}

// A row of a layer's pattern as long as it is where its rain falls: a streak of so many metres passes the eye
// as the pattern does.
double rowLength_m(const RainPattern& pattern, glm::length_t layer) {
  Scene scene = sceneWithView(20.0);
  Beyond beyond;
  const BeyondPicture picture = tickTo(scene, beyond, 10);
  const auto now = blockOf(picture, scene.views[0], tickTimeNs(10)),
             then = blockOf(picture, scene.views[0], tickTimeNs(11));
  const double turns = turned(now.scroll[layer], then.scroll[layer]) * static_cast<double>(now.repeats.w);
  return SizeLaw::of(20.0).meanSpeedSeen_mps() * kTickSeconds / turns / pattern.height_px;
}

TEST(RainPattern, streaksAreAsLongAsDropsFallInAnExposureInEveryLayer) {
  const RainPattern pattern = generatePattern();
  uint32_t half = 0;
  while (alikeAlong(pattern, half) > 0.5) ++half;
  // What is alike by half a streak's length off is 0.4 of one long; 0.11 m in 1/60 s.
  for (glm::length_t layer = 0; layer < 3; ++layer) {
    EXPECT_GT(half * rowLength_m(pattern, layer), 0.4 * 0.11 / 2.0) << layer;
    EXPECT_LT(half * rowLength_m(pattern, layer), 0.4 * 0.11 * 1.5) << layer;
  }
}

// Power of the waves of so many turns across and along in it.
double power(const RainPattern& pattern, double across, double along) {
  std::complex<double> sum = 0.0;
  for (uint32_t y = 0; y < pattern.height_px; ++y) {
    for (uint32_t x = 0; x < pattern.width_px; ++x) {
      const double turns = across * x / pattern.width_px + along * y / pattern.height_px;
      sum += std::polar<double>(pattern.rgba[4 * (y * pattern.width_px + x) + 3],
                                2.0 * glm::pi<double>() * turns);
    }
  }
  return std::norm(sum);
}

// Broad waves of what chance alone has strewn are all of like power, exponentially spread about its mean.
TEST(RainPattern, strewsItsStreaksByChanceWithoutBroaderBands) {
  const RainPattern pattern = generatePattern();
  std::vector<double> powers;
  for (int across = 1; across <= 6; ++across) {
    for (int along = -6; along <= 6; ++along) powers.push_back(power(pattern, across, along));
  }
  double mean_power = 0.0;
  for (const double p : powers) mean_power += p / static_cast<double>(powers.size());
  // Of 78 waves chance has one so strong once in 40 times.
  EXPECT_LT(std::ranges::max(powers), 8.0 * mean_power);
}

TEST(RainPattern, isRefusedWhenOfNoUsableSizeOrWithoutRain) {
  RainPattern out;
  EXPECT_NE(makePattern(7, 64, std::vector<uint8_t>(4 * 7 * 64, 255), out), "");
  EXPECT_NE(makePattern(64, 5000, {}, out), "");
  EXPECT_NE(makePattern(8, 8, std::vector<uint8_t>(4 * 64, 0), out), "");
  EXPECT_TRUE(out.rgba.empty());
  EXPECT_EQ(makePattern(8, 8, std::vector<uint8_t>(4 * 64, 51), out), "");
  EXPECT_DOUBLE_EQ(out.mean, 0.2);
}

// What eight steps make of it, against 20,000 of equal length: lamps to all sides and spots, near the way and
// far from it.
TEST(Beyond, alongAWayDropsShowALampsLightAsTheIntegralSays) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit;
  double sum = 0.0, oracle = 0.0, error = 0.0;
  for (int i = 0; i < 300; ++i) {
    const bool spot = i % 3 == 2;
    shared::RainLamp lamp{};
    const dvec3 place(60.0 * unit(random) - 10.0, 20.0 * unit(random) - 10.0, 6.0 * unit(random) - 2.0);
    const dvec3 aim = glm::normalize(dvec3(0.0, -place.y, -6.0) + dvec3(8.0 * unit(random) - 4.0, 0.0, 0.0));
    lamp.place_inner = glm::vec4(glm::vec3(place), 0.9f);
    lamp.direction_outer = glm::vec4(glm::vec3(aim), spot ? 0.5f : -1.0f);
    const bool middle = unit(random) < 0.5;
    const double from_m = middle ? 16.0 : 0.0, to_m = middle ? 40.0 : 16.0;
    const dvec3 towards = glm::normalize(dvec3(1.0, unit(random) - 0.5, 0.4 * unit(random) - 0.1));
    constexpr int kSteps = 20'000;
    double mean = 0.0;
    for (int k = 0; k < kSteps; ++k) {
      const dvec3 way = (from_m + (to_m - from_m) * (k + 0.5) / kSteps) * towards - place;
      const glm::vec3 unit_way(glm::normalize(way));
      mean += static_cast<double>(shared::rainLampCone(lamp, unit_way) *
                                  shared::rainPhase(-glm::dot(unit_way, glm::vec3(towards)))) /
              (glm::dot(way, way) * kSteps);
    }
    const auto got = static_cast<double>(shared::rainLampAlong(
        lamp, glm::vec3(towards), static_cast<float>(from_m), static_cast<float>(to_m), 0.0f));
    sum += got;
    oracle += mean;
    error += std::abs(got - mean);
  }
  std::printf("in all %.4f of the oracle's, each off by %.4f\n", sum / oracle, error / oracle);
  EXPECT_NEAR(sum / oracle, 1.0, 0.05);
  EXPECT_LT(error / oracle, 0.05);  // four are off by 0.12
}

}  // namespace
}  // namespace rg::rain::test
