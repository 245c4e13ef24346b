// Beads: the small drops of a texel. They dry as drops do, run together where they are crowded, join a film,
// are taken by drops and blades, and no picolitre of them is lost.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "drop_scene.h"
#include "film_reference.h"
#include "gl_fixture.h"
#include "glass/film_gl.h"
#include "glass/water.h"
#include "glass/wiper.h"
#include "scene.h"

namespace rg::test {
namespace {

using shared::Beads;

Beads beads(int volume_pl, int number) {
  Beads b{};
  b.volume_pl = volume_pl;
  b.number = number;
  return b;
}

// Of a texel of 3 mm on uncoated glass.
shared::FilmStepInfo uncoated() {
  const glass::Surface s = glass::surfaceOf(glass::Glass::uncoated);
  shared::FilmStepInfo info{};
  info.pin_m = static_cast<float>(s.pin_m);
  info.front_m = static_cast<float>(s.front_m);
  info.rupture_m = static_cast<float>(s.rupture_m);
  glass::setBeadShape(info, s);
  info.drops_allowed = 1;
  return info;
}
const shared::vec4 kTexel(3e-3f, 3e-3f, 1.0f / 9e-6f, 0.0f);

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
    const shared::FilmTexel left = shared::without(t, t.gone_pl);
    ASSERT_EQ(int64_t{left.film_pl} + left.beads.volume_pl,
              int64_t{t.film_pl} + t.beads.volume_pl - t.gone_pl);
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
      EXPECT_EQ(t.gone_pl, volume_pl);
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
  const shared::vec4 coarse(9e-3f, 9e-3f, 1.0f / 81e-6f, 0.0f);  // whose crowd would leave room for more
  for (const int number : {1, 2, 5}) {
    const int few = number * info.most_bead_pl;
    EXPECT_EQ(shared::settled(0, beads(few, number), coarse, info).gone_pl, 0);
    const shared::FilmTexel more = shared::settled(0, beads(few + number, number), coarse, info);
    EXPECT_EQ(more.gone_pl, info.most_bead_pl + 1);
    EXPECT_EQ(more.stirs, 1);
    const shared::FilmTexel left = shared::without(more, more.gone_pl);
    EXPECT_EQ(left.beads.number, number - 1);
    EXPECT_EQ(left.beads.volume_pl, few + number - more.gone_pl);
  }
}

// A tile that sleeps dries, and films on it break, without anything being offered: settled() would have to do
// nothing.
TEST(Beads, aFilmThatBreaksLeavesNoneThatIsTooLarge) {
  shared::FilmStepInfo info = uncoated();
  info.rupture_chance = 1.0f;
  const shared::vec4 coarse(5e-3f, 5e-3f, 1.0f / 25e-6f, 0.0f);
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
    large += left(beads(200'000, 1));
  }
  EXPECT_GT(clean, 3 * static_cast<int>(kTexels));  // or there would be nothing to leave fewer of
  EXPECT_LT(more, clean / 2);  // specks hold too little water to be counted with the others
  EXPECT_EQ(again, 0);         // as its ridges end where the last ones did
  EXPECT_LT(large, 3 * static_cast<int>(kTexels) / 2);  // by the law of water: 1 / 0.84
}

// The beads of a texel: each part's lower corner lies at another's right or upper edge.
std::vector<shared::SeatedBead> seatsOf(uint32_t texel, int number, float mean) {
  constexpr float kIn = 1e-6f;
  std::vector<shared::SeatedBead> found;
  std::vector<glm::vec2> places{{kIn, kIn}};
  while (!places.empty()) {
    const glm::vec2 place = places.back();
    places.pop_back();
    if (place.x >= 1.0f || place.y >= 1.0f) continue;
    const shared::SeatedBead bead = shared::seatedBead(texel, place, number, mean);
    const auto same = [&](const shared::SeatedBead& that) {
      return that.low == bead.low && that.high == bead.high;
    };
    if (std::any_of(found.begin(), found.end(), same)) continue;
    found.push_back(bead);
    places.push_back({bead.high.x + kIn, bead.low.y + kIn});
    places.push_back({bead.low.x + kIn, bead.high.y + kIn});
  }
  return found;
}

// The look's places: in each part one bead, none over its edge, the volumes' sum that of the mean ones.
TEST(Beads, seatsAreAsManyAsThereAreAndHoldTheirVolume) {
  double most_off = 0.0;
  for (uint32_t texel = 0; texel < 40; ++texel) {
    for (int number = 1; number <= shared::kMostBeads; ++number) {
      const float mean = 0.05f / std::sqrt(static_cast<float>(number));  // none is cut by its part
      const std::vector<shared::SeatedBead> seats = seatsOf(texel, number, mean);
      ASSERT_EQ(seats.size(), static_cast<size_t>(number));
      double volume = 0.0, area = 0.0;
      for (const shared::SeatedBead& bead : seats) {
        volume += std::pow(static_cast<double>(bead.size), 3.0);
        const glm::vec2 from = bead.middle - bead.low, to = bead.high - bead.middle;
        area += static_cast<double>((bead.high.x - bead.low.x) * (bead.high.y - bead.low.y));
        const float radius = bead.size * mean;
        for (const float x : {from.x, from.y, to.x, to.y}) ASSERT_GE(x, radius - 1e-4f);
        for (const float turn : {0.0f, 1.6f, 3.1f, 4.7f}) {  // a pixel of it finds it
          const glm::vec2 place = bead.middle + 0.99f * radius * glm::vec2(std::cos(turn), std::sin(turn));
          ASSERT_EQ(shared::seatedBead(texel, place, number, mean).low, bead.low);
        }
      }
      EXPECT_NEAR(area, 1.0, 1e-4);
      most_off = std::max(most_off, std::abs(volume / number - 1.0));
    }
  }
  EXPECT_LT(most_off, 1e-3);
}

// As much as what ligaments pinch off: a gamma law's order is 1 / cv^2. However crowded they are, parts cut
// little of them.
TEST(Beads, sizesDifferAsThoseThatRidgesPinchOff) {
  for (const int number : {8, 16, 40}) {
    const auto crowded =
        static_cast<float>(std::sqrt(static_cast<double>(shared::kCrowded) / (kPi * number)));
    double sum = 0.0, squares = 0.0, volume = 0.0;
    constexpr int kTexels = 300;
    for (uint32_t texel = 0; texel < kTexels; ++texel) {
      for (const shared::SeatedBead& bead : seatsOf(texel, number, 1e-3f)) {
        sum += static_cast<double>(bead.size);
        squares += static_cast<double>(bead.size * bead.size);
      }
      for (const shared::SeatedBead& bead : seatsOf(texel, number, crowded))
        volume += std::pow(static_cast<double>(bead.size), 3.0);
    }
    const double mean = sum / (kTexels * number),
                 order = mean * mean / (squares / (kTexels * number) - mean * mean);
    std::printf("%d: order %.1f, %.3f of the volume\n", number, order, volume / (kTexels * number));
    EXPECT_GT(order, 4.0);
    EXPECT_LT(order, 10.0);
    EXPECT_GT(volume / (kTexels * number), 0.94);
  }
}

// A lone one lies whole in its texel and, while it is small, stays where it is when others come; so do all
// others but where the new one is.
TEST(Beads, thoseThereStayWhenOthersCome) {
  for (uint32_t texel = 0; texel < 200; ++texel) {
    const shared::SeatedBead large = shared::seatedBead(texel, glm::vec2(0.5f), 1, 0.36f);
    EXPECT_EQ(large.size, 1.0f);
    for (const float x : {large.middle.x, large.middle.y}) {
      EXPECT_GE(x, 0.36f - 1e-4f);
      EXPECT_LE(x, 0.64f + 1e-4f);
    }
    const glm::vec2 lone = shared::seatedBead(texel, glm::vec2(0.0f), 1, 1e-3f).middle;
    std::vector<shared::SeatedBead> before = seatsOf(texel, 1, 1e-3f);
    for (int number = 2; number <= 12; ++number) {
      EXPECT_LT(glm::distance(shared::seatedBead(texel, lone, number, 1e-3f).middle, lone), 4e-3f);
      const std::vector<shared::SeatedBead> now = seatsOf(texel, number, 1e-3f);
      const auto gone = std::count_if(before.begin(), before.end(), [&](const shared::SeatedBead& was) {
        return std::none_of(now.begin(), now.end(), [&](const shared::SeatedBead& is) {
          return is.low == was.low && is.high == was.high;
        });
      });
      EXPECT_LE(gone, 1) << number;
      before = now;
    }
  }
}

TEST(Beads, theBentGridIsFoundAgain) {
  for (int i = 0; i < 1000; ++i) {
    const glm::vec2 place(static_cast<float>(i % 40) * 13.7f, static_cast<float>(i) * 0.37f);
    EXPECT_LT(glm::distance(shared::beadPlace(shared::gridPlace(place)), place), 2e-3f);
  }
}

class BeadsOnGlass : public GlTest {
 protected:
  // A film of which a test says what comes to it, on a pane that lies level.
  struct Bench {
    Bench(const GladGLContext& gl, double width_m, double height_m)
        : mesh(windscreen(width_m, height_m, 1e-4)),
          sim(paneInfo(mesh), 1, 7),
          gpu(gl, glass::makeFilmPrograms(gl), sim.map(), sim.unevenness()),
          info(uncoated()) {
      info.columns = sim.map().grid().size.x;
      info.rows = sim.map().grid().size.y;
      info.up_y = 1.0f;
    }
    glass::FilmReport step(const std::function<void(glass::FilmOrder&)>& fill = {}) {
      glass::FilmOrder order;
      order.step = steps;
      order.info = info;
      order.info.step = static_cast<uint32_t>(2 * steps++);
      order.drive.assign(sim.map().nodes().size(), {0.0f, 0.0f, 0.0f, 0.0f});
      if (fill) fill(order);
      std::vector<glass::FilmOrder> orders;
      orders.push_back(std::move(order));
      gpu.run(std::move(orders));
      return gpu.collect(true).at(0);
    }
    int at(int dx, int dy) const { return (info.rows / 2 + dy) * info.columns + info.columns / 2 + dx; }
    Mesh mesh;
    glass::PaneSim sim;
    glass::FilmGl gpu;
    shared::FilmStepInfo info;
    int64_t steps = 0;
  };
};

// Hu & Larson with a constant contact angle: -dV/dt = k R and V = R^3 shape, so V^(2/3) falls linearly and
// the time to the end is 3 V0^(2/3) shape^(1/3) / (2 k), for many of one size as for one. The tile sleeps
// meanwhile.
TEST_F(BeadsOnGlass, dryInTheTimeOfTheClosedForm) {
  Bench bench(gl, 0.1, 0.1);
  const glass::Surface s = glass::surfaceOf(glass::Glass::uncoated);
  const double k_m2_s = glass::evaporation_kg_s(1.0, glass::meanAngle(s), 0.3, 0.0173) / 1000.0;
  bench.info.bead_drying_pl_mm =
      static_cast<float>(k_m2_s * 1e12 * 8.0 * static_cast<double>(shared::kFilmStep_s));
  const double bead_m3 = 4e-12, shape = glass::capShape(glass::meanAngle(s));
  const double time_s = 1.5 * std::pow(bead_m3, 2.0 / 3.0) * std::cbrt(shape) / k_m2_s;
  const int one = bench.at(0, 0), many = bench.at(3, 1);
  const int pl = static_cast<int>(std::llround(bead_m3 * 1e15));
  glass::FilmReport report = bench.step([&](glass::FilmOrder& order) {
    order.bead_adds.push_back({one, pl, 1});
    order.bead_adds.push_back({many, 12 * pl, 12});
  });
  int64_t dried = 0;
  std::array<double, 2> gone_s{};
  const auto half = [&](int texel) {
    return shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]);
  };
  bool halfway = false;
  for (int step = 1; step < 60 * 120 && (gone_s[0] == 0.0 || gone_s[1] == 0.0); ++step) {
    report = bench.step();
    for (const shared::FilmTile& tile : report.tiles) dried += tile.evaporated_pl;
    const double now_s = step * static_cast<double>(shared::kFilmStep_s);
    if (step % 8 == 0) {
      const Beads a = half(one), b = half(many);
      if (a.number == 0 && gone_s[0] == 0.0) gone_s[0] = now_s;
      if (b.number == 0 && gone_s[1] == 0.0) gone_s[1] = now_s;
      if (!halfway && now_s > 0.5 * time_s) {
        halfway = true;
        const double law = std::pow(1.0 - now_s / time_s, 1.5);
        EXPECT_NEAR(static_cast<double>(a.volume_pl) / pl, law, 0.03);
        EXPECT_NEAR(static_cast<double>(b.volume_pl) / (12 * pl), law, 0.03);
      }
    }
  }
  std::printf("dry after %.2f s and %.2f s, law %.2f s\n", gone_s[0], gone_s[1], time_s);
  // Eighths of a second, whole picolitres by chance, and an end by 50 pl instead of 0, which is 5 % of the
  // radius' square.
  for (const double gone : gone_s) EXPECT_NEAR(gone / time_s, 1.0, 0.06);
  EXPECT_EQ(dried, 13 * pl);
}

