// Where the look sees the beads of a texel, and of what sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "shared/glass_beads.glsl"

namespace rg::test {
namespace {

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

}  // namespace
}  // namespace rg::test
