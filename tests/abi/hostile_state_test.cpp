// The host's state through the real calls: whatever is set, each call leaves it as it found it, and draws the
// same.
#include <gtest/gtest.h>

#include <functional>

#include "gl/pending_error.h"
#include "gl_fixture.h"
#include "odd_state.h"
#include "picture.h"
#include "small_scene.h"
#include "state_snapshot.h"

namespace rg::test {
namespace {

struct Call {
  const char* name;
  rg_result (*make)(SmallScene&, const rg_target&);
};

void captureScene(void* user, uint32_t framebuffer, int32_t, int32_t, const double*, const double*) {
  const auto& gl = *static_cast<const GladGLContext*>(user);
  const float grey[4] = {0.5f, 0.5f, 0.5f, 1.0f};
  gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, grey);
}

const GladGLContext* callback_gl = nullptr;

rg_result prepareCaptures(SmallScene& scene, const rg_target&) {
  rg_capture_info info;
  scene.api.default_capture_info(&info);
  info.draw_scene = captureScene;
  info.user = const_cast<GladGLContext*>(callback_gl);
  info.view = &scene.view;
  return scene.api.prepare_captures(scene.instance, &info);
}

const Call kCalls[] = {
    {"step_gpu", [](SmallScene& s, const rg_target&) { return s.api.step_gpu(s.instance); }},
    {"prepare_captures", prepareCaptures},
    {"draw_world",
     [](SmallScene& s, const rg_target& t) {
       s.expect(s.api.set_parameter(s.instance, "wetness.strength", 1.0));
       return s.draw(s.api.draw_world, t);
     }},
    {"draw_glass",
     [](SmallScene& s, const rg_target& t) {
       s.expect(s.api.set_parameter(s.instance, "glass.pupil_m", 0.004));
       return s.draw(s.api.draw_glass, t);
     }},
    {"draw_finish",
     [](SmallScene& s, const rg_target& t) {
       s.expect(s.api.set_parameter(s.instance, "glow.strength", 1.0));
       return s.draw(s.api.draw_finish, t);
     }},
    {"get_pane_stats",
     [](SmallScene& s, const rg_target&) {
       rg_pane_stats stats{};
       stats.struct_size = sizeof stats;
       return s.api.get_pane_stats(s.instance, kPane, &stats);
     }},
    {"get_hash",
     [](SmallScene& s, const rg_target&) {
       uint64_t hash = 0;
       return s.api.get_hash(s.instance, RG_HASH_STATE, &hash);
     }},
};

class HostileStateAbi : public GlProfileTest {
 protected:
  HostileStateAbi() : odd(gl, GetParam()), loaded(gl::loadContext(GlContext::getProc, nullptr)) {
    callback_gl = &gl;
  }

  // Makes a call with everything odd and an error pending, and compares.
  void expectKept(const char* name, size_t variant, const std::function<rg_result()>& call) {
    odd.resetDrawBuffers();
    odd.apply(variant);
    gl::raiseError(*loaded, GL_INVALID_VALUE);
    const Snapshot before = takeSnapshot(gl, GetParam());
    EXPECT_GE(call(), 0) << name;
    EXPECT_EQ(difference(before, takeSnapshot(gl, GetParam())), "") << name << ", variant " << variant;
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_INVALID_VALUE)) << name << " lost the host's error";
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR)) << name;
    EXPECT_EQ(describe(context.takeMessages()), "") << name;
  }

  PluginLibrary library;
  OddState odd;
  std::unique_ptr<gl::Context> loaded;
};
INSTANTIATE_TEST_SUITE_P(Profiles, HostileStateAbi, bothProfiles(), profileName);

