// The air before what is seen: snow that falls in the open, none in shelters.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "host_render/boxes.h"
#include "render/renderer.h"

namespace host {
namespace {

constexpr glm::ivec2 kVeiled_px{160, 90};
constexpr double kSnow_mm_h = 4.0;

/// A wall 60 m ahead, seen through a roofed passage between two walls, of one or two pieces, or none.
struct Veiled : testing::Test {
  std::unique_ptr<Context> context = makeHeadlessContext(true);
  Target target{*context, kVeiled_px};

  /// From the eye to the shelter, and where it ends.
  struct Piece {
    float from_m, to_m;
  };

  static Scene passage(const std::vector<Piece>& pieces) {
    Scene scene;
    scene.materials = {paint(glm::vec3(0.02F))};
    add(scene, box({-5, -1, -100}, {200, 0, 100}, 0));
    add(scene, box({60, 0, -8}, {61, 8, 8}, 0));
    for (const auto& [from_m, to_m] : pieces) {
      add(scene, box({from_m, 5.5F, -5}, {to_m, 6, 5}, 0));
      add(scene, box({from_m, 0, -5}, {to_m, 6, -4.5F}, 0));
      add(scene, box({from_m, 0, 4.5F}, {to_m, 6, 5}, 0));
      add(scene, box({from_m, 0.05F, -4.4F}, {to_m, 5.4F, 4.4F}, 0));
      scene.nodes.back().meaning = ShelterMeaning{"passage"};
    }
    return scene;
  }

  /// Radiance of the wall straight ahead. The light is the same for all skies of as much precipitation.
  float seen(const Scene& scene, const Sky& sky) {
    Renderer renderer{*context};
    renderer.addInstance(renderer.addScene(scene, SceneFrame::Road));
    const glm::dvec3 eye(0.0, 0.0, 1.5);
    renderer.beginFrame(sky, eye);
    renderer.drawWorld({glm::lookAt(eye, eye + glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0, 0, 1)),
                        reversedPerspective(0.6, kVeiled_px)},
                       target);
    std::vector<glm::vec4> pixels(static_cast<std::size_t>(kVeiled_px.x * kVeiled_px.y));
    context->gl().GetTextureImage(target.colour(), 0, GL_RGBA, GL_FLOAT,
                                  static_cast<GLsizei>(pixels.size() * sizeof(glm::vec4)), pixels.data());
    EXPECT_EQ(context->glErrors(), 0U);
    return pixels[static_cast<std::size_t>(kVeiled_px.x * (kVeiled_px.y / 2 + 2) + kVeiled_px.x / 2)].y;
  }

  /// How much of the wall's own light snow lets through: of its veil before nothing else is seen but it.
  double through(const std::vector<Piece>& pieces) {
    const Scene scene = passage(pieces);
    Sky clear, snow, dense;
    clear.rain_mm_h = kSnow_mm_h;  // the plugin's
    clear.visibility_m = snow.visibility_m = 1e9;
    snow.snow_mm_h = dense.snow_mm_h = kSnow_mm_h;
    dense.visibility_m = 1.0;
    const auto wall = double{seen(scene, clear)}, air = double{seen(passage({}), dense)};
    return (double{seen(scene, snow)} - air) / (wall - air);
  }

  /// Beer and Lambert's law.
  static double passed(double open_m) {
    Sky snow;
    snow.visibility_m = 1e9;
    snow.snow_mm_h = kSnow_mm_h;
    return std::exp(-extinction(snow) * open_m);
  }
  static constexpr double kRounding = 2e-3;  // half floats
};

TEST_F(Veiled, snowVeilsByTheLengthOfTheWay) { EXPECT_NEAR(through({}), passed(60.0), kRounding); }

TEST_F(Veiled, snowBeforeAShelterVeilsWhatStandsInIt) {
  EXPECT_NEAR(through({{40.0F, 60.0F}}), passed(40.0), kRounding);
}

TEST_F(Veiled, behindAShelterThereIsSnowAgain) {
  EXPECT_NEAR(through({{20.0F, 50.0F}}), passed(30.0), kRounding);
}

TEST_F(Veiled, fromWithinAShelterOnlySnowOutsideVeils) {
  EXPECT_NEAR(through({{-4.0F, 30.0F}}), passed(30.0), kRounding);
}

TEST_F(Veiled, whatLiesInTwoSheltersCountsOnce) {
  EXPECT_NEAR(through({{10.0F, 35.0F}, {25.0F, 50.0F}}), passed(20.0), kRounding);
}

}  // namespace
}  // namespace host
