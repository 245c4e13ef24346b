// Streaks as drawn: energy, depth, the target's alpha, and clean GL. RG_RAIN_PICTURES=DIR writes pictures to
// look at.
#include <gtest/gtest.h>

#include <cstdlib>

#include "gl/objects.h"
#include "gl/state_guard.h"
#include "gl_fixture.h"
#include "picture.h"
#include "rain/rain_gl.h"
#include "scene.h"

namespace rg::rain::test {
namespace {

constexpr uint32_t kTouches = RG_TOUCHED_PROGRAM | RG_TOUCHED_VERTEX_ARRAY | RG_TOUCHED_BUFFERS |
                              RG_TOUCHED_TEXTURES | RG_TOUCHED_FRAMEBUFFER | RG_TOUCHED_VIEWPORT |
                              RG_TOUCHED_BLEND | RG_TOUCHED_DEPTH | RG_TOUCHED_RASTER;

// A plain grey sky over darker ground, with rain before it.
class StreakPicture : public rg::test::GlTest {
 protected:
  void SetUp() override { loaded = gl::loadContext(rg::test::GlContext::getProc, nullptr); }

  // Ticks a fresh field for two seconds and draws it.
  rg::test::Picture draw(double rain_mm_h, double speed_mps, int width, int height, float gain,
                         float depth = 1.0f, bool soft = true) {
    Field field({.capacity = 200000, .seed = 5});
    Scene scene = sceneWithView(rain_mm_h);
    for (; scene.index < 240; ++scene.index) {
      scene.views[0].eye_velocity_mps = {speed_mps, 0, 0};
      look(scene.views[0], {speed_mps * static_cast<double>(scene.index) * kTickSeconds, 0, 1.5}, 0.0);
      field.tick(scene.tick());
    }
    const gl::StateGuard guard(*loaded, kTouches);
    Upload upload;
    field.publish(upload);
    RainRenderer renderer(*loaded, 200000);
    renderer.upload(upload);
    const gl::Texture2D colour(loaded->gl, GL_RGBA32F, width, height),
        deep(loaded->gl, GL_DEPTH_COMPONENT32F, width, height);
    const gl::Framebuffer target(loaded->gl, {&colour}, &deep);
    paint(target.name(), width, height, depth);
    RainDraw request;
    request.view = &scene.views[0];
    request.viewport_px = {0, 0, width, height};
    request.time_ns = tickTimeNs(scene.index - 1);
    request.target = {target.name(), soft ? colour.name() : 0, soft ? deep.name() : 0, width, height, false,
                      1.0f};
    request.lighting.sky_radiance = glm::vec3(0.8f);
    request.lighting.ground_radiance = glm::vec3(0.25f);
    if (gain > 0.0f) request.gain = gain;
    renderer.draw(request);
    return rg::test::readTexture(loaded->gl, colour.name());
  }

  void paint(GLuint framebuffer, int width, int height, float depth) {
    const float ground[] = {0.12f, 0.13f, 0.12f, 0.5f}, sky[] = {0.55f, 0.58f, 0.62f, 0.5f};
    const GladGLContext& g = loaded->gl;
    g.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    g.DepthMask(GL_TRUE);
    g.Enable(GL_SCISSOR_TEST);
    g.Scissor(0, 0, width, height / 2);
    g.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, ground);
    g.Scissor(0, height / 2, width, height - height / 2);
    g.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, sky);
    g.Disable(GL_SCISSOR_TEST);
    g.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &depth);
  }

  // Mean brightness added over the ground, where drops are brighter than what is behind them.
  static double addedOverGround(const rg::test::Picture& picture) {
    double sum = 0.0;
    const int rows = picture.height / 2 - 1;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < picture.width; ++x) sum += static_cast<double>(picture.at(x, y).x - 0.12f);
    }
    return sum / (static_cast<double>(rows) * picture.width);
  }

  std::unique_ptr<gl::Context> loaded;
};

TEST_F(StreakPicture, addsTheSameBrightnessAtEveryResolution) {
  const double small = addedOverGround(draw(25, 0, 320, 180, 1)),
               large = addedOverGround(draw(25, 0, 1280, 720, 1));
  EXPECT_GT(large, 1e-4);
  EXPECT_NEAR(small, large, 0.05 * large);
}

TEST_F(StreakPicture, isHiddenByWhatIsBeforeIt) {
  for (const bool soft : {true, false}) {
    EXPECT_NEAR(addedOverGround(draw(25, 0, 320, 180, 6, 0.0f, soft)), 0.0, 1e-7);
    EXPECT_GT(addedOverGround(draw(25, 0, 320, 180, 6, 1.0f, soft)), 1e-4);
  }
}

TEST_F(StreakPicture, leavesTheTargetsAlpha) {
  const auto picture = draw(50, 0, 320, 180, 6);
  for (const glm::vec4& pixel : picture.pixels) ASSERT_EQ(pixel.w, 0.5f);
}

TEST_F(StreakPicture, canBeLookedAt) {
  const char* folder = std::getenv("RG_RAIN_PICTURES");
  if (folder == nullptr) GTEST_SKIP() << "set RG_RAIN_PICTURES to a folder";
  for (const int rate : {5, 25, 50}) {
    for (const int kmh : {0, 100}) {
      auto picture = draw(rate, kmh * kKmh, 1280, 720, 0);
      for (glm::vec4& p : picture.pixels) p = glm::vec4(glm::pow(glm::vec3(p), glm::vec3(1 / 2.2f)), 1.0f);
      ASSERT_TRUE(
          writePpm(std::string(folder) + "/rain_" + std::to_string(rate) + "_" + std::to_string(kmh) + ".ppm",
                   picture));
    }
  }
}

}  // namespace
}  // namespace rg::rain::test
