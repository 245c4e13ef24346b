// What stands before the glass, or close behind it: pillars and blades are not drawn into the view beside
// them.
#include "look.h"

namespace rg::test {
namespace {

// Something black that reaches to the picture's middle, from its left edge or not so far; bright sky all
// around; what wet glass makes of it.
class NearThing : public Look {
 protected:
  // Film that bends views by some 30 pixels to either side, drops, and the thing where `along_m(row)`
  // of the view says.
  Picture seenWith(bool reversed, double film_m, int drops, const std::function<double(int y)>& along_m) {
    FlatPane pane(gl, kRake, 0.8, 64);
    pane.putFilm([&](double u, double) { return film_m * (1.0 + std::sin(waves_per_m_ * u)); });
    if (drops > 0) pane.putDrops(scatter(pane, drops, 3e-3, glm::radians(60.0), 8));
    const gl::TextureCube white = makeCube(gl, 8, [](const glm::vec3&) { return glm::vec3(1.0f); });
    Scene scene = inside({320, 180});
    scene.light.environment_cube = white.name();
    scene.picture = paint(scene.size_px, [this](int x, int) { return glm::vec3(isThing(x) ? 0.0f : 1.0f); });
    if (reversed) {
      scene.view.clipFromEye[2] = glm::dvec4(0.0, 0.0, 0.0, -1.0);
      scene.view.clipFromEye[3] = glm::dvec4(0.0, 0.0, 0.05, 0.0);
      scene.view.clip_zero_to_one = scene.view.reversed_depth = true;
    }
    for (int y = 0; y < 180; ++y) {
      const glm::dvec4 clip = scene.view.clipFromEye * glm::dvec4(0.0, 0.0, -along_m(y), 1.0);
      const double ndc = clip.z / clip.w;
      const auto thing = static_cast<float>(reversed ? ndc : 0.5 * ndc + 0.5);
      for (int x = 0; x < 320; ++x) scene.depths.push_back(isThing(x) ? thing : reversed ? 0.0f : 1.0f);
    }
    return draw(gl, look, scene, {&pane.pane, 1});
  }
  bool isThing(int x) const { return x >= thing_from_px_ && x < 160; }
  int thing_from_px_ = 0;
  double waves_per_m_ = 80.0;  // of film, times 2 pi
  // A blade's plane `behind_m` off the glass.
  static std::function<double(int)> blade(double behind_m) {
    return [=](int y) {
      const FlatPane::Axes axes(kRake);
      const glm::dvec3 eye_m(-0.65, 0.0, 0.0);
      // Where the pixels' rays, which all lean by the row alone, meet that plane.
      const double rise = (y + 0.5 - 90.0) / 160.0 * std::tan(0.5 * kFov);
      return (behind_m - glm::dot(eye_m, axes.outward)) / glm::dot(glm::dvec3(1.0, 0.0, rise), axes.outward);
    };
  }
  // Mean light of the left half's middle strip, with drops and film in front of it.
  double lightOfBlade(double behind_m, bool reversed) {
    const Picture seen = seenWith(reversed, 2e-4, 1500, blade(behind_m));
    double sum = 0.0;
    for (int y = 60; y < 120; ++y) {
      for (int x = 40; x < 150; ++x) sum += static_cast<double>(seen.at(x, y).x);
    }
    return sum / (60.0 * 110.0);
  }
  // The darkest that wavy film makes the right half, where the sky is.
  static double darkestBeside(const Picture& seen) {
    double least = 1.0;
    for (int y = 60; y < 120; ++y) {
      for (int x = 161; x < 300; ++x) least = std::min(least, static_cast<double>(seen.at(x, y).x));
    }
    return least;
  }
};

// A pillar stands before the glass, a blade close behind it: neither is drawn into the view beside it. Steep
// film reflects the cabin a little, which is dark by it.
TEST_F(NearThing, pillarAndBladeHaveNoFringe) {
  const auto pillar = [](int) { return 0.3; };
  for (const bool reversed : {false, true}) {
    EXPECT_GT(darkestBeside(seenWith(reversed, 2e-3, 0, pillar)), 0.95) << reversed;
    EXPECT_GT(darkestBeside(seenWith(reversed, 2e-3, 0, blade(0.03))), 0.95) << reversed;
  }
}

// Steep waves of a film bend pixels that lie side by side by more than a blade is wide.
TEST_F(NearThing, aThinBladeIsNotLeaptOver) {
  thing_from_px_ = 152;
  waves_per_m_ = 160.0;
  EXPECT_GT(darkestBeside(seenWith(false, 2e-3, 0, blade(0.03))), 0.8);
}

// ... but what stands far off is bent into it, as by any lens.
TEST_F(NearThing, whatStandsFarOffIsSeenBent) {
  EXPECT_LT(darkestBeside(seenWith(false, 2e-3, 0, blade(20.0))), 0.1);
}

TEST_F(NearThing, aBladeCloseBehindWetGlassStaysWholeInEveryDepthConvention) {
  EXPECT_LT(lightOfBlade(0.03, false), 0.01);
  EXPECT_LT(lightOfBlade(0.03, true), 0.01);
}

TEST_F(NearThing, whatStandsFartherOffIsLookedPastByDrops) {
  EXPECT_GT(lightOfBlade(2.0, false), 0.2);
  EXPECT_NEAR(lightOfBlade(2.0, true), lightOfBlade(2.0, false), 0.02);
}

}  // namespace
}  // namespace rg::test
