// An eye that looks past the glass: each of its pupil's points sees the water elsewhere before what is far
// away, and the picture is the mean of theirs. The oracle is that of 37 sharp ones.
#include <cmath>

#include "look.h"

namespace rg::test {
namespace {

class Pupil : public Look {
 protected:
  static constexpr double kPupil_m = 0.01;

  // How far pictures are from the oracle in terms of what the water changes in it; and how much light the
  // water adds to the soft one, in terms of the oracle's.
  struct Seen {
    double soft_wrong, sharp_wrong, light;
  };
  Seen seenAgainstOracle(const FlatPane& pane, Scene scene) {
    scene.depths.assign(scene.picture.size(), 1.0f);
    const Picture sharp = draw(gl, look, scene, {&pane.pane, 1}), dry = draw(gl, look, scene, {});
    look.settings.pupil_m = static_cast<float>(kPupil_m);
    const Picture soft = draw(gl, look, scene, {&pane.pane, 1});
    look.settings.pupil_m = 0.0f;
    const std::vector<glm::dvec3> oracle = meanOfPupil(pane, scene);
    const auto square = [](const glm::dvec3& d) { return glm::dot(d, d); };
    double soft_wrong = 0.0, sharp_wrong = 0.0, changed = 0.0, light = 0.0, oracles_light = 0.0;
    for (size_t p = 0; p < oracle.size(); ++p) {
      const glm::dvec3 without(dry.pixels[p]);
      soft_wrong += square(glm::dvec3(soft.pixels[p]) - oracle[p]);
      sharp_wrong += square(glm::dvec3(sharp.pixels[p]) - oracle[p]);
      changed += square(oracle[p] - without);
      light += static_cast<double>(soft.pixels[p].x) - without.x;
      oracles_light += oracle[p].x - without.x;
    }
    return {std::sqrt(soft_wrong / changed), std::sqrt(sharp_wrong / changed), light / oracles_light};
  }

 private:
  std::vector<glm::dvec3> meanOfPupil(const FlatPane& pane, Scene scene) {
    std::vector<glm::dvec3> sum(scene.picture.size());
    int eyes = 0;
    for (int k = 0; k < 49; ++k) {
      const glm::dvec2 at = glm::dvec2(k % 7 - 3, k / 7 - 3) / 7.0 * kPupil_m;
      if (glm::length(at) > 0.5 * kPupil_m) continue;
      scene.view = forwardView(scene.size_px, kFov, {-0.65, at.x, at.y});
      const Picture seen = draw(gl, look, scene, {&pane.pane, 1});
      for (size_t p = 0; p < sum.size(); ++p) sum[p] += glm::dvec3(seen.pixels[p]);
      ++eyes;
    }
    for (glm::dvec3& pixel : sum) pixel /= static_cast<double>(eyes);
    return sum;
  }
};

TEST_F(Pupil, dropsOutOfFocusAreTheMeanOfWhatItsPointsSee) {
  FlatPane pane(gl, kRake, 0.8, 128);
  pane.putDrops(scatter(pane, 40, 4e-3, glm::radians(50.0), 5));
  pane.putBeads([](double u, double v) { return std::abs(u) < 0.02 && std::abs(v) < 0.03 ? 1 : 0; }, 0.2,
                glm::radians(40.0));
  const gl::TextureCube cube =
      makeCube(gl, 16, [](const glm::vec3& towards) { return glm::vec3(towards.z > 0.0f ? 1.0f : 0.1f); });
  Scene scene = inside({192, 108});
  scene.picture = paint(scene.size_px, [](int, int) { return glm::vec3(0.4f, 0.5f, 0.6f); });
  scene.light.environment_cube = cube.name();
  const Seen seen = seenAgainstOracle(pane, scene);
  // A few texels stand for the disc, and the drops' own light is as the pupil's middle sees it.
  EXPECT_LT(seen.soft_wrong, 0.45);
  EXPECT_GT(seen.sharp_wrong, 2.0);
  EXPECT_NEAR(seen.light, 1.0, 0.03);
}

// Waves as short as a film's are, for so wide a pupil.
TEST_F(Pupil, filmOutOfFocusIsTheMeanOfWhatItsPointsSee) {
  FlatPane pane(gl, kRake, 0.8, 128);
  pane.putFilm([](double u, double v) { return 60e-6 * (1.0 + std::sin(250.0 * u) * std::cos(200.0 * v)); });
  pane.cutIntoPieces();
  Scene scene = inside({384, 216});
  scene.picture = paint(scene.size_px, [](int x, int y) {
    return glm::vec3(0.5f) + 0.4f * glm::vec3(std::sin(0.1f * static_cast<float>(x)),
                                              std::sin(0.1f * static_cast<float>(y)), 0.0f);
  });
  const Seen seen = seenAgainstOracle(pane, scene);
  // Eight points stand for the pupil: what they miss of waves is 1 / sqrt(8) of these, at most.
  EXPECT_LT(seen.soft_wrong, 0.35 * seen.sharp_wrong);
  EXPECT_GT(seen.sharp_wrong, 1.0);
}

// Lines of film a texel wide: each pupil's point sees them elsewhere, beyond the cells of four texels that
// hold them.
TEST_F(Pupil, filmOutOfFocusIsSeenAsFarAsItsPointsSeeIt) {
  FlatPane pane(gl, kRake, 0.8, 128);
  const double texel_m = 0.8 / 128;
  pane.putFilm([&](double u, double) {
    return std::lround(std::floor(u / texel_m)) % 8 == -2 ? 100e-6 : 0.0;  // two texels from the next cell
  });
  pane.cutIntoPieces();
  Scene scene = inside({384, 216});
  scene.picture = paint(scene.size_px, [](int x, int) {
    return glm::vec3(0.5f + 0.4f * std::sin(0.1f * static_cast<float>(x)));
  });
  const Seen seen = seenAgainstOracle(pane, scene);
  EXPECT_LT(seen.soft_wrong, 0.35 * seen.sharp_wrong);
}

}  // namespace
}  // namespace rg::test
