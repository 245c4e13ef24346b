// Beads: the small drops of a texel. What numbers and volumes say of them: they run together where they are
// crowded, add up as they join, are left by films that break, and no picolitre of them is lost.
#include "beads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

namespace rg::test {
namespace {

using shared::Beads;

TEST(Beads, packAndUnpack) {
  for (const Beads b :
       {beads(0, 0), beads(1, 1), beads(shared::kMostBeads_pl, shared::kMostBeads), beads(65450, 3)}) {
    const Beads again = shared::beadsOf(shared::packedBeads(b));
    EXPECT_EQ(again.volume_pl, b.volume_pl);
    EXPECT_EQ(again.number, b.number);
  }
}

TEST(Beads, cubeRootIsOne) {
  for (double x = 1e-9; x < 1e6; x *= 1.7)
    EXPECT_NEAR(static_cast<double>(shared::cubeRoot(static_cast<float>(x))) / std::cbrt(x), 1.0, 1e-6);
}

TEST(Beads, quotientsAreIntegers) {
  for (uint32_t i = 0; i < 300'000; ++i) {
    const glm::uvec3 h = shared::pcg3d({i, 3u, 9u});
    const auto b = static_cast<int>(1u + (h.x >> (2u + h.z % 30u)));
    // Just at and just before whole quotients, where floats are most likely to be one off, too.
    const auto whole =
        static_cast<uint32_t>(std::min<uint64_t>(h.y % (1u << 20u), 0xffffffffu / static_cast<uint32_t>(b)));
    const uint32_t even = whole * static_cast<uint32_t>(b);
    for (const uint32_t a : {even, even == 0 ? 0 : even - 1, h.y % std::max(even, 1u)})
      ASSERT_EQ(shared::quotient(a, b), static_cast<int>(a / static_cast<uint32_t>(b))) << a << " / " << b;
    const uint32_t volume_pl = h.y % (1u << 24u), number = 1u + h.x % 64u;
    ASSERT_EQ(shared::quotient(volume_pl, static_cast<int>(number)), static_cast<int>(volume_pl / number))
        << volume_pl << " / " << number;
  }
}

// From n beads of base radius R cover a share s of an area: n pi R^2 = s area, V = n R^3 shape.
TEST(Beads, coveringAnAreaIsGeometry) {
  const float per_pl = uncoated().bead_mm3_per_pl;
  for (const int number : {1, 3, 20, 64}) {
    const Beads b = beads(300'000, number);
    const double radius_m = 1e-3 * static_cast<double>(shared::beadRadius_mm(b, per_pl));
    EXPECT_NEAR(number * std::pow(radius_m, 3.0) * 1e-6 / static_cast<double>(per_pl) / 3e-10, 1.0,
                1e-3);  // whole picolitres each
    const double share = number * kPi * radius_m * radius_m / 9e-6;
    EXPECT_NEAR(
        static_cast<double>(shared::beadsCovering(b.volume_pl, static_cast<float>(share), per_pl, kTexel.z)) /
            number,
        1.0, 1e-3);
  }
}

// Whatever is done to a texel, its water is what it was, and the store keeps its promises.
TEST(Beads, everyStepKeepsTheVolume) {
  shared::FilmStepInfo info = uncoated();
  info.rupture_chance = 0.5f;
  info.evaporation_mps = 1e-7f;
  info.bead_drying_pl_mm = 1e5f;
  int offered = 0, joined = 0, broken = 0, merged = 0;
  for (uint32_t i = 0; i < 100000; ++i) {
    const glm::uvec4 h = shared::pcg4d({i, 1u, 2u, 3u});
    info.step = h.w;
    info.drops_allowed = static_cast<int>(h.w >> 31u);
    const auto upTo = [](uint32_t hash, double most) {
      const double u = static_cast<double>(shared::unitFloat(hash));
      return static_cast<int>(most * u * u * u);
    };
    int film_pl = upTo(h.x, 4e6);
    Beads lying = beads(upTo(h.y, 1e7), 1 + static_cast<int>(h.z % 64));
    if (lying.volume_pl == 0) lying.number = 0;
    const int64_t before = int64_t{film_pl} + lying.volume_pl;
    const shared::FilmTexel dry = shared::dried(film_pl, lying, i, kTexel, info);
    ASSERT_EQ(int64_t{dry.film_pl} + dry.beads.volume_pl + dry.gone_pl, before);
    ASSERT_GE(dry.film_pl, 0);
    ASSERT_EQ(dry.beads.number > 0, dry.beads.volume_pl > 0);
    const shared::FilmTexel t = shared::settled(dry.film_pl, dry.beads, kTexel, info);
    ASSERT_EQ(int64_t{t.film_pl} + t.beads.volume_pl + dry.gone_pl, before);
    ASSERT_GE(t.film_pl, 0);
    ASSERT_EQ(t.beads.number > 0, t.beads.volume_pl > 0);
    ASSERT_LE(t.beads.number, shared::kMostBeads);
    const int given_pl = t.gone_pl > 0 ? shared::offered_pl(t.gone_pl, t.beads) : 0;
    ASSERT_EQ(given_pl > 0, t.gone_pl > 0);
    ASSERT_LE(given_pl, t.gone_pl);
    const shared::FilmTexel left = shared::without(t, given_pl);
    ASSERT_EQ(int64_t{left.film_pl} + left.beads.volume_pl,
              int64_t{t.film_pl} + t.beads.volume_pl - given_pl);
    ASSERT_EQ(left.beads.number > 0, left.beads.volume_pl > 0);
    const int taken = shared::shareOf(t.beads.volume_pl, static_cast<int>(h.x % 65537));
    const Beads rest = shared::withoutPart(t.beads, taken);
    ASSERT_EQ(rest.volume_pl, t.beads.volume_pl - taken);
    ASSERT_EQ(rest.number > 0, rest.volume_pl > 0);
    ASSERT_LE(rest.number, t.beads.number);
    offered += t.gone_pl > 0 ? 1 : 0;
    joined += t.film_pl > film_pl ? 1 : 0;
    broken += dry.film_pl == 0 && film_pl > 1000 && dry.beads.number > 0 ? 1 : 0;
    merged += t.beads.number > 0 && t.beads.number < dry.beads.number ? 1 : 0;
    int more_pl = film_pl;
    const Beads both = shared::joinedBy(t.beads, 9'000'000, 3, more_pl);
    ASSERT_EQ(int64_t{both.volume_pl} + more_pl, int64_t{t.beads.volume_pl} + 9'000'000 + film_pl);
    ASSERT_LE(both.volume_pl, shared::kMostBeads_pl);
  }
  for (const int times : {offered, joined, broken, merged}) EXPECT_GT(times, 100);
}

// After a step they cover no more than they can without touching, or are one that is offered to the drops.
TEST(Beads, crowdedOnesRunTogether) {
  const shared::FilmStepInfo info = uncoated();
  for (int volume_pl = 1000; volume_pl < 1'500'000; volume_pl += volume_pl / 3) {
    const shared::FilmTexel t = shared::settled(0, beads(volume_pl, 64), kTexel, info);
    const double radius_m = std::cbrt(t.beads.volume_pl * 1e-9 * static_cast<double>(info.bead_mm3_per_pl) /
                                      std::max(t.beads.number, 1));
    const double share = t.beads.number * kPi * radius_m * radius_m / 9e-6;
    if (t.gone_pl == 0)
      EXPECT_LE(share, static_cast<double>(shared::kCrowded) * 1.001) << volume_pl;
    else
      EXPECT_EQ(shared::offered_pl(t.gone_pl, t.beads), volume_pl);
    // One more would not have room.
    if (t.beads.number > 1 && t.beads.number < 64) {
      EXPECT_GT(share * std::cbrt(static_cast<double>(t.beads.number + 1) / t.beads.number),
                static_cast<double>(shared::kCrowded));
    }
  }
}

// In the mean over volumes that hardly differ, whose chance it is to be rounded up.
double meanJoined(Beads a, int volume_pl, int number) {
  constexpr int kVolumes = 500;
  double sum = 0.0;
  for (int k = 0; k < kVolumes; ++k) {
    int film_pl = 0;
    sum += shared::joinedBy(beads(std::max(a.volume_pl - k, 0), a.number), volume_pl, number, film_pl).number;
  }
  return sum / kVolumes;
}

// The water of a few large beads stays in large ones when it meets much mist, and of like ones there are as
// many as of both.
TEST(Beads, aLargeOneIsNotSharedOutAmongMist) {
  constexpr double kTolerance = 0.2;  // chance: 0.03 of each standard deviation; and volumes differ by 1 %
  const auto joined = [](Beads a, int volume_pl, int number) { return meanJoined(a, volume_pl, number); };
  for (const int n : {1, 2, 5, 30}) {
    for (const int m : {1, 7, 20})
      EXPECT_NEAR(joined(beads(40'000 * n, n), 40'000 * m, m), n + m, kTolerance);
  }
  EXPECT_EQ(joined(beads(0, 0), 300, 5), 5);
  EXPECT_EQ(joined(beads(1000, 60), 1000, 60), shared::kMostBeads);
  EXPECT_NEAR(joined(beads(65'000, 1), 200'000, 1), 1.59, kTolerance);
  EXPECT_NEAR(joined(beads(65'000, 1), 5'000, 1), 1.15, 0.05);
  for (const int large_pl : {50'000, 200'000, 5'000'000}) {
    const double p = large_pl / (large_pl + 100'000.0), law = 1.0 / (p * p + (1.0 - p) * (1.0 - p) / 50.0);
    EXPECT_NEAR(joined(beads(100'000, 50), large_pl, 1), law, kTolerance) << large_pl;
  }
}

// 1 / N is the sum of the squares of all beads' shares, however they come.
TEST(Beads, smallOnesThatComeOneByOneAddUp) {
  struct Case {
    int large_pl, others, other_pl;
  };
  for (const Case c : {Case{400'000, 20, 80'000}, Case{100'000, 30, 80'000}, Case{1'000'000, 50, 200'000},
                       Case{65'000, 40, 400}}) {
    constexpr uint32_t kTimes = 2000;
    double mean = 0.0, law = 0.0;
    for (uint32_t i = 0; i < kTimes; ++i) {
      Beads lying = beads(c.large_pl, 1);
      double squares = std::pow(c.large_pl, 2.0);
      for (int k = 0; k < c.others; ++k) {
        const double share =
            0.75 +
            0.5 * static_cast<double>(shared::unitFloat(shared::pcg(i * 64u + static_cast<uint32_t>(k))));
        const int volume_pl = static_cast<int>(c.other_pl * share);
        int film_pl = 0;
        lying = shared::joinedBy(lying, volume_pl, 1, film_pl);
        squares += std::pow(volume_pl, 2.0);
      }
      mean += static_cast<double>(lying.number) / kTimes;
      law += std::pow(lying.volume_pl, 2.0) / squares / kTimes;
    }
    std::printf("%d + %d of %d: %.2f, law %.2f\n", c.large_pl, c.others, c.other_pl, mean, law);
    // Whole numbers scatter, and as the law is hollow in them their mean stays behind, by up to a tenth.
    EXPECT_GT(mean / law, 0.88);
    EXPECT_LT(mean / law, 1.03);
  }
}

// A film's ridges, each a segment of a circle that meets the glass at the contact angle, pinch off every four
// widths.
TEST(Beads, aBrokenFilmLeavesWhatItsRidgesPinchOff) {
  const double contact_rad = glass::meanAngle(glass::surfaceOf(glass::Glass::uncoated));
  const auto segment_m2 = [&](double width_m) {
    const double radius_m = 0.5 * width_m / std::sin(contact_rad);
    double sum = 0.0;
    for (int k = 0; k < 200; ++k) {
      const double x = ((k + 0.5) / 200.0 - 0.5) * width_m;
      sum += (std::sqrt(radius_m * radius_m - x * x) - radius_m * std::cos(contact_rad)) * width_m / 200.0;
    }
    return sum;
  };
  constexpr int kPlaces = 4000;
  for (const double film_m : {1e-6, 4e-6, 12e-6}) {
    double law = 0.0, mean = 0.0;
    for (int k = 0; k < kPlaces; ++k) {
      const double u = (k + 0.5) / kPlaces;
      const double holes_m = static_cast<double>(shared::kHoles_m) * (0.5 + 1.5 * u * u);
      const double width_m = std::sqrt(0.5 * film_m * holes_m / segment_m2(1.0));
      law += std::clamp(2.0 / holes_m * 9e-6 / (4.0 * width_m), 1.0, 64.0) / kPlaces;
      mean += static_cast<double>(shared::beadsOfBrokenFilm(
                  static_cast<float>(film_m), static_cast<uint32_t>(k), kTexel.z, uncoated().bead_by_ridge)) /
              kPlaces;
    }
    std::printf("%g um: %g beads, law %g\n", 1e6 * film_m, mean, law);
    EXPECT_NEAR(mean / law, 1.0, 0.05);  // chance in places, and one at least
  }
}

// settled() compares with as many of the largest as a texel may have.
TEST(Beads, theLargestOfAllOfATexelFitAnInt) {
  for (double advancing_deg = 0.5; advancing_deg <= 175.5; advancing_deg += 0.5) {
    for (const double receding : {0.001, 0.5, 0.98, 1.0}) {
      glass::Surface surface = glass::surfaceOf(glass::Glass::uncoated);
      surface.advancing_rad = rad(advancing_deg);
      surface.receding_rad = receding * surface.advancing_rad;
      shared::FilmStepInfo info{};
      glass::setBeadShape(info, surface);
      ASSERT_GT(info.most_bead_pl, shared::kLeastBead_pl) << advancing_deg << " " << receding;
      ASSERT_LE(int64_t{info.most_bead_pl} * shared::kMostBeads, std::numeric_limits<int>::max())
          << advancing_deg << " " << receding;
    }
  }
}

// What a drop of that size would do: it rests on any pane, and on a new coating a larger one runs.
TEST(Beads, theLargestRestOnAnUprightPane) {
  const auto runs = [](glass::Glass glass, double larger) {
    const glass::Surface surface = glass::surfaceOf(glass);
    shared::FilmStepInfo info{};
    glass::setBeadShape(info, surface);
    DropScene scene(rad(90), glass);
    const double radius_m =
        std::cbrt(glass::cubicMetres(info.most_bead_pl) / glass::capShape(glass::meanAngle(surface)));
    scene.place(0.0, 0.0, larger * radius_m, glass::meanAngle(surface));
    const glm::vec2 start = scene.sim->snapshot()->drops.at(0).position_m;
    scene.run(weather(0.0), 1.0);
    const auto after = scene.sim->snapshot();
    return after->drops.empty() || glm::distance(after->drops[0].position_m, start) > 1e-5f;
  };
  for (const glass::Glass glass :
       {glass::Glass::uncoated, glass::Glass::dirty, glass::Glass::coated, glass::Glass::new_coating})
    EXPECT_FALSE(runs(glass, 0.98)) << static_cast<int>(glass);
  EXPECT_TRUE(runs(glass::Glass::new_coating, 1.02));
}

// What wind and weight may move is no bead.
TEST(Beads, tooLargeOnesAreOfferedOneByOne) {
  const shared::FilmStepInfo info = uncoated();
  const shared::vec4 coarse = squareTexel(9e-3f);  // whose crowd would leave room for more
  for (const int number : {1, 2, 5}) {
    const int few = number * info.most_bead_pl;
    EXPECT_EQ(shared::settled(0, beads(few, number), coarse, info).gone_pl, 0);
    const shared::FilmTexel more = shared::settled(0, beads(few + number, number), coarse, info);
    EXPECT_EQ(more.gone_pl, few + number);
    EXPECT_EQ(shared::offered_pl(more.gone_pl, more.beads), info.most_bead_pl + 1);
    EXPECT_EQ(more.stirs, 1);
    const shared::FilmTexel left = shared::without(more, info.most_bead_pl + 1);
    EXPECT_EQ(left.beads.number, number - 1);
    EXPECT_EQ(left.beads.volume_pl, few + number - (info.most_bead_pl + 1));
  }
}

// A tile that sleeps dries, and films on it break, without anything being offered: settled() would have to do
// nothing.
TEST(Beads, aFilmThatBreaksLeavesNoneThatIsTooLarge) {
  shared::FilmStepInfo info = uncoated();
  info.rupture_chance = 1.0f;
  const shared::vec4 coarse = squareTexel(5e-3f);
  int broken = 0;
  for (uint32_t texel = 0; texel < 3000; ++texel) {
    const uint32_t h = shared::pcg(texel);
    const int number = static_cast<int>(h % 3), film_pl = static_cast<int>(20'000 + h / 5 % 900'000);
    const shared::FilmTexel t =
        shared::dried(film_pl, beads(number * (info.most_bead_pl - 1000), number), texel, coarse, info);
    if (t.film_pl > 0) continue;
    ++broken;
    ASSERT_LE(t.beads.volume_pl, t.beads.number * info.most_bead_pl);
    ASSERT_EQ(shared::settled(0, t.beads, coarse, info).stirs, 0);
  }
  EXPECT_GT(broken, 1000);
}

// Specks that lie where it breaks do not keep its ridges from pinching off; nor does a large bead part.
TEST(Beads, aFilmThatBreaksLeavesAsManyOverSpecksAsByItself) {
  shared::FilmStepInfo info = uncoated();
  info.rupture_chance = 1.0f;
  constexpr int kFilm_pl = 18'000;  // 2 um
  constexpr uint32_t kTexels = 1000;
  int clean = 0, more = 0, again = 0, large = 0;
  for (uint32_t texel = 0; texel < kTexels; ++texel) {
    const auto left = [&](Beads lying) {
      const shared::FilmTexel t = shared::dried(kFilm_pl, lying, texel, kTexel, info);
      EXPECT_EQ(t.film_pl, 0);
      return t.beads.number;
    };
    const int alone = left(beads(0, 0)), over_specks = left(beads(1200, 20));
    ASSERT_GE(over_specks, alone) << texel;
    clean += alone;
    more += over_specks - alone;
    again += left(beads(kFilm_pl, alone)) - alone;
    large += left(beads(200'000 + static_cast<int>(texel), 1));  // volumes choose how it is rounded
  }
  EXPECT_GT(clean, 3 * static_cast<int>(kTexels));  // or there would be nothing to leave fewer of
  EXPECT_LT(more, clean / 2);  // specks hold too little water to be counted with the others
  EXPECT_EQ(again, 0);         // as its ridges end where the last ones did
  EXPECT_LT(large, 3 * static_cast<int>(kTexels) / 2);  // by the law of water: 1 / 0.84
}

}  // namespace
}  // namespace rg::test
