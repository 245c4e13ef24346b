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

  // A field that has rained for two seconds, and its last moment.
  struct Rain {
    Rain(double rain_mm_h, double speed_mps) : scene(sceneWithView(rain_mm_h)), speed(speed_mps) {
      while (scene.index < 240) tick();
      field.publishAll(upload);
    }
    void tick() {
      scene.views[0].eye_velocity_mps = {speed, 0, 0};
      look(scene.views[0], {speed * static_cast<double>(scene.index) * kTickSeconds, 0, 1.5}, 0.0);
      field.tick(scene.tick());
      ++scene.index;
    }
    int64_t lastTime_ns() const { return tickTimeNs(scene.index - 1); }
    Field field{{.capacity = 200000, .seed = 5}};
    Scene scene;
    double speed;
    Upload upload;
  };

  struct Shown {
    int width = 320, height = 180;
    float gain = 6.0f;
    float depth = 1.0f;
    bool soft = true;
  };

  rg::test::Picture draw(const Rain& rain, const Shown& shown) {
    const gl::StateGuard guard(*loaded, kTouches);
    Upload upload = rain.upload;
    RainRenderer renderer(*loaded, 200000);
    renderer.upload(upload);
    return draw(renderer, rain.scene.views[0], rain.lastTime_ns(), shown);
  }

  // Within a guard.
  rg::test::Picture draw(RainRenderer& renderer, const ViewState& view, int64_t time_ns, const Shown& shown) {
    const gl::Texture2D colour(loaded->gl, GL_RGBA32F, shown.width, shown.height),
        deep(loaded->gl, GL_DEPTH_COMPONENT32F, shown.width, shown.height);
    const gl::Framebuffer target(loaded->gl, {&colour}, &deep);
    paint(target.name(), shown.width, shown.height, shown.depth);
    RainDraw request;
    request.view = &view;
    request.viewport_px = {0, 0, shown.width, shown.height};
    request.time_ns = time_ns;
    request.target = {target.name(),
                      shown.soft ? colour.name() : 0,
                      shown.soft ? deep.name() : 0,
                      shown.width,
                      shown.height,
                      false,
                      1.0f};
    request.lighting.sky_radiance = glm::vec3(0.8f);
    request.lighting.ground_radiance = glm::vec3(0.25f);
    request.gain = shown.gain;
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

// From where hardly a drop is as wide as a pixel to where most near ones are, at a camera's gain and at a
// driver's. To 2 %: at 160 x 90 what is seen of streaks at the picture's rim is cut by pixels as large as
// they.
TEST_F(StreakPicture, addsTheSameBrightnessAtEveryResolution) {
  for (const double rate_mm_h : {5.0, 50.0}) {
    const Rain rain(rate_mm_h, 0.0);
    for (const float gain : {1.0f, 6.0f}) {
      const double largest = addedOverGround(draw(rain, {.width = 1920, .height = 1080, .gain = gain}));
      EXPECT_GT(largest, 1e-5);
      for (const int height : {90, 360}) {
        const Shown shown{.width = height * 16 / 9, .height = height, .gain = gain};
        EXPECT_NEAR(addedOverGround(draw(rain, shown)), largest, 0.02 * largest)
            << height << " lines, " << rate_mm_h << " mm/h, gain " << gain;
      }
    }
  }
}

// What is exposed is the view's to say: pictures of the same moments are the same, whatever was drawn in
// between, and on average all are alike (to 5 %: each frame's nearest drops are others).
TEST_F(StreakPicture, looksTheSameAt30And60And240FramesASecond) {
  constexpr int kMoments = 8;  // common to all, a thirtieth of a second apart
  std::vector<rg::test::Picture> first;
  double first_mean = 0.0;
  for (const int fps : {30, 60, 240}) {
    Rain rain(25.0, 10.0);
    const gl::StateGuard guard(*loaded, kTouches);
    RainRenderer renderer(*loaded, 200000);
    const int64_t from_ns = rain.lastTime_ns();
    const int frames = kMoments * fps / 30;
    double mean = 0.0;
    for (int i = 0; i < frames; ++i) {
      const int64_t time_ns = from_ns + i * INT64_C(1'000'000'000) / fps;
      while (tickTimeNs(rain.scene.index) <= time_ns) rain.tick();
      rain.field.publish(rain.upload);
      renderer.upload(rain.upload);
      const auto picture = draw(renderer, rain.scene.views[0], time_ns, {.width = 160, .height = 90});
      mean += addedOverGround(picture) / frames;
      if (i % (fps / 30) != 0) continue;
      const auto moment = static_cast<size_t>(i / (fps / 30));
      if (fps == 30) first.push_back(picture);
      EXPECT_EQ(rg::test::greatestDifference(picture, first[moment]), 0.0f)
          << fps << " Hz, moment " << moment;
    }
    if (fps == 30) first_mean = mean;
    EXPECT_GT(mean, 1e-5);
    EXPECT_NEAR(mean, first_mean, 0.05 * first_mean) << fps;
  }
}

// On a GPU, and where lines may not be wide, all streaks are rectangles. What of each pixel is covered is the
// same; only at the very ends and sides, where next to nothing is, a line may leave out a pixel that a
// rectangle holds, or the other way round.
TEST_F(StreakPicture, isTheSameOfLinesAndOfRectangles) {
  const Rain rain(50.0, 10.0);
  const auto of_lines = draw(rain, {.width = 640, .height = 360});
  const auto getFloats = loaded->gl.GetFloatv;
  static PFNGLGETFLOATVPROC true_get = nullptr;
  true_get = getFloats;
  loaded->gl.GetFloatv = [](GLenum name, GLfloat* values) {
    true_get(name, values);
    if (name == GL_ALIASED_LINE_WIDTH_RANGE) values[1] = 1.0f;
  };
  const auto of_rectangles = draw(rain, {.width = 640, .height = 360});
  loaded->gl.GetFloatv = getFloats;
  const double difference = rg::test::greatestDifference(of_lines, of_rectangles);
  EXPECT_EQ(difference > 0.0, loaded->software);  // else there were no lines
  EXPECT_LT(difference, 0.01);
  EXPECT_NEAR(addedOverGround(of_lines), addedOverGround(of_rectangles), 2e-3 * addedOverGround(of_lines));
}

TEST_F(StreakPicture, isTheSameForTheSameDrops) {
  const Rain rain(50.0, 10.0);
  EXPECT_EQ(rg::test::greatestDifference(draw(rain, {}), draw(rain, {})), 0.0f);
}

// New records wait for the next draw, or for the next upload where nothing was drawn.
TEST_F(StreakPicture, isTheSameHoweverItsDropsCame) {
  Rain rain(50.0, 10.0);
  const gl::StateGuard guard(*loaded, kTouches);
  RainRenderer by_ticks(*loaded, 200000), at_once(*loaded, 200000);
  by_ticks.upload(rain.upload);
  const ViewState& view = rain.scene.views[0];
  for (const bool drawn : {false, false, true, true, false}) {
    for (int i = 0; i < 3; ++i) rain.tick();
    rain.field.publish(rain.upload);
    by_ticks.upload(rain.upload);
    if (drawn) draw(by_ticks, view, rain.lastTime_ns(), {});
  }
  rain.field.publishAll(rain.upload);
  at_once.upload(rain.upload);
  const auto of_ticks = draw(by_ticks, view, rain.lastTime_ns(), {});
  EXPECT_EQ(rg::test::greatestDifference(of_ticks, draw(at_once, view, rain.lastTime_ns(), {})), 0.0f);
  EXPECT_GT(addedOverGround(of_ticks), 1e-5);
}

TEST_F(StreakPicture, isHiddenByWhatIsBeforeIt) {
  const Rain rain(25.0, 0.0);
  for (const bool soft : {true, false}) {
    EXPECT_NEAR(addedOverGround(draw(rain, {.depth = 0.0f, .soft = soft})), 0.0, 1e-7);
    EXPECT_GT(addedOverGround(draw(rain, {.depth = 1.0f, .soft = soft})), 1e-4);
  }
}

TEST_F(StreakPicture, leavesTheTargetsAlpha) {
  const auto picture = draw(Rain(50.0, 0.0), {});
  for (const glm::vec4& pixel : picture.pixels) ASSERT_EQ(pixel.w, 0.5f);
}

TEST_F(StreakPicture, canBeLookedAt) {
  const char* folder = std::getenv("RG_RAIN_PICTURES");
  if (folder == nullptr) GTEST_SKIP() << "set RG_RAIN_PICTURES to a folder";
  for (const int rate : {5, 25, 50}) {
    for (const int kmh : {0, 100}) {
      auto picture = draw(Rain(rate, kmh * kKmh), {.width = 1280, .height = 720});
      for (glm::vec4& p : picture.pixels) p = glm::vec4(glm::pow(glm::vec3(p), glm::vec3(1 / 2.2f)), 1.0f);
      ASSERT_TRUE(
          writePpm(std::string(folder) + "/rain_" + std::to_string(rate) + "_" + std::to_string(kmh) + ".ppm",
                   picture));
    }
  }
}

}  // namespace
}  // namespace rg::rain::test
