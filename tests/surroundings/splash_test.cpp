// Splashes as a process in place and time: how many, of what sizes, where not, and the same whoever looks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include "rain/size_law.h"
#include "scene.h"

namespace rg::surroundings::test {
namespace {

constexpr int64_t kEpoch_ns = 62'500'000;

// Counted over cells and epochs that do not overlap; to four standard deviations of Poisson's law.
TEST(Splashes, areAsManyAndAsLargeAsTheLawsDropsOver1mm) {
  for (const double rate_mm_h : {1.0, 10.0, 50.0, 300.0}) {
    const rain::SizeLaw law = rain::SizeLaw::of(rate_mm_h);
    Scene scene = sceneOnGround(rate_mm_h);
    look(scene.views[0], {0, 0, 30.0}, 0.0, -1.5);
    const SplashPicture picture = pictureOf(scene);
    struct Sort {
      double number = 0.0, diameters_mm = 0.0, area_m2 = 0.0;
    };
    std::array<Sort, shared::kSplashSorts> sorts;
    SplashSetup setup;
    constexpr int kPictures = 16;  // each tells of all that began within so short before it:
    const double told_s = 0.04;
    EXPECT_LE(told_s, static_cast<double>(shared::splashLife_s(1e-3f)));
    double kept = 0.0;
    std::set<std::tuple<uint32_t, uint32_t, uint32_t>> cells;
    for (int k = 0; k < kPictures; ++k) {
      ASSERT_TRUE(setUpSplashes(picture, scene.views[0], k * kEpoch_ns, {.reach_m = 6.0}, setup));
      kept += setup.kept;
      each(setup, [&](const shared::SplashJob& job, uint32_t, const shared::Splash& s) {
        const auto age_s = static_cast<double>(s.age_s);
        if (age_s < 0.0 || age_s >= told_s) return;
        Sort& sort = sorts[job.level >> 3u & 3u];
        ++sort.number;
        sort.diameters_mm += 1e3 * static_cast<double>(s.diameter_m);
        if (!cells.insert({job.level, job.x, job.y}).second) return;
        const glm::vec2 ranks = shared::splashRanks(job.level & 3u);
        sort.area_m2 += static_cast<double>(job.corner.w * job.corner.w * (ranks.y - ranks.x));
      });
    }
    double told_mm = 0.0, told = 0.0, mean_mm = 0.0;
    for (uint32_t i = 0; i < shared::kSplashSorts; ++i) {
      const glm::vec2 share = shared::splashSort(i);
      const double expected =
          sorts[i].area_m2 * law.flux(1.0, 6.0) * static_cast<double>(share.y - share.x) * kept * told_s;
      EXPECT_NEAR(sorts[i].number, expected, 4.0 * std::sqrt(expected)) << rate_mm_h << " sort " << i;
      told += sorts[i].number / sorts[i].area_m2;
      told_mm += sorts[i].diameters_mm / sorts[i].area_m2;
    }
    for (double d = 1.0; d < 6.0; d += 0.01) mean_mm += (d + 0.005) * law.flux(d, d + 0.01);
    mean_mm /= law.flux(1.0, 6.0);
    // Sizes lie 0.8 mm about their mean at most; their distribution is told in 32 steps.
    double number = 1e30;
    for (const Sort& sort : sorts) number = std::min(number, sort.number);
    EXPECT_NEAR(told_mm / told, mean_mm, 4.0 * 0.8 / std::sqrt(number) + 0.01) << rate_mm_h;
  }
}

// In a storm there are more than are looked at: all are thinned alike and each counts for the rest, so that
// the weather is the same; a view nearly all about has no more than are meant to be.
TEST(Splashes, areThinnedAlikeWhereTheyFindNoRoom) {
  Scene scene = sceneOnGround(300.0, {0, 0, 3.0});
  look(scene.views[0], {0, 0, 3.0}, 0.0, -1.5);
  scene.views[0].clipFromEye = glm::perspective(2.8, 1.0, kNear_m, kFar_m);
  const SplashPicture picture = pictureOf(scene);
  SplashSetup all, setup;
  SplashPicture drizzle = picture;
  drizzle.flux_per_m2s *= 0.125;
  ASSERT_TRUE(setUpSplashes(drizzle, scene.views[0], 0, {.reach_m = 40.0}, all));
  ASSERT_EQ(all.kept, 1.0);
  ASSERT_TRUE(setUpSplashes(picture, scene.views[0], 0, {.reach_m = 40.0}, setup));
  EXPECT_LT(setup.kept, 1.0);
  EXPECT_LE(setup.count, kMostSplashes);
  EXPECT_EQ(setup.rain.reach.y, static_cast<float>(1.0 / setup.kept));
  const double expected = all.count * 8.0 * setup.kept;
  EXPECT_NEAR(setup.count, expected, 8.0 * 4.0 * std::sqrt(expected));
}

// Whatever a view sees of them; and as the rain grows there is no step, and never fewer are left.
TEST(Splashes, areThinnedByTheRainAlone) {
  SplashSetup wide, narrow;
  double before = 0.0, before_mm_h = 0.0;
  bool is_thinned = false;
  for (double rate_mm_h = 50.0; rate_mm_h < 300.0; rate_mm_h *= 1.02) {
    Scene scene = sceneOnGround(rate_mm_h);
    const SplashPicture picture = pictureOf(scene);
    ASSERT_TRUE(setUpSplashes(picture, scene.views[0], 0, {}, wide));
    look(scene.views[0], {5.0, 2.0, 3.0}, 2.0, -0.5);
    scene.views[0].clipFromEye = glm::perspective(0.1, 1.0, kNear_m, kFar_m);
    ASSERT_TRUE(setUpSplashes(picture, scene.views[0], 777, {}, narrow));
    EXPECT_EQ(wide.kept, narrow.kept);
    const double left = wide.kept * picture.flux_per_m2s;
    if (before > 0.0) {
      // Larger drops' splashes last longer and show farther off: room for fewer, by less than the rate grows.
      EXPECT_GT(left, before / (rate_mm_h / before_mm_h));
      EXPECT_LT(left, before * (rate_mm_h / before_mm_h));
    }
    is_thinned |= wide.kept < 1.0;
    before = left;
    before_mm_h = rate_mm_h;
  }
  EXPECT_TRUE(is_thinned);
}

// Two pictures of the same moments know the same splashes, a step older, whatever lies between; and another
// view knows those that it sees too.
TEST(Splashes, areThoseOfTheirPlaceAndTime) {
  using Name = std::tuple<uint32_t, uint32_t, uint32_t, uint32_t, uint32_t>;
  const auto alive = [](const Scene& scene, int64_t time_ns) {
    std::map<Name, std::pair<dvec3, shared::Splash>> all;
    SplashSetup setup;
    setUpSplashes(pictureOf(scene), scene.views[0], time_ns, {}, setup);
    const dvec3 eye = rain::coneOf(scene.views[0]).eye_m;
    each(setup, [&](const shared::SplashJob& job, uint32_t i, const shared::Splash& s) {
      if (shared::splashIsAlive(s))
        all[{job.level, job.x, job.y, job.epoch, i}] = {eye + dvec3(s.place_m), s};
    });
    return all;
  };
  Scene scene = sceneOnGround(20.0);
  const int64_t time_ns = 7'123'456'789;
  const auto first = alive(scene, time_ns);
  EXPECT_GT(first.size(), 1000u);
  for (const int64_t step_ns : {4'000'000, 33'000'000}) {
    const double step_s = static_cast<double>(step_ns) * 1e-9;
    const auto later = alive(scene, time_ns + step_ns);
    for (const auto& [name, before] : first) {
      const auto found = later.find(name);
      if (found == later.end()) {
        EXPECT_GE(static_cast<double>(before.second.age_s) + step_s,
                  static_cast<double>(before.second.life_s) - 1e-6);
        continue;
      }
      EXPECT_LT(glm::distance(found->second.first, before.first), 1e-5);
      EXPECT_NEAR(static_cast<double>(found->second.second.age_s - before.second.age_s), step_s, 1e-6);
    }
  }
  Scene other = sceneOnGround(20.0, {3.0, 1.0, 2.0});
  look(other.views[0], {3.0, 1.0, 2.0}, 0.3);
  size_t common = 0;
  for (const auto& [name, there] : alive(other, time_ns)) {
    const auto found = first.find(name);
    if (found == first.end()) continue;
    ++common;
    EXPECT_LT(glm::distance(found->second.first, there.first), 1e-5);
  }
  EXPECT_GT(common, first.size() / 4);
}

// As rain gets heavier more join those that are there, and none moves elsewhere or is of another age; so too
// where they begin to be thinned, and where they are.
TEST(Splashes, stayWhereTheyAreWhenTheRateChanges) {
  const auto born = [](double rate_mm_h) {
    const Scene scene = sceneOnGround(rate_mm_h);
    std::set<std::tuple<float, float, float>> all;
    SplashSetup setup;
    setUpSplashes(pictureOf(scene), scene.views[0], 500'000'000, {}, setup);
    each(setup, [&](const shared::SplashJob&, uint32_t, const shared::Splash& s) {
      all.insert({s.place_m.x, s.place_m.y, s.age_s});
    });
    return all;
  };
  for (const double rate_mm_h : {20.0, 120.0, 200.0}) {
    const auto before = born(rate_mm_h), after = born(1.05 * rate_mm_h);
    size_t stay = 0;
    for (const auto& splash : before) stay += after.contains(splash) ? size_t{1} : size_t{0};
    // But for the few that larger ones, which last longer and show farther off, take the room of.
    EXPECT_GT(stay, before.size() * 97 / 100) << rate_mm_h;
    EXPECT_GE(after.size(), before.size() * 97 / 100) << rate_mm_h;
  }
}

// The host's world is moved under it: the same splashes at the places that are the same.
TEST(Splashes, stayWhereTheyAreWhenTheOriginMoves) {
  const dvec3 shift_m(1234.5, -777.25, 3.0);
  Scene scene = sceneOnGround(20.0), moved = scene;
  look(moved.views[0], dvec3(0, 0, 1.5) - shift_m, 0.0);
  moved.weather.ground_height_m = -shift_m.z;
  Splashes splashes;
  splashes.tick(scene.tick(), rain::WindProfile{});
  SplashSetup before, after;
  ASSERT_TRUE(setUpSplashes(splashes.picture(), scene.views[0], 0, {}, before));
  splashes.rebase(shift_m);
  splashes.tick(moved.tick(), rain::WindProfile{});
  ASSERT_TRUE(setUpSplashes(splashes.picture(), moved.views[0], 0, {}, after));
  ASSERT_EQ(before.count, after.count);
  for (size_t i = 0; i < before.jobs.size(); ++i)
    ASSERT_LT(glm::distance(before.jobs[i].corner, after.jobs[i].corner), 1e-4f);
}

// Fewer are drawn far off, of small ones fewer still, and each for more: at every distance all of a size
// together count as often as there are.
TEST(Splashes, countAsOftenAsThereAreAtAllDistances) {
  for (const float distance_m : {0.5f, 3.0f, 4.2f, 5.0f, 9.0f, 20.0f, 40.0f}) {
    for (const float diameter_m : {0.001f, 0.0015f, 0.002f, 0.004f}) {
      constexpr int kRanks = 100'000;
      double sum = 0.0;
      for (int i = 0; i < kRanks; ++i) {
        const float rank = (static_cast<float>(i) + 0.5f) / kRanks;
        const float times = shared::splashTimes(rank, distance_m, diameter_m);
        sum += static_cast<double>(times);
        // No level's job is left out before its last rank is.
        for (uint32_t level = 0; level < shared::kSplashLevels; ++level) {
          const glm::vec2 ranks = shared::splashRanks(level);
          if (rank > ranks.x && rank < ranks.y && distance_m > shared::splashReach_m(level, diameter_m)) {
            EXPECT_EQ(times, 0.0f);
          }
        }
      }
      EXPECT_NEAR(sum / kRanks, 1.0, 5e-3) << distance_m << " m, " << diameter_m;
    }
  }
}

// Of any size and age and at any place on the grid of pixels, seen from any elevation.
TEST(Splashes, coverAsMuchAtEverySize) {
  for (const float px_per_m : {20.0f, 200.0f, 800.0f, 2500.0f}) {
    for (const float sine : {0.0f, 0.1f, 0.7f, 1.0f}) {
      for (const float age_s : {0.005f, 0.015f, 0.04f}) {
        const shared::SplashShape shape = shared::splashShape(0.002f, age_s);
        const shared::SplashDrawn drawn = shared::splashDrawn(shape, px_per_m, sine, 2.0f);
        for (const glm::vec2 offset : {glm::vec2(0.0f), glm::vec2(0.31f, 0.77f), glm::vec2(0.5f, 0.12f)}) {
          double sum = 0.0;
          for (int y = -26; y < 40; ++y) {
            for (int x = -26; x <= 26; ++x)
              sum += static_cast<double>(shared::splashCover(glm::vec2(x, y) + offset, 0.5f, drawn));
          }
          // But for how pixels sample where the disk's far and near sides are.
          const auto expected = static_cast<double>(shared::splashCoverSum(drawn));
          EXPECT_NEAR(sum, expected, 0.03 * expected) << px_per_m << " px/m, sine " << sine << ", " << age_s;
        }
      }
    }
  }
}

// What a splash of 2 mm covers of a picture's pixels, its foot in the middle.
struct Covered {
  static constexpr int kHalf = 40;
  std::vector<std::vector<float>> rows;
  explicit Covered(const shared::SplashDrawn& drawn) {
    for (int y = -kHalf; y <= kHalf; ++y) {
      std::vector<float>& row = rows.emplace_back();
      for (int x = -kHalf; x <= kHalf; ++x) row.push_back(shared::splashCover(glm::vec2(x, y), 0.5f, drawn));
    }
  }
  float most() const {
    float most = 0.0f;
    for (const auto& row : rows) most = std::max(most, std::ranges::max(row));
    return most;
  }
};

// No letters: a puff that is densest in its middle and ends softly, wider than tall.
TEST(Splashes, arePuffsThatThinOutTowardsTheirRim) {
  for (const float age_s : {0.02f, 0.03f, 0.045f}) {
    shared::SplashShape shape = shared::splashShape(0.002f, age_s);
    shape.wall = 0.0f;  // the crown is a ring
    const shared::SplashDrawn drawn = shared::splashDrawn(shape, 2500.0f, 0.2f, 3.0f);
    EXPECT_GT(2.0f * drawn.radius, drawn.high - drawn.low) << age_s;
    const Covered covered(drawn);
    for (const auto& row : covered.rows) {
      EXPECT_TRUE(std::is_sorted(row.begin(), row.begin() + Covered::kHalf + 1)) << age_s;
      EXPECT_TRUE(std::is_sorted(row.rbegin(), row.rbegin() + Covered::kHalf + 1)) << age_s;
      for (size_t x = 1; x < row.size(); ++x)
        EXPECT_LT(std::abs(row[x] - row[x - 1]), 0.2f * covered.most()) << age_s;
    }
  }
}

// As many as one stands for, they are translucent.
TEST(Splashes, hideAPartOfWhatIsBehindThem) {
  for (const float px_per_m : {100.0f, 600.0f, 2500.0f}) {
    for (const float times : {3.0f, 12.0f}) {
      const Covered covered(shared::splashDrawn(shared::splashShape(0.003f, 0.03f), px_per_m, 0.2f, times));
      EXPECT_LT(covered.most(), 0.8f) << px_per_m << " px/m, " << times << " times";
    }
  }
}

// Specks add and take nothing.
TEST(Splashes, areAsBrightWithTheirSpecks) {
  const shared::SplashDrawn drawn =
      shared::splashDrawn(shared::splashShape(0.003f, 0.03f), 2500.0f, 0.2f, 3.0f);
  double sum = 0.0, least = 1.0;
  constexpr int kSeeds = 100, kHalf = 10;
  for (int seed = 0; seed < kSeeds; ++seed) {
    for (int y = -kHalf; y < kHalf; ++y) {
      for (int x = -kHalf; x < kHalf; ++x) {
        const auto speck =
            static_cast<double>(shared::splashSpeck(glm::vec2(x, y) + 0.5f, drawn, static_cast<float>(seed)));
        sum += speck;
        least = std::min(least, speck);
      }
    }
  }
  EXPECT_NEAR(sum / (4.0 * kHalf * kHalf * kSeeds), 1.0, 0.01);  // 40 000 of a spread of 0.7
  EXPECT_LT(least, 0.5);
}

// Where points may not be as large as they are.
TEST(Splashes, coverAsMuchWhereTheyAreShrunk) {
  const shared::SplashDrawn drawn =
      shared::splashDrawn(shared::splashShape(0.003f, 0.012f), 2000.0f, 0.4f, 1.0f);
  const float all = shared::splashCoverSum(drawn);
  EXPECT_NEAR(shared::splashCoverSum(shared::splashScaled(drawn, 0.4f)), all, 1e-5f * all);
}

// What they cover in nature is what their wall and droplets do, whatever they are drawn like.
TEST(Splashes, areDrawnAsTheyAre) {
  const shared::SplashShape shape = shared::splashShape(0.003f, 0.012f);
  const shared::SplashDrawn drawn = shared::splashDrawn(shape, 1000.0f, 0.6f, 1.0f);
  const double wall_m2 =
      2.0 * 3.14159265 * static_cast<double>(shape.radius_m * shape.wall_m * 0.8f * shape.wall);
  EXPECT_NEAR(static_cast<double>(shared::splashCoverSum(drawn)),
              1e6 * (wall_m2 + static_cast<double>(shape.droplets_m2)), 1e-3);
  // The crown sinks back long before the last droplets are down, and they are when its life ends.
  const float life_s = shared::splashLife_s(0.003f);
  EXPECT_EQ(shared::splashShape(0.003f, 0.5f * life_s).wall_m, 0.0f);
  EXPECT_GT(shared::splashShape(0.003f, 0.5f * life_s).droplets_m2, 0.0f);
  EXPECT_NEAR(shared::splashShape(0.003f, life_s).droplets_m2, 0.0f, 1e-9f);
}

// Among things equally bright they are as bright; seen from the side they gather half their light from the
// sky (0.94 of it through two faces), from above none but what they mirror, and as little where something
// stands behind them that is as dark as the ground.
TEST(Splashes, areAsBrightAsWhatIsAround) {
  const vec3 dark(0.1f), sky(1.0f);
  const auto light = [](const vec3& below, const vec3& above, double towards, double behind) {
    return static_cast<double>(
        shared::splashLight(below, above, static_cast<float>(towards), static_cast<float>(behind)).x);
  };
  EXPECT_NEAR(light(sky, sky, -0.4, 0.3), 1.0, 1e-6);
  EXPECT_NEAR(light(dark, sky, 0.0, 0.0), 0.1 + 0.9 * 0.5, 1e-6);
  EXPECT_NEAR(light(dark, sky, -1.0, 0.0), 0.1 + 0.9 * 0.03, 1e-6);
  EXPECT_NEAR(light(dark, sky, -0.5, 0.866), 0.1 + 0.9 * 0.03, 1e-3);  // 30 degrees and 60 are 90
  EXPECT_LT(light(dark, sky, -0.5, 0.5), 0.6 * light(dark, sky, -0.5, 0.0));
}

// Against steps of 5 mm up the line, each asked whether it lies in a box: boxes that stand and boxes that
// move, drops that slant. Places nearer than 1 cm of way to a box's face may go either way.
TEST(Splashes, areNoneDownStreamOfAVolume) {
  std::mt19937 random(5);
  const auto draw = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  struct Body {
    dvec3 low, high, velocity;
  };
  int sheltered = 0, open = 0;
  for (int round = 0; round < 8; ++round) {
    std::vector<Body> bodies;
    rain::Field field;
    Scene scene = sceneOnGround(50.0);
    for (uint32_t i = 0; i < 6; ++i) {
      const dvec3 low(draw(-3, 12), draw(-7, 5), draw(-0.5, 3)),
          high = low + dvec3(draw(0.5, 6), draw(0.5, 6), draw(0.3, 4));
      const dvec3 velocity = i < 3 ? dvec3(0.0) : dvec3(draw(-20, 20), draw(-20, 20), 0);
      bodies.push_back({low, high, velocity});
      if (i >= 3) {
        VehicleState vehicle;
        vehicle.id = i;
        vehicle.pose.velocity_mps = velocity;
        scene.vehicles.push_back(vehicle);
      }
      ASSERT_EQ(setBox(field, i + 1, low, high, i < 3 ? 0 : i), "");
    }
    scene.weather.wind_mps = {draw(-12, 12), draw(-12, 12), 0.0};
    const SplashPicture picture = pictureOf(scene, field);
    ASSERT_EQ(picture.volumes.size(), bodies.size());
    SplashSetup setup;
    ASSERT_TRUE(setUpSplashes(picture, scene.views[0], picture.time_ns, {}, setup));
    const dvec3 eye = rain::coneOf(scene.views[0]).eye_m;
    int tried = 0;
    each(setup, [&](const shared::SplashJob&, uint32_t i, const shared::Splash& s) {
      if (i % 16 != 0 || !shared::splashIsAlive(s) || ++tried > 40) return;
      const dvec3 place = eye + dvec3(s.place_m), fall(s.velocity_mps);
      constexpr double kStep_m = 0.005, kEither_m = 0.01;
      bool is_in = false, is_near = false;
      for (double up_m = 0.0; up_m < 12.0; up_m += kStep_m) {
        const double before_s = up_m / -fall.z;
        const dvec3 drop = place - fall * before_s;
        for (const Body& body : bodies) {
          const dvec3 in_body = drop + body.velocity * (static_cast<double>(s.age_s) + before_s);
          const dvec3 out = glm::max(body.low - in_body, in_body - body.high);
          const double outside_m = std::max({out.x, out.y, out.z});
          is_in |= outside_m < 0.0 && up_m > kEither_m;
          is_near |= std::abs(outside_m) < kEither_m;
        }
      }
      const bool told =
          shared::splashIsSheltered(s.place_m, s.velocity_mps, vec3(0.0f), s.age_s, 0.0f, setup.shelter);
      EXPECT_TRUE(is_in == told || is_near) << place.x << " " << place.y;
      ++(told ? sheltered : open);
    });
  }
  EXPECT_GT(sheltered, 50);
  EXPECT_GT(open, 50);
}

TEST(Splashes, areNoneWithoutRainOrWithoutGain) {
  SplashSetup setup;
  const Scene dry = sceneOnGround(0.0), wet = sceneOnGround(10.0);
  EXPECT_FALSE(setUpSplashes(pictureOf(dry), dry.views[0], 0, {}, setup));
  EXPECT_FALSE(setUpSplashes(pictureOf(wet), wet.views[0], 0, {.gain = 0.0}, setup));
  EXPECT_FALSE(setUpSplashes(pictureOf(wet), wet.views[0], 0, {.reach_m = 0.0}, setup));
  EXPECT_TRUE(setUpSplashes(pictureOf(wet), wet.views[0], 0, {}, setup));
  // Too far off for cells, and in a wind that knows no end.
  ViewState far = wet.views[0];
  far.eyeFromWorld[3] = glm::dvec4(1e300, 1e300, 0.0, 1.0);
  EXPECT_FALSE(setUpSplashes(pictureOf(wet), far, INT64_MAX, {}, setup));
  Scene stormy = wet;
  VehicleState rocket;
  rocket.id = stormy.views[0].vehicle = 1;
  rocket.pose.velocity_mps = {1e9, 0.0, 0.0};
  stormy.vehicles.push_back(rocket);
  stormy.weather.wind_mps = {100.0, 100.0, 0.0};
  EXPECT_TRUE(setUpSplashes(pictureOf(stormy), stormy.views[0], 0, {}, setup));
  EXPECT_LT(setup.count, 200000u);
  ViewState none = wet.views[0];
  none.clipFromEye = glm::dmat4(0.0);
  EXPECT_FALSE(setUpSplashes(pictureOf(wet), none, 0, {}, setup));
}

// Air that rises faster than drops fall does not turn lines round: they still come down on what they meet.
TEST(Splashes, comeDownInRisingAir) {
  Scene scene = sceneOnGround(50.0);
  scene.weather.wind_mps = dvec3(10.0, 0.0, 30.0);
  SplashSetup setup;
  ASSERT_TRUE(setUpSplashes(pictureOf(scene), scene.views[0], 1'000'000'000, {}, setup));
  each(setup, [](const shared::SplashJob&, uint32_t, const shared::Splash& s) {
    ASSERT_LE(s.velocity_mps.z, -shared::kSplashLeastFall_mps);
  });
}

}  // namespace
}  // namespace rg::surroundings::test
