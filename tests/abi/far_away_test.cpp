// A host 1000 km from its world's origin, with reversed infinite depth and clip space from 0 to 1, sees what
// one at the origin with OpenGL's own depth sees: the same rain, the same drops on its pane.
#include <gtest/gtest.h>

#include "gl_fixture.h"
#include "picture.h"
#include "small_scene.h"

namespace rg::test {
namespace {

constexpr int kSize_px = SmallScene::kSize_px;
constexpr double kNear_m = 1.5, kFar_m = 400.0;  // where a wall may stand: all but a few drops are between

class FarAway : public GlTest {
 protected:
  FarAway() {
    gl.CreateTextures(GL_TEXTURE_2D, 1, &color);
    gl.CreateTextures(GL_TEXTURE_2D, 1, &depth);
    gl.TextureStorage2D(color, 1, GL_RGBA16F, kSize_px, kSize_px);
    gl.TextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, kSize_px, kSize_px);
    gl.CreateFramebuffers(1, &framebuffer);
    gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
    gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
  }
  ~FarAway() override {
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(1, &color);
    gl.DeleteTextures(1, &depth);
  }

  // Sky, and on the left a wall that fills its half. `soft`: the plugin may read the depth; else it is
  // tested.
  Picture draw(const Habits& habits, bool soft, double wall_m = kNear_m, double rain_mm_h = 100.0,
               double beyond = 1.0) const {
    SmallScene scene(*plugin.api, 20000, habits);
    scene.rain_mm_h = rain_mm_h;
    scene.expect(scene.attach(GlContext::getProc));
    scene.expect(scene.api.set_parameter(scene.instance, "rain.gain", 12.0));  // there is more to compare
    scene.expect(scene.api.set_parameter(scene.instance, "rain.beyond", beyond));
    const std::array<rg_glass_drop, 3> drops{
        {{0.0, 0.0, 0.02, 60.0}, {0.1, 0.05, 0.01, 50.0}, {-0.1, -0.08, 0.015, 70.0}}};
    scene.expect(scene.api.place_drops(scene.instance, kPane, drops.data(), 3));
    for (int i = 0; i < 30; ++i) {
      scene.expect(scene.step());
      scene.expect(scene.api.step_gpu(scene.instance));
    }
    // A GPU that is busy elsewhere lags behind: the pane is compared when it has come to the last tick.
    uint64_t hash = 0;
    scene.expect(scene.api.get_hash(scene.instance, RG_HASH_STATE, &hash));
    const std::array<float, 4> sky{0.2f, 0.25f, 0.3f, 1.0f}, wall{0.3f, 0.25f, 0.2f, 1.0f};
    const float farthest = habits.farthest(), at_wall = habits.storedDepth(wall_m);
    gl.ClearTexImage(color, 0, GL_RGBA, GL_FLOAT, sky.data());
    gl.ClearTexImage(depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farthest);
    constexpr int kHalf_px = kSize_px / 2;
    gl.ClearTexSubImage(color, 0, 0, 0, 0, kHalf_px, kSize_px, 1, GL_RGBA, GL_FLOAT, wall.data());
    gl.ClearTexSubImage(depth, 0, 0, 0, 0, kHalf_px, kSize_px, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &at_wall);
    rg_target target = scene.target(framebuffer);
    if (soft) {
      target.color_texture = color;
      target.depth_texture = depth;
    }
    scene.expect(scene.draw(scene.api.draw_world, target));
    scene.expect(scene.draw(scene.api.draw_glass, target));
    scene.expect(scene.draw(scene.api.draw_finish, target));
    scene.expect(scene.api.detach_gl(scene.instance));
    return readTexture(gl, color);
  }

  PluginLibrary plugin;
  GLuint color = 0, depth = 0, framebuffer = 0;
};

constexpr float kGreyLevel = 1.0f / 255.0f;

// Pixels of columns [from, to) that rain changed so that it is seen.
int wetPixels(const Picture& rain, const Picture& dry, int from, int to) {
  int count = 0;
  for (int y = 0; y < kSize_px; ++y) {
    for (int x = from; x < to; ++x) count += glm::distance(rain.at(x, y), dry.at(x, y)) > kGreyLevel ? 1 : 0;
  }
  return count;
}

TEST_F(FarAway, thePicturesAreTheSame) {
  const Habits near, far{.origin_m = 1000000.3, .reversed = true};
  for (const bool soft : {false, true}) {
    EXPECT_LE(greatestDifference(draw(far, soft), draw(near, soft)), kGreyLevel) << "soft " << soft;
    // Of drops alone: the veil of far rain changes every pixel.
    const Picture wet = draw(near, soft, kNear_m, 100.0, 0.0), dry = draw(near, soft, kNear_m, 0.0),
                  behind = draw(near, soft, kFar_m, 100.0, 0.0);
    EXPECT_LE(greatestDifference(draw(far, soft, kNear_m, 100.0, 0.0), wet), kGreyLevel) << "soft " << soft;
    EXPECT_GT(wetPixels(wet, dry, kSize_px / 2, kSize_px), 500) << "too little rain to compare";
    EXPECT_LT(3 * wetPixels(wet, dry, 0, kSize_px / 2), 2 * wetPixels(behind, dry, 0, kSize_px / 2))
        << "the wall hides little of the rain behind it";
  }
}

}  // namespace
}  // namespace rg::test
