// Wet surfaces as drawn over a host's picture: where they darken, and where not.
#include "surroundings/wetness_gl.h"

#include <gtest/gtest.h>

#include <array>

#include "gl/objects.h"
#include "gl/state_guard.h"
#include "gl_fixture.h"
#include "picture.h"
#include "scene.h"
#include "shared/wet.glsl"

namespace rg::surroundings::test {
namespace {

class WetPictures : public rg::test::GlTest {
 protected:
  void SetUp() override { loaded = gl::loadContext(rg::test::GlContext::getProc, nullptr); }

  // Over white, below a black sky: what is left is what the wet ground sends back itself.
  rg::test::Picture draw(const Scene& scene, const WetnessPicture& picture, Surface surface, double strength,
                         float sky = 0.0f) {
    constexpr int kWidth = 160, kHeight = 90;
    const gl::StateGuard guard(*loaded, RG_TOUCHED_PROGRAM | RG_TOUCHED_VERTEX_ARRAY | RG_TOUCHED_BUFFERS |
                                            RG_TOUCHED_TEXTURES | RG_TOUCHED_FRAMEBUFFER |
                                            RG_TOUCHED_VIEWPORT | RG_TOUCHED_BLEND | RG_TOUCHED_DEPTH |
                                            RG_TOUCHED_RASTER | RG_TOUCHED_PIXEL_STORE);
    const gl::Texture2D colour(loaded->gl, GL_RGBA32F, kWidth, kHeight);
    gl::Texture2D deep(loaded->gl, GL_DEPTH_COMPONENT32F, kWidth, kHeight);
    const gl::Framebuffer target(loaded->gl, {&colour}, &deep);
    const float white[] = {1.0f, 1.0f, 1.0f, 0.5f};
    loaded->gl.ClearNamedFramebufferfv(target.name(), GL_COLOR, 0, white);
    const std::vector<float> stored = storedDepth(scene.views[0], kWidth, kHeight, surface);
    deep.write(0, 0, 0, 0, kWidth, kHeight, GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());
    rain::RainDraw request;
    request.view = &scene.views[0];
    request.viewport_px = {0, 0, kWidth, kHeight};
    request.target = {target.name(), colour.name(), deep.name(), kWidth, kHeight, false, 1.0f};
    request.lighting.sky_radiance = vec3(sky);
    request.lighting.ground_radiance = vec3(0.0f);
    WetnessRenderer renderer(*loaded);
    renderer.take(picture);
    renderer.draw(request, strength);
    return rg::test::readTexture(loaded->gl, colour.name());
  }