// A window that stands open, which is clipped at its sill.
void openWindow(const SmallScene& scene) {
  constexpr uint32_t kWindow = 2;
  scene.expect(scene.setUprightPane(kWindow, "window", {-0.7f, -0.3f}, 1.4f));
  const int64_t later_ns = scene.time_ns + 1'000'000;
  const rg_opening_knot half{later_ns, kWindow, 0, 0.2};
  rg_sample sample;
  scene.api.default_sample(&sample);
  sample.time_ns = later_ns;
  sample.opening_knots = &half;
  sample.opening_knot_count = 1;
  scene.expect(scene.api.update(scene.instance, later_ns, &sample, 1, sizeof sample));
}

TEST_P(HostileStateAbi, isKeptByEveryCall) {
  for (size_t variant = 0; variant < 2; ++variant) {
    SmallScene scene(*library.api);
    expectKept("attach_gl", variant, [&] { return scene.attach(GlContext::getProc); });
    const rg_target target = scene.target(odd.framebuffer(variant));
    scene.expect(scene.step());
    openWindow(scene);
    for (int frame = 0; frame < 8; ++frame) {
      scene.expect(scene.step());
      for (const Call& call : kCalls)
        expectKept(call.name, variant, [&] { return call.make(scene, target); });
    }
    rg_rain_stats stats{};
    stats.struct_size = sizeof stats;
    scene.expect(scene.api.get_rain_stats(scene.instance, &stats));
    EXPECT_GT(stats.live, 100u) << "nothing rained, so nothing was tested";
    expectKept("detach_gl", variant, [&] { return scene.api.detach_gl(scene.instance); });
  }
}