// A film that flows over them takes them in; one that breaks up leaves them.
TEST_F(BeadsOnGlass, joinAFilmThatFlowsAndAreWhatABrokenOneLeaves) {
  Bench bench(gl, 0.1, 0.1);
  const int texel = bench.at(0, 0);
  bench.step([&](glass::FilmOrder& order) { order.bead_adds.push_back({texel, 50'000, 2}); });
  EXPECT_EQ(shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]).volume_pl, 50'000);
  EXPECT_EQ(bench.gpu.readFilm()[static_cast<size_t>(texel)], 0);
  bench.step([&](glass::FilmOrder& order) { order.adds.push_back({texel, 90'000}); });  // 10 um
  EXPECT_EQ(bench.gpu.readBeads()[static_cast<size_t>(texel)], 0u);
  EXPECT_EQ(bench.gpu.readFilm()[static_cast<size_t>(texel)], 140'000);
  bench.info.rupture_chance = 1.0f;
  for (int k = 0; k < 9; ++k) bench.step();
  const Beads left = shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]);
  EXPECT_EQ(left.volume_pl, 140'000);
  EXPECT_GT(left.number, 1);
  EXPECT_EQ(bench.gpu.readFilm()[static_cast<size_t>(texel)], 0);
}

// A drop that runs over half a texel takes half of what lies there.
TEST_F(BeadsOnGlass, aDropTakesItsShare) {
  Bench bench(gl, 0.1, 0.1);
  const int texel = bench.at(0, 0);
  bench.step([&](glass::FilmOrder& order) { order.bead_adds.push_back({texel, 80'000, 8}); });
  const glass::FilmReport report = bench.step([&](glass::FilmOrder& order) {
    order.takes.push_back({texel, 32768});
  });
  EXPECT_EQ(report.taken_pl.at(0), 40'000);
  const Beads left = shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]);
  EXPECT_EQ(left.volume_pl, 40'000);
  EXPECT_EQ(left.number, 4);
}

// A blade leaves no bead on its way, and touches none beside it.
TEST_F(BeadsOnGlass, aBladeTakesAll) {
  const Mesh mesh = windscreen(0.9, 0.6, 1e-4);
  Simulation sim(gl, paneInfo(mesh));
  sim.sim->setWiper(3, wiper(1e-4, 0.6));
  glass::PaneTick drizzle = weather(0.0);
  drizzle.class_count = 1;
  drizzle.classes[0] = {0.5e-3, 4000.0, 2.0};
  sim.run(drizzle, 2.0);
  sim.run(weather(0.0), 0.5);
  const std::vector<uint32_t> before = sim.pane.readBeads();
  const glass::Sweep sweep{rad(40), rad(100)};
  glass::PaneTick tick = weather(0.0);
  tick.wiper_count = 1;
  constexpr int kTicks = 40;
  for (int k = 0; k < kTicks; ++k) {
    const double a = rad(40 + 60.0 * k / kTicks), b = rad(40 + 60.0 * (k + 1) / kTicks);
    tick.wipers[0] = {3, a, b, b};
    sim.tick(tick);
  }
  const std::vector<uint32_t> after = sim.pane.readBeads();
  const glass::Wiper blade(wiper(1e-4, 0.6), sim.sim->map(), 0);
  int wiped = 0, kept = 0;
  for (int i = 0; i < sim.sim->map().texelCount(); ++i) {
    if (!sim.sim->map().inside(i)) continue;
    const auto t = static_cast<size_t>(i);
    const glass::Crossings c = blade.crossingsAt(glm::dvec3(sim.sim->map().texel(i).position_m));
    if (c.count > 0 && sweep.covers(c.angle_rad[0])) {
      EXPECT_EQ(after[t], 0u) << "texel " << i;
      wiped += before[t] != 0 ? 1 : 0;
    } else if (before[t] != 0) {
      ASSERT_EQ(after[t], before[t]) << "texel " << i;
      ++kept;
    }
  }
  EXPECT_GT(wiped, 1000);
  EXPECT_GT(kept, 1000);
  const glass::PaneStats s = sim.stats();
  EXPECT_GT(s.ridge_pl, 0);
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

// Small impacts lie as beads and take no slot; placed drops are drops however small.
TEST_F(BeadsOnGlass, drizzleIsBeadsAndPlacedDropsAreNot) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  Simulation sim(gl, paneInfo(mesh));
  glass::PaneTick drizzle = weather(0.0);
  drizzle.class_count = 1;
  drizzle.classes[0] = {0.6e-3, 500.0, 2.0};
  sim.run(drizzle, 0.5);
  const glass::PaneStats s = sim.stats();
  EXPECT_EQ(s.drops, 0u);
  EXPECT_GT(s.beads_pl, 0);
  EXPECT_EQ(s.caught_pl, sumOf(s));
  int64_t lying = 0;
  for (const uint32_t packed : sim.pane.readBeads()) lying += shared::beadsOf(packed).volume_pl;
  EXPECT_EQ(lying, s.beads_pl);
  const glass::PlacedDrop drop{0.0, 0.0, 0.2e-3, 0.5};
  sim.sim->placeDrops({&drop, 1});
  EXPECT_EQ(sim.stats().drops, 1u);
}

// However coarse the texels are, an impact of more water than a bead may hold is a drop.
TEST_F(BeadsOnGlass, noImpactThatWindMayMoveLiesAsABead) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  glass::PaneInfo info = paneInfo(mesh);
  info.texel_m = 5e-3;
  struct Case {
    glass::Glass glass;
    double diameter_m;
    bool lies;
  };
  for (const Case c : {Case{glass::Glass::uncoated, 0.9e-3, true},         // a bead of 1.03 mm
                       Case{glass::Glass::uncoated, 1.05e-3, false},       // of 1.20 mm
                       Case{glass::Glass::new_coating, 1.1e-3, true},      // of 0.62 mm; 0.67 rest
                       Case{glass::Glass::new_coating, 1.3e-3, false}}) {  // of 0.74 mm
    info.glass = c.glass;
    Simulation sim(gl, info);
    glass::PaneTick rain = weather(0.0);
    rain.class_count = 1;
    rain.classes[0] = {c.diameter_m, 100.0, 2.0};
    sim.run(rain, 0.5);
    EXPECT_EQ(sim.stats().beads_pl > 0, c.lies) << c.diameter_m;
    EXPECT_EQ(sim.stats().drops > 0, !c.lies) << c.diameter_m;
  }
}

// Nor is it one until the film's step finds that it is too large.
TEST(Beads, anImpactThatAnUprightPaneWouldNotHoldIsADropAtOnce) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  glass::PaneInfo info = paneInfo(mesh);
  info.texel_m = 5e-3;
  info.glass = glass::Glass::new_coating;
  for (const double diameter_m : {1.1e-3, 1.3e-3}) {  // as above
    glass::PaneSim sim(info, 1, 7);
    sim.attachFilm();
    glass::PaneTick rain = weather(0.0);
    rain.class_count = 1;
    rain.classes[0] = {diameter_m, 1000.0, 2.0};
    for (; rain.index < glass::kReportLatency_ticks; ++rain.index) sim.submit(rain);
    size_t lying = 0;
    for (const glass::FilmOrder& order : sim.fetchOrders()) lying += order.bead_adds.size();
    EXPECT_EQ(lying > 0, diameter_m < 1.2e-3) << lying;
    EXPECT_EQ(sim.stats().drops > 0, diameter_m > 1.2e-3) << diameter_m;
  }
}

// What lies in its way a drop takes up, as wide as it is and no wider.
TEST_F(BeadsOnGlass, aDropThatSlidesClearsItsWholeWidth) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(50));
  glass::PaneInfo info = paneInfo(mesh);
  info.unevenness = 0.0;              // it runs straight ...
  info.glass = glass::Glass::coated;  // ... and leaves no film, which would break into beads behind it
  Simulation sim(gl, info);
  glass::PaneTick drizzle = weather(0.0);
  drizzle.class_count = 1;
  drizzle.classes[0] = {0.3e-3, 1e5, 2.0};
  sim.run(drizzle, 2.0);
  const glass::PaneMap& map = sim.sim->map();
  const double column_m = map.glassFromGrid(map.middleOf(map.texelAt(map.gridFromGlass({0.0, 0.08})))).x;
  // How many in the columns of texels that lie so far to both sides of the drop's. (It leaves pearls, few and
  // large.)
  const auto lyingBy = [&](double from_m, double to_m) {
    const std::vector<uint32_t> beads = sim.pane.readBeads();
    double sum = 0.0;
    for (int i = 0; i < map.texelCount(); ++i) {
      const glm::dvec2 place = map.glassFromGrid(map.middleOf(i));
      const bool asked = std::abs(place.x - column_m) >= from_m && std::abs(place.x - column_m) < to_m &&
                         std::abs(place.y) < 0.05;
      if (asked) sum += shared::beadsOf(beads[static_cast<size_t>(i)]).number;
    }
    return sum;
  };
  const double beside_before = lyingBy(1.6e-3, 4.6e-3), far_before = lyingBy(12e-3, 30e-3);
  const glass::PlacedDrop drop{column_m, 0.08, 6e-3, 1.5};
  sim.sim->placeDrops({&drop, 1});
  sim.run(weather(0.0), 0.55);  // it has come by, and its pearls have not run together yet
  EXPECT_LT(lyingBy(1.6e-3, 4.6e-3), 0.1 * beside_before) << "under it, beside its middle";
  EXPECT_NEAR(lyingBy(12e-3, 30e-3) / far_before, 1.0, 0.02);
}

// At 100 mm/h and 100 km/h slots suffice.
TEST_F(BeadsOnGlass, slotsSufficeInADownpourAtSpeed) {
  const Mesh mesh = windscreen(0.75, 0.8, rad(30), 0.03);
  glass::PaneInfo info = paneInfo(mesh);
  info.max_drops = 10000;  // half a windscreen, half the slots
  Simulation sim(gl, info);
  sim.run(weather(100.0, 27.8, 0.9), 6.0);
  const glass::PaneStats s = sim.stats();
  std::printf("drops %u, beads %.1f mL, drops %.1f mL, film %.1f mL of %.1f mL caught\n", s.drops,
              1e-9 * static_cast<double>(s.beads_pl), 1e-9 * static_cast<double>(s.drops_pl),
              1e-9 * static_cast<double>(s.film_pl), 1e-9 * static_cast<double>(s.caught_pl));
  EXPECT_LT(s.drops, 7500u);
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

}  // namespace
}  // namespace rg::test
