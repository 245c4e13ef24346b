// update on one thread, the GL thread's calls on another, at once. Under ThreadSanitizer (scripts/test
// --tsan) every race is an error; by hand:
//   cmake --preset tsan && cmake --build --preset tsan --target test_abi
//   TSAN_OPTIONS=ignore_noninstrumented_modules=1 build/tsan/bin/test_abi --gtest_filter='Threads.*'
// The option is for the GL driver, whose own threads were not built for it.
#include <atomic>
#include <thread>

#include "gl_fixture.h"
#include "small_scene.h"

namespace rg::test {
namespace {

struct Renderbuffer {
  const GladGLContext& gl;
  GLuint framebuffer = 0, color = 0;
  explicit Renderbuffer(const GladGLContext& context) : gl(context) {
    gl.CreateRenderbuffers(1, &color);
    gl.NamedRenderbufferStorage(color, GL_RGBA16F, SmallScene::kSize_px, SmallScene::kSize_px);
    gl.CreateFramebuffers(1, &framebuffer);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  }
  ~Renderbuffer() {
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteRenderbuffers(1, &color);
  }
  Renderbuffer(const Renderbuffer&) = delete;
  Renderbuffer& operator=(const Renderbuffer&) = delete;
};

// All that a simulation may do between two updates.
void tinker(const SmallScene& scene, int step) {
  const rg_api& api = scene.api;
  rg_instance* const i = scene.instance;
  const rg_glass_drop drop{0.0, 0.0, 1e-3, 40.0};
  EXPECT_GE(api.place_drops(i, kPane, &drop, 1), 0) << api.last_error(i);
  EXPECT_GE(api.set_parameter(i, "glass.brightness", 1.0 + 0.001 * step), 0);
  if (step % 10 == 3) {
    EXPECT_GE(scene.setRoof(), 0);
  }
  if (step % 10 == 5) {
    EXPECT_GE(scene.setPane(), 0);
  }
  if (step % 10 == 7) {
    EXPECT_GE(scene.setWiper(), 0);
  }
  rg_rain_stats rain{};
  rain.struct_size = sizeof rain;
  EXPECT_GE(api.get_rain_stats(i, &rain), 0);
  rg_stage_stats stage{};
  stage.struct_size = sizeof stage;
  for (uint32_t k = 0; k < 8; ++k) EXPECT_GE(api.get_stage(i, k, &stage), 0);
  int32_t kind = 0;
  EXPECT_GE(api.get_timer_kind(i, &kind), 0);
  EXPECT_LT(api.set_parameter(i, "no.such", 1.0), 0);
  EXPECT_NE(std::string(api.last_error(i)).find("no.such"), std::string::npos) << "another thread's error";
}

class Threads : public GlTest {};

TEST_F(Threads, updateAndDrawAtOnce) {
  const PluginLibrary library;
  const rg_api& api = *library.api;
  SmallScene scene(api);
  const Renderbuffer target(gl);
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  scene.expect(scene.step());
  std::atomic<int64_t> now_ns = scene.time_ns;
  std::atomic<int64_t> drawn_ns = scene.time_ns;
  std::atomic<bool> done = false;
  rg_view view = scene.view;  // the other thread goes on changing the scene's
  std::thread simulation([&] {
    for (int step = 0; step < 100; ++step) {
      // Pictures may lie at most 1 s back: on a busy machine the simulation waits for those who draw.
      while (scene.time_ns - drawn_ns > 500'000'000) std::this_thread::yield();
      EXPECT_GE(scene.step(), 0) << api.last_error(scene.instance);
      now_ns = scene.time_ns;
      tinker(scene, step);
    }
    done = true;
  });
  const rg_target into = scene.target(target.framebuffer);
  rg_draw draw;
  api.default_draw(&draw);
  draw.view = &view;
  draw.target = &into;
  int pictures = 0;
  for (; !done || pictures < 3; ++pictures) {
    draw.time_ns = now_ns;
    EXPECT_GE(api.step_gpu(scene.instance), 0) << api.last_error(scene.instance);
    EXPECT_GE(api.draw_world(scene.instance, &draw), 0) << api.last_error(scene.instance);
    EXPECT_GE(api.draw_glass(scene.instance, &draw), 0) << api.last_error(scene.instance);
    EXPECT_EQ(api.draw_finish(scene.instance, nullptr), RG_ERROR_BAD_ARGUMENT);
    EXPECT_NE(std::string(api.last_error(scene.instance)).find("rg_draw"), std::string::npos)
        << "another thread's error";
    drawn_ns = draw.time_ns;
  }
  simulation.join();
  scene.expect(api.detach_gl(scene.instance));
}

}  // namespace
}  // namespace rg::test
