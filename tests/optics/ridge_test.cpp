// The water a blade pushes before it, as it stands and as it is seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <random>

#include "flat_pane.h"
#include "gl_fixture.h"
#include "shared/glass_wiper.glsl"
#include "shared/hash.glsl"

namespace rg::test {
namespace {

TEST(Ridge, crossSectionHasItsAreaAndMeetsTheGlassInItsAngle) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> exponent(-7.5f, -4.5f), angle(0.2f, 1.2f);
  for (int k = 0; k < 200; ++k) {
    const float area_m2 = std::pow(10.0f, exponent(random)), tangent = std::tan(angle(random));
    const float width_m = shared::ridgeWidth_m(area_m2, tangent);
    double sum_m2 = 0.0;
    constexpr int kSlices = 2000;
    for (int n = 0; n < kSlices; ++n) {
      const float x = width_m * (static_cast<float>(n) + 0.5f) / kSlices;
      sum_m2 += static_cast<double>(shared::ridgeHeight_m(area_m2, width_m, x) * width_m) / kSlices;
    }
    EXPECT_NEAR(sum_m2 / static_cast<double>(area_m2), 1.0, 1e-3);
    EXPECT_LE(shared::ridgeHeight_m(area_m2, width_m, 0.0f), shared::kHighestRidge_m * 1.0001f);
    const float foot = -shared::ridgeSlope(area_m2, width_m, width_m);
    EXPECT_LE(foot, tangent * 1.001f);
    // The angle rules until it would stand higher than a puddle.
    if (shared::ridgeHeight_m(area_m2, width_m, 0.0f) < 0.99f * shared::kHighestRidge_m) {
      EXPECT_NEAR(foot / tangent, 1.0f, 1e-3f);
    }
    const float x = 0.6f * width_m, dx = 0.01f * width_m;
    const float slope =
        (shared::ridgeHeight_m(area_m2, width_m, x + dx) - shared::ridgeHeight_m(area_m2, width_m, x - dx)) /
        (2.0f * dx);
    EXPECT_NEAR(shared::ridgeSlope(area_m2, width_m, x) / slope, 1.0f, 1e-2f);
  }
}

class SeenRidge : public GlTest {
 protected:
  struct Changed {
    int behind = 0, ahead = 0, beyond = 0, beside = 0;
  };
  // A blade across the pane's middle, pushing to the right: which pixels it changes, by where they lie.
  Changed seen(int64_t volume_pl_m, double blade_m = 0.06) {
    FlatPane pane(gl, glm::radians(60.0), 0.8, 64);
    pane.putFilm([](double, double) { return 1e-7; });
    glass::LookBlade blade;
    blade.along = glm::vec3(pane.up);
    blade.ahead = glm::vec3(pane.right);
    blade.blade_m = static_cast<float>(blade_m);
    const double piece_m = blade_m / shared::kBladeSegments;
    const std::vector<int32_t> pieces(shared::kBladeSegments * shared::kMaxGlassWipers,
                                      static_cast<int32_t>(static_cast<double>(volume_pl_m) * piece_m));
    const gl::Buffer ridges(gl, std::span<const int32_t>(pieces));
    pane.pane.blades = {blade};
    pane.pane.ridge_buffer = ridges.name();
    pane.pane.ridge_contact_rad = 0.7f;
    Scene scene;
    scene.size_px = {640, 360};
    scene.view = forwardView(scene.size_px, glm::radians(14.0));
    for (int y = 0; y < 360; ++y) {
      for (int x = 0; x < 640; ++x)
        scene.picture.emplace_back(glm::vec3(static_cast<float>(x), static_cast<float>(y), 100.0f) / 640.0f,
                                   1.0f);
    }
    glass::GlassLook look(gl);
    const Picture with = draw(gl, look, scene, {&pane.pane, 1}), without = draw(gl, look, scene, {});
    const float width_m = shared::ridgeWidth_m(static_cast<float>(volume_pl_m) * shared::kPicolitre_m3,
                                               std::tan(pane.pane.ridge_contact_rad));
    Changed out;
    for (int y = 0; y < 360; ++y) {
      for (int x = 0; x < 640; ++x) {
        if (glm::distance(with.at(x, y), without.at(x, y)) < 2e-3f) continue;
        // Where the pixel's ray meets the pane.
        const double f = 320.0 / std::tan(glm::radians(7.0));
        const glm::dvec3 ray(1.0, -(x + 0.5 - 320.0) / f, (y + 0.5 - 180.0) / f);
        const glm::dvec3 eye_m(-0.65, 0.0, 0.0);
        const glm::dvec3 p = eye_m - ray * (glm::dot(eye_m, pane.outward) / glm::dot(ray, pane.outward));
        const double u = glm::dot(p, pane.right), v = glm::dot(p, pane.up);
        if (std::abs(v) > 0.5 * blade_m)
          ++out.beside;
        else if (u < 0.0)
          ++out.behind;
        else
          ++(u <= static_cast<double>(width_m) ? out.ahead : out.beyond);
      }
    }
    return out;
  }
};

// A roll of less than two pixels, which pieces get their water for as unevenly as from a shower's drops,
// shows a lamp aside as one streak along it: no row of pixels between its ends is dark, and none is twice as
// bright as the next but at its ends.
TEST_F(SeenRidge, showsALampAsAStreakWithoutGaps) {
  FlatPane pane(gl, glm::radians(60.0), 0.8, 64);
  pane.putFilm([](double, double) { return 1e-7; });
  glass::LookBlade blade;
  blade.along = glm::vec3(pane.up);
  blade.ahead = glm::vec3(pane.right);
  blade.blade_m = 0.3f;
  const double piece_m = 0.3 / shared::kBladeSegments;
  std::vector<int32_t> pieces;
  for (uint32_t k = 0; k < shared::kBladeSegments * shared::kMaxGlassWipers; ++k)
    pieces.push_back(static_cast<int32_t>(
        1e9 * piece_m * (0.4 + 1.2 * static_cast<double>(shared::unitFloat(shared::pcg(k))))));
  const gl::Buffer ridges(gl, std::span<const int32_t>(pieces));
  pane.pane.blades = {blade};
  pane.pane.ridge_buffer = ridges.name();
  pane.pane.ridge_contact_rad = 0.7f;
  Scene scene;
  scene.size_px = {640, 320};
  scene.view = forwardView(scene.size_px, glm::radians(60.0));
  const glm::ivec2 lamp(260, 160), from(316, 80), to(328, 240);  // where the ridge is
  for (int y = 0; y < 320; ++y) {
    for (int x = 0; x < 640; ++x)
      scene.picture.emplace_back(
          glm::vec3(glm::distance(glm::vec2(x, y), glm::vec2(lamp)) < 4.0f ? 1000.0f : 0.0f), 1.0f);
  }
  glass::GlassLook look(gl);
  const Picture shown = draw(gl, look, scene, {&pane.pane, 1});
  std::vector<float> rows;
  for (int y = from.y; y < to.y; ++y) {
    float light = 0.0f;
    for (int x = from.x; x < to.x; ++x) light += shown.at(x, y).x;
    rows.push_back(light);
  }
  const float brightest = *std::max_element(rows.begin(), rows.end());
  ASSERT_GT(brightest, 0.0f);
  const auto lit = [&](float light) { return light > 0.1f * brightest; };
  const auto first = std::find_if(rows.begin(), rows.end(), lit);
  const auto last = std::find_if(rows.rbegin(), rows.rend(), lit).base() - 1;
  EXPECT_GT(last - first, 20);
  for (auto row = first; row < last; ++row) {
    EXPECT_TRUE(lit(*row)) << "row " << row - rows.begin();
    EXPECT_LT(std::max(row[0], row[1]), 2.0f * std::min(row[0], row[1])) << "row " << row - rows.begin();
  }
}

TEST_F(SeenRidge, isSeenAheadOfTheBladeAndNowhereElse) {
  const Changed changed = seen(10'000'000'000);  // 10 mL a metre
  EXPECT_GT(changed.ahead, 500);
  EXPECT_LE(changed.behind + changed.beyond + changed.beside, changed.ahead / 50);  // pixels on its rim
  EXPECT_EQ(seen(0).ahead, 0);
}

TEST_F(SeenRidge, isBroaderAsTheRootOfItsWater) {
  const int one = seen(1'000'000'000).ahead, four = seen(4'000'000'000).ahead;
  EXPECT_NEAR(static_cast<double>(four) / one, 2.0, 0.25);  // whole pixels
}

}  // namespace
}  // namespace rg::test
