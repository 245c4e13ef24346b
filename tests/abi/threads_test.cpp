// update on one thread, the GL thread's calls on another, at once; and instances each on a thread of their
// own. Under ThreadSanitizer (scripts/test --tsan) every race is an error; by hand:
//   cmake --preset tsan && cmake --build --preset tsan --target test_abi
//   TSAN_OPTIONS=ignore_noninstrumented_modules=1 build/tsan/bin/test_abi --gtest_filter='Threads.*'
// The option is for the GL driver, whose own threads were not built for it.
#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "gl_fixture.h"
#include "saved_scene.h"

namespace rg::test {
namespace {

// A picture with depth, both as textures, so that rain makes what is in it wet and drops dissolve before it.
struct Textures {
  const GladGLContext& gl;
  GLuint framebuffer = 0, color = 0, depth = 0;
  explicit Textures(const GladGLContext& context) : gl(context) {
    constexpr int kSize_px = SmallScene::kSize_px;
    gl.CreateTextures(GL_TEXTURE_2D, 1, &color);
    gl.TextureStorage2D(color, 1, GL_RGBA16F, kSize_px, kSize_px);
    gl.CreateTextures(GL_TEXTURE_2D, 1, &depth);
    gl.TextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, kSize_px, kSize_px);
    gl.CreateFramebuffers(1, &framebuffer);
    gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
    gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
    const float ground = Habits{}.storedDepth(20.0);
    gl.ClearTexImage(depth, 0, GL_DEPTH_COMPONENT, GL_FLOAT, &ground);
  }
  ~Textures() {
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(1, &color);
    gl.DeleteTextures(1, &depth);
  }
  Textures(const Textures&) = delete;
  Textures& operator=(const Textures&) = delete;
  rg_target of(const SmallScene& scene) const {
    rg_target target = scene.target(framebuffer);
    target.color_texture = color;
    target.depth_texture = depth;
    return target;
  }
};

// `scene` goes on by 100 frames on a thread of its own, `between` after each; meanwhile this thread makes
// pictures of its newest moment, at least three.
void atOnce(SavedScene& scene, const std::function<void(int step)>& between,
            const std::function<void(int64_t moment_ns)>& picture) {
  std::atomic<int64_t> now_ns = scene.time_ns, drawn_ns = scene.time_ns;
  std::atomic<bool> done = false;
  std::thread simulation([&] {
    for (int step = 0; step < 100; ++step) {
      // Pictures may lie at most 1 s back: on a busy machine the simulation waits for those who draw.
      while (scene.time_ns - drawn_ns > 500'000'000) std::this_thread::yield();
      EXPECT_NO_THROW(scene.frame());
      now_ns = scene.time_ns;
      between(step);
    }
    done = true;
  });
  for (int pictures = 0; !done || pictures < 3; ++pictures) {
    const int64_t moment_ns = now_ns;
    picture(moment_ns);
    drawn_ns = moment_ns;
  }
  simulation.join();
}

void setPattern(const SmallScene& scene, int step) {
  const std::vector<uint8_t> rgba(size_t{4} * 8 * 8, static_cast<uint8_t>(100 + step));
  rg_rain_pattern pattern;
  scene.api.default_rain_pattern(&pattern);
  pattern.width_px = pattern.height_px = 8;
  pattern.rgba = rgba.data();
  EXPECT_GE(scene.api.set_rain_pattern(scene.instance, &pattern), 0) << scene.api.last_error(scene.instance);
}

// All that a simulation may do between two updates.
void tinker(const SmallScene& scene, int step) {
  const rg_api& api = scene.api;
  rg_instance* const i = scene.instance;
  setPattern(scene, step);
  const rg_glass_drop drop{0.0, 0.0, 1e-3, 40.0};
  EXPECT_GE(api.place_drops(i, kPane, &drop, 1), 0) << api.last_error(i);
  EXPECT_GE(api.set_parameter(i, "glass.brightness", 1.0 + 0.001 * step), 0);
  EXPECT_GE(api.set_parameter(i, "glass.threads", step % 20 < 10 ? 2.0 : 1.0), 0);
  if (step % 10 == 2) {
    const rg_wash_info jet = scene.jet();
    EXPECT_GE(api.wash(i, &jet), 0) << api.last_error(i);
  }
  if (step % 10 == 3) {
    EXPECT_GE(scene.setRoof(), 0);
  }
  if (step % 10 == 4) {
    rg_airflow airflow;
    api.default_airflow(&airflow);
    airflow.lee = 0.01 * step;
    EXPECT_GE(api.set_airflow(i, kPane, &airflow), 0) << api.last_error(i);
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
  uint32_t stages = 0;
  EXPECT_GE(api.get_stage_count(i, &stages), 0);
  for (uint32_t k = 0; k < stages; ++k) EXPECT_GE(api.get_stage(i, k, &stage), 0);
  int32_t kind = 0;
  EXPECT_GE(api.get_timer_kind(i, &kind), 0);
  EXPECT_LT(api.set_parameter(i, "no.such", 1.0), 0);
  EXPECT_NE(std::string(api.last_error(i)).find("no.such"), std::string::npos) << "another thread's error";
}

// What is behind the glass: nothing but the ground's colour.
void drawGround(void* user, uint32_t framebuffer, int32_t, int32_t, const double*, const double*) {
  const float grey[4] = {0.5f, 0.5f, 0.5f, 1.0f};
  static_cast<const GladGLContext*>(user)->ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, grey);
}

class Threads : public GlTest {
 protected:
  PluginLibrary library;
  const rg_api& api = *library.api;
};

TEST_F(Threads, updateAndDrawAtOnce) {
  SavedScene scene(api);
  for (const char* name : {"wetness.strength", "glow.strength"})
    scene.expect(api.set_parameter(scene.instance, name, 1.0));
  scene.expect(api.set_parameter(scene.instance, "glass.pupil_m", 0.004));
  const Textures textures(gl);
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  scene.expect(scene.step());
  const rg_view view = scene.view;  // the other thread goes on changing the scene's
  const rg_target into = textures.of(scene);
  rg_draw draw;
  api.default_draw(&draw);
  draw.view = &view;
  draw.target = &into;
  rg_capture_info capture;
  api.default_capture_info(&capture);
  capture.draw_scene = drawGround;
  capture.user = &gl;
  capture.view = &view;
  const auto expectDone = [&](rg_result result) { EXPECT_GE(result, 0) << api.last_error(scene.instance); };
  atOnce(
      scene, [&](int step) { tinker(scene, step); },
      [&](int64_t moment_ns) {
        draw.time_ns = moment_ns;
        expectDone(api.step_gpu(scene.instance));
        expectDone(api.prepare_captures(scene.instance, &capture));
        expectDone(api.draw_world(scene.instance, &draw));
        expectDone(api.draw_glass(scene.instance, &draw));
        expectDone(api.draw_finish(scene.instance, &draw));
        EXPECT_EQ(api.draw_finish(scene.instance, nullptr), RG_ERROR_BAD_ARGUMENT);
        EXPECT_NE(std::string(api.last_error(scene.instance)).find("rg_draw"), std::string::npos)
            << "another thread's error";
      });
  scene.expect(api.detach_gl(scene.instance));
}

TEST_F(Threads, glComesAndGoesWhileItUpdates) {
  SavedScene scene(api);
  scene.expect(scene.step());
  atOnce(
      scene, [&](int step) { tinker(scene, step); },
      [&](int64_t) {
        EXPECT_EQ(scene.attach(GlContext::getProc), RG_OK) << api.last_error(scene.instance);
        for (int i = 0; i < 3; ++i) {
          EXPECT_GE(api.step_gpu(scene.instance), 0) << api.last_error(scene.instance);
        }
        EXPECT_GE(api.detach_gl(scene.instance), 0) << api.last_error(scene.instance);
      });
}

// Two panes with a pillar between them, both with their films.
TEST_F(Threads, ofAnInstancesOwnChangeNothing) {
  SavedScene alone(api), shared(api);
  shared.expect(api.set_parameter(shared.instance, "glass.threads", 3.0));
  for (SavedScene* scene : {&alone, &shared}) ASSERT_EQ(scene->attach(GlContext::getProc), RG_OK);
  for (int frame = 0; frame < 90; ++frame) {
    for (SavedScene* scene : {&alone, &shared}) scene->drive(1, frame % 7 == 0);
    if (frame == 60) shared.expect(api.set_parameter(shared.instance, "glass.threads", 1.0));
    ASSERT_EQ(shared.hash(), alone.hash()) << "frame " << frame;
  }
  // Ticks wait for what the GPU does not tell, and for each other's.
  for (SavedScene* scene : {&alone, &shared}) {
    for (int frame = 0; frame < 40; ++frame) scene->frame();
    scene->expect(api.step_gpu(scene->instance));
  }
  EXPECT_EQ(shared.hash(), alone.hash());
  EXPECT_TRUE(shared.save() == alone.save());
  EXPECT_GT(shared.stats(kPane).run_on_ml + shared.stats(kWindow).run_on_ml, 0.0)
      << "nothing came round the pillar";
  for (SavedScene* scene : {&alone, &shared}) scene->expect(api.detach_gl(scene->instance));
}

size_t threadsOfThisProcess() {
  const std::filesystem::directory_iterator tasks("/proc/self/task"), end;
  return static_cast<size_t>(std::distance(tasks, end));
}

// One that has ended may be listed for a moment yet.
void expectThreads(size_t count) {
  for (int wait = 0; wait < 1000 && threadsOfThisProcess() != count; ++wait)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(threadsOfThisProcess(), count);
}

TEST_F(Threads, ofAnInstancesOwnAreAsManyAsAskedForAndGoWithIt) {
  const size_t before = threadsOfThisProcess();
  {
    SavedScene scene(api);
    for (const size_t threads : {0u, 3u, 1u, 2u}) {
      scene.expect(api.set_parameter(scene.instance, "glass.threads", static_cast<double>(threads)));
      scene.frame();
      expectThreads(before + threads);
    }
  }
  expectThreads(before);
}

// They are of the machine that it runs on.
TEST_F(Threads, ofAnInstancesOwnAreNoPartOfItsState) {
  SavedScene with(api), without(api);
  with.expect(api.set_parameter(with.instance, "glass.threads", 2.0));
  for (SavedScene* scene : {&with, &without}) scene->frame();
  const Bytes saved = with.save();
  EXPECT_TRUE(saved == without.save());
  without.expect(api.set_parameter(without.instance, "glass.threads", 1.0));
  without.expect(without.restore(saved));
  const auto threads = [&](const SavedScene& scene) {
    uint32_t count = 0;
    scene.expect(api.get_parameter_count(scene.instance, &count));
    for (uint32_t i = 0; i < count; ++i) {
      rg_parameter parameter;
      parameter.struct_size = sizeof parameter;
      scene.expect(api.get_parameter(scene.instance, i, &parameter));
      if (std::string_view(parameter.name) == "glass.threads") return parameter.value;
    }
    return -1.0;
  };
  EXPECT_EQ(threads(without), 1.0);
}

TEST_F(Threads, instancesDoNotKnowOfEachOther) {
  const auto hashAfter = [&](int steps) {
    SavedScene scene(api);
    for (int i = 0; i < steps; ++i) scene.frame();
    return scene.hash();
  };
  const uint64_t alone = hashAfter(60);
  uint64_t first = 0, second = 0;
  std::thread other([&] { second = hashAfter(60); });
  first = hashAfter(60);
  other.join();
  EXPECT_EQ(first, alone);
  EXPECT_EQ(second, alone);
}

}  // namespace
}  // namespace rg::test
