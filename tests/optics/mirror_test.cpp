// Water on a mirror: light goes through it twice.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "environment.h"
#include "flat_pane.h"
#include "gl_fixture.h"
#include "shared/optics_drop.glsl"

namespace rg::test {
namespace {

constexpr int kMirrorSize_px = 128;
constexpr double kEyeOff_m = 0.65, kHalfSeen_m = 4e-3;
constexpr float kReflects = 0.8f;

// Looked into at a right angle, from so far that all rays are nearly parallel. The world before it (behind
// the eye) is the brighter the further left, the picture it shows when dry is given.
class WetMirror : public GlTest {
 protected:
  WetMirror() : look(gl), glass(gl, -glm::half_pi<double>(), 0.1, 64) {
    glass.pane.mirror = kReflects;
    cube = makeCube(gl, 64, [](const glm::vec3& d) { return glm::vec3(1.0f + d.y); });
    scene.size_px = glm::ivec2(kMirrorSize_px);
    scene.view = forwardView(scene.size_px, 2.0 * std::atan(kHalfSeen_m / kEyeOff_m), {-kEyeOff_m, 0.0, 0.0});
    scene.light.environment_cube = cube.name();
    scene.picture.assign(size_t{kMirrorSize_px} * kMirrorSize_px, glm::vec4(kShown, kShown, kShown, 1.0f));
  }
  // In the picture's middle row; the view's right is the world's -y.
  float at(const Picture& picture, double left_m) const {
    const auto x = static_cast<int>((0.5 - 0.5 * left_m / kHalfSeen_m) * kMirrorSize_px);
    return picture.at(x, kMirrorSize_px / 2)[0];
  }
  static constexpr float kShown = 0.25f;
  glass::GlassLook look;
  FlatPane glass;
  gl::TextureCube cube;
  Scene scene;
};

TEST_F(WetMirror, dryShowsThePictureAsItWas) {
  glass.putFilm([](double, double) { return 0.0; });
  const Picture seen = draw(gl, look, scene, std::span(&glass.pane, 1));
  for (int y = 0; y < kMirrorSize_px; ++y) {
    for (int x = 0; x < kMirrorSize_px; ++x) ASSERT_EQ(seen.at(x, y)[0], kShown);
  }
}

TEST_F(WetMirror, anEvenFilmAddsItsOwnReflectionAlone) {
  glass.putFilm([](double, double) { return 50e-6; });
  const Picture seen = draw(gl, look, scene, std::span(&glass.pane, 1));
  const float first = shared::fresnel(1.0f, shared::kWaterIndex);
  EXPECT_NEAR(at(seen, 0.0), kShown * (1.0f - first) + first, 0.002f);
}

// With its image in the mirror half a ball is a whole one, which turns a ray that meets it at the angle i by
// 2 (i - r) towards its middle: what it shows is upside down.
TEST_F(WetMirror, halfABallOnItIsABallLens) {
  const double radius_m = 3e-3;
  const auto drop = glass.cap(0.0, 0.0, radius_m, glm::half_pi<double>());
  glass.putDrops(std::span(&drop, 1));
  const Picture seen = draw(gl, look, scene, std::span(&glass.pane, 1));
  double least = 1.0, most = 0.0;
  for (double b = -0.7; b <= 0.71; b += 0.1) {
    const double i = std::asin(b), r = std::asin(b / static_cast<double>(shared::kWaterIndex));
    const double turned = 2.0 * (i - r);
    const double face =
        static_cast<double>(shared::fresnel(static_cast<float>(std::cos(i)), shared::kWaterIndex));
    const double through =
        (1.0 - face) * (1.0 - face) * static_cast<double>(kReflects) * (1.0 - std::sin(turned));
    const double off = face * (1.0 + std::sin(2.0 * i));
    // Later reflections within bring some hundredths.
    EXPECT_NEAR(static_cast<double>(at(seen, b * radius_m)), through + off, 0.05) << b;
    least = std::min(least, through);
    most = std::max(most, through);
  }
  EXPECT_GT(most, 2.0 * least) << "the test has no teeth";
  EXPECT_NEAR(at(seen, 1.2 * radius_m), kShown, 1e-3f) << "beside the drop";
}

}  // namespace
}  // namespace rg::test