// Colour textures of their own, as a plain host has them: the reference that the hostile picture is held to.
struct PlainTarget {
  const GladGLContext& gl;
  GLuint framebuffer = 0;
  std::array<GLuint, 3> textures{};  // colour 0, colour 1, depth
  explicit PlainTarget(const GladGLContext& context) : gl(context) {
    gl.CreateFramebuffers(1, &framebuffer);
    gl.CreateTextures(GL_TEXTURE_2D, 3, textures.data());
    constexpr std::array<GLenum, 3> kFormats{GL_RGBA16F, GL_RGBA16F, GL_DEPTH_COMPONENT32F};
    constexpr std::array<GLenum, 3> kPlaces{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_DEPTH_ATTACHMENT};
    for (size_t i = 0; i < 3; ++i) {
      gl.TextureStorage2D(textures[i], 1, kFormats[i], SmallScene::kSize_px, SmallScene::kSize_px);
      gl.NamedFramebufferTexture(framebuffer, kPlaces[i], textures[i], 0);
    }
    constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    gl.NamedFramebufferDrawBuffers(framebuffer, 2, kBoth.data());
    clear();
  }
  ~PlainTarget() {
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(3, textures.data());
  }
  PlainTarget(const PlainTarget&) = delete;
  PlainTarget& operator=(const PlainTarget&) = delete;
  void clear() const {
    const float color[4] = {0.25f, 0.5f, 0.125f, 1.0f};
    const float depth = 1.0f;
    gl.ClearTexImage(textures[0], 0, GL_RGBA, GL_FLOAT, color);
    gl.ClearTexImage(textures[1], 0, GL_RGBA, GL_FLOAT, color);
    gl.ClearTexImage(textures[2], 0, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  }
};

TEST_P(HostileStateAbi, changesNoPixelAndNoOtherAttachment) {
  const PlainTarget plain(gl);
  const auto reader = context.shared();  // shares the textures, and its state stays plain
  SmallScene scene(*library.api);
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  scene.expect(scene.step());
  openWindow(scene);
  for (int i = 0; i < 30; ++i) {
    scene.expect(scene.step());
    scene.expect(scene.api.step_gpu(scene.instance));
  }
  const auto read = [&](GLuint texture) {
    gl.Finish();
    reader->makeCurrent();
    const Picture picture = readTexture(reader->gl, texture);
    context.makeCurrent();
    return picture;
  };
  const auto clear = [&] {
    reader->makeCurrent();
    plain.clear();
    reader->gl.Finish();
    context.makeCurrent();
  };
  const auto drawn = [&](bool with_textures) {
    rg_target target = scene.target(plain.framebuffer);
    target.color_texture = with_textures ? plain.textures[0] : 0;
    target.depth_texture = with_textures ? plain.textures[2] : 0;
    clear();
    scene.expect(scene.draw(scene.api.draw_world, target));
    scene.expect(scene.draw(scene.api.draw_glass, target));
    return read(plain.textures[0]);
  };
  clear();
  const Picture empty = read(plain.textures[0]);
  const std::array<Picture, 2> expected{drawn(false), drawn(true)};
  EXPECT_GT(greatestDifference(empty, expected[0]), 0.01f) << "nothing was drawn, so nothing was tested";
  for (size_t variant = 0; variant < 2; ++variant) {
    odd.apply(variant);
    for (const bool with_textures : {false, true}) {
      EXPECT_EQ(greatestDifference(drawn(with_textures), expected[with_textures ? 1 : 0]), 0.0f)
          << "variant " << variant << (with_textures ? " with textures" : "");
      EXPECT_EQ(greatestDifference(read(plain.textures[1]), empty), 0.0f)
          << "a second draw buffer was drawn into";
    }
  }
  scene.expect(scene.api.detach_gl(scene.instance));
}

TEST_P(HostileStateAbi, thatCannotBeWorkedInIsRefusedUnchanged) {
  const PlainTarget plain(gl);
  SmallScene scene(*library.api);
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  scene.expect(scene.step());
  GLuint query = 0;
  gl.GenQueries(1, &query);
  gl.BeginQuery(GL_SAMPLES_PASSED, query);
  const Snapshot before = takeSnapshot(gl, GetParam());
  const rg_target target = scene.target(plain.framebuffer);
  EXPECT_EQ(scene.draw(scene.api.draw_world, target), RG_ERROR_WRONG_ORDER);
  EXPECT_EQ(scene.draw(scene.api.draw_glass, target), RG_ERROR_WRONG_ORDER);
  EXPECT_EQ(scene.api.step_gpu(scene.instance), RG_ERROR_WRONG_ORDER);
  EXPECT_NE(std::string(scene.api.last_error(scene.instance)).find("SAMPLES_PASSED"), std::string::npos);
  EXPECT_EQ(difference(before, takeSnapshot(gl, GetParam())), "");
  gl.EndQuery(GL_SAMPLES_PASSED);
  gl.DeleteQueries(1, &query);
  for (const uint32_t framebuffer : {0u, 4711u}) {
    EXPECT_LT(scene.draw(scene.api.draw_world, scene.target(framebuffer)), 0);
    EXPECT_LT(scene.draw(scene.api.draw_glass, scene.target(framebuffer)), 0);
    EXPECT_LT(scene.draw(scene.api.draw_finish, scene.target(framebuffer)), 0);
  }
  EXPECT_EQ(difference(before, takeSnapshot(gl, GetParam())), "");
  scene.expect(scene.api.detach_gl(scene.instance));
}

TEST_P(HostileStateAbi, ofAHostThatResetsItGetsTheMaskOfWhatWasTouched) {
  const PlainTarget plain(gl);
  SmallScene scene(*library.api);
  ASSERT_EQ(scene.attach(GlContext::getProc, 1), RG_OK);
  scene.expect(scene.step());
  scene.expect(scene.api.step_gpu(scene.instance));
  uint32_t touched = 0;
  scene.expect(scene.draw(scene.api.draw_world, scene.target(plain.framebuffer), &touched));
  EXPECT_NE(touched & RG_TOUCHED_PROGRAM, 0u);
  EXPECT_NE(touched & RG_TOUCHED_BLEND, 0u);
  scene.expect(scene.api.detach_gl(scene.instance));
}

}  // namespace
}  // namespace rg::test