  std::unique_ptr<gl::Context> loaded;
};

// Seen from above: dry below a roof and where it keeps slanting rain off, wet up to those edges.
TEST_F(WetPictures, areDryWhereARoofKeepsTheRainOff) {
  Scene scene = sceneOnGround(50.0, {0, 0, 8.0});
  scene.views[0].eyeFromWorld =
      glm::translate(glm::lookAt(dvec3(0.0), dvec3(0, 0, -1), dvec3(0, 1, 0)), -dvec3(0, 0, 8.0));
  rain::Field field;
  ASSERT_EQ(setBox(field, 1, {0, -20, 2.0}, {1.5, 20, 3.0}), "");
  WetnessPicture picture;
  picture.water_mm = 1.0;
  picture.has_volumes = true;
  picture.fall_mps = {3.0, 0.0, -6.0};
  picture.volumes = pictureOf(scene, field).volumes;
  const auto seen = draw(scene, picture, levelGround, 1.0);
  const double px_per_m = 80.0 / std::tan(glm::radians(30.0)) / 8.0;
  // Ways slant half a metre for each: from the roof's windward foot, 2 m up, to its leeward top, 3 m up.
  for (int x = 0; x < 160; ++x) {
    const double at_m = (x + 0.5 - 80.0) / px_per_m;
    const bool is_dry = at_m > 1.0 && at_m < 3.0;
    if (std::abs(at_m - 1.0) < 0.1 || std::abs(at_m - 3.0) < 0.1) continue;
    const float wet = shared::wetAlbedoFactor() * (1.0f - shared::wetMirrors(1.0f));
    EXPECT_NEAR(seen.at(x, 45).x, is_dry ? 1.0f : wet, is_dry ? 0.0f : 0.02f) << at_m;
    EXPECT_EQ(seen.at(x, 45).w, 0.5f);
  }
}

TEST_F(WetPictures, leaveWallsSkyAndWhatNobodyAskedForAsTheyAre) {
  Scene scene = sceneOnGround(50.0);
  WetnessPicture picture;
  picture.water_mm = 1.0;
  picture.has_volumes = true;
  const auto lowest = [](const rg::test::Picture& p) {
    float least = 1.0f;
    for (const glm::vec4& pixel : p.pixels) least = std::min(least, pixel.x);
    return least;
  };
  EXPECT_EQ(lowest(draw(scene, picture, wallAt2m, 1.0)), 1.0f);
  EXPECT_EQ(lowest(draw(scene, picture, levelGround, 0.0)), 1.0f);
  EXPECT_LT(lowest(draw(scene, picture, levelGround, 1.0)), 0.7f);
  EXPECT_EQ(draw(scene, picture, levelGround, 1.0).at(80, 80).x, 1.0f);
  // Lekner & Dorf's table: of an albedo of 0.20 0.127 is left.
  EXPECT_NEAR(shared::wetAlbedoFactor(), 0.127f / 0.2f, 0.005f);
}

// From the first drops on it darkens ever more, and only then, as the texture fills, does it mirror the sky;
// without steps. Where volumes are not told yet nothing is drawn, as what they shelter would be wet.
TEST_F(WetPictures, darkenFirstAndShineAsWaterGathers) {
  const Scene scene = sceneOnGround(50.0);
  const auto mean = [&](double water_mm, float sky, bool has_volumes = true) {
    WetnessPicture picture;
    picture.water_mm = water_mm;
    picture.has_volumes = has_volumes;
    const auto seen = draw(scene, picture, levelGround, 1.0, sky);
    double all = 0.0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 160; ++x) all += static_cast<double>(seen.at(x, y).x) / (160 * 40);
    }
    return all;
  };
  constexpr std::array kWater_mm = {0.0, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0};
  double before = 1.0, mirrored = 0.0, first_gloss = 0.0, gloss = 0.0;
  for (const double water_mm : kWater_mm) {
    const double dark = mean(water_mm, 0.0f), shine = mean(water_mm, 1.0f) - dark;
    EXPECT_LE(dark, before);
    EXPECT_GE(dark, before - 0.15);
    EXPECT_GE(shine, mirrored);
    before = dark;
    mirrored = shine;
    if (water_mm > 0.0) gloss = shine / (1.0 - dark);
    if (first_gloss == 0.0) first_gloss = gloss;
  }
  EXPECT_GT(first_gloss, 0.0);
  EXPECT_GT(gloss, 1.5 * first_gloss);
  EXPECT_NEAR(mean(1.0, 1.0f, false), 1.0, 1e-9);
}

// The host's world is moved under it: patches stay on the ground they are on. And far off, where pixels are
// larger than patches, there are none to flicker.
TEST_F(WetPictures, havePatchesThatStayWhenTheOriginMovesAndFadeFarOff) {
  const dvec3 shift_m(1234.5, -777.25, 0.0), eye(0, 0, 1.5);
  Scene scene = sceneOnGround(5.0, eye), moved = sceneOnGround(5.0, eye - shift_m);
  WetnessPicture picture;
  picture.water_mm = 0.1;
  picture.has_volumes = true;
  const auto before = draw(scene, picture, levelGround, 1.0);
  picture.origin_m -= shift_m;
  const auto after = draw(moved, picture, levelGround, 1.0);
  for (size_t i = 0; i < before.pixels.size(); ++i)
    ASSERT_NEAR(before.pixels[i].x, after.pixels[i].x, 1e-3f);  // of 0.05 by which patches differ
  const auto spread = [&](int y) {
    float least = 1.0f, most = 0.0f;
    for (int x = 0; x < 160; ++x) {
      least = std::min(least, before.at(x, y).x);
      most = std::max(most, before.at(x, y).x);
    }
    return most - least;
  };
  EXPECT_GT(spread(2), 0.05f);
  EXPECT_LT(spread(35), 0.01f);  // 12 m off, where a pixel is a metre long
}

}  // namespace
}  // namespace rg::surroundings::test
