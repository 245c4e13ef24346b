// Targets, light, lamps and captures that cannot be, and the structs by which an instance is made and
// attached.
#include <cstddef>

#include "bad_arguments.h"

namespace rg::test {
namespace {

class BadPictures : public BadArguments {
 protected:
  BadPictures() {
    gl.CreateFramebuffers(1, &framebuffer);
    gl.CreateTextures(GL_TEXTURE_2D, 3, textures.data());
    for (size_t i = 0; i < 3; ++i) {
      gl.TextureStorage2D(textures[i], 1, i == 1 ? GL_DEPTH_COMPONENT32F : GL_RGBA16F, SmallScene::kSize_px,
                          SmallScene::kSize_px);
    }
    gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, textures[0], 0);
    gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, textures[1], 0);
    target = scene.target(framebuffer);
    api.default_lighting(&lighting);
    api.default_draw(&picture);
    picture.time_ns = scene.time_ns;
    picture.view = &scene.view;
    picture.target = &target;
    picture.lighting = &lighting;
  }
  ~BadPictures() override {
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteTextures(3, textures.data());
  }

  // All three draws refuse it alike.
  void expectDrawsRefused(const std::string& what, const std::string& field, rg_result code,
                          rg_draw bad) const {
    int index = 0;
    for (const auto call : {api.draw_world, api.draw_glass, api.draw_finish}) {
      expectRefused(
          what + ", draw " + std::to_string(index++), [&] { return call(scene.instance, &bad); }, code,
          field);
    }
  }
  void expectTargetRefused(const std::string& what, const std::string& field,
                           const std::function<void(rg_target&)>& spoil,
                           rg_result code = RG_ERROR_BAD_ARGUMENT) const {
    rg_target bad = target;
    spoil(bad);
    rg_draw draw = picture;
    draw.target = &bad;
    expectDrawsRefused(what, field, code, draw);
  }
  void expectLightRefused(const std::string& what, const std::string& field,
                          const std::function<void(rg_lighting&)>& spoil,
                          rg_result code = RG_ERROR_BAD_ARGUMENT) const {
    rg_lighting bad = lighting;
    spoil(bad);
    rg_draw draw = picture;
    draw.lighting = &bad;
    expectDrawsRefused(what, field, code, draw);
  }

  GLuint framebuffer = 0;
  std::array<GLuint, 3> textures{};  // colour, depth, and one that is not attached
  rg_target target{};
  rg_lighting lighting{};
  rg_draw picture{};
};

TEST_F(BadPictures, targetsThatCannotBeDrawnInto) {
  expectTargetRefused(
      "framebuffer", "framebuffer 4711", [](rg_target& t) { t.framebuffer = 4711; }, RG_ERROR_WRONG_ORDER);
  expectTargetRefused("no size", "rg_target", [](rg_target& t) { t.width_px = 0; });
  expectTargetRefused("negative", "rg_target", [](rg_target& t) { t.height_px = -1; });
  expectTargetRefused("huge", "rg_target", [](rg_target& t) { t.width_px = INT32_MAX; });
  expectTargetRefused(
      "multisampled", "samples", [](rg_target& t) { t.samples = 4; }, RG_ERROR_MISSING_FEATURE);
  expectTargetRefused("no samples", "samples", [](rg_target& t) { t.samples = 0; });
  expectTargetRefused(
      "layer", "layer", [](rg_target& t) { t.layer = 1; }, RG_ERROR_MISSING_FEATURE);
  expectTargetRefused("colour space", "color_space", [](rg_target& t) { t.color_space = 5; });
  expectTargetRefused("exposure", "exposure", [](rg_target& t) { t.exposure = kNaN; });
  expectTargetRefused("exposure 0", "exposure", [](rg_target& t) { t.exposure = 0.0; });
  expectTargetRefused(
      "no texture", "color_texture", [](rg_target& t) { t.color_texture = 4711; }, RG_ERROR_WRONG_ORDER);
  expectTargetRefused(
      "a texture of elsewhere", "color_texture", [&](rg_target& t) { t.color_texture = textures[2]; },
      RG_ERROR_WRONG_ORDER);
  expectTargetRefused(
      "colour as depth", "depth_texture", [&](rg_target& t) { t.depth_texture = textures[0]; },
      RG_ERROR_WRONG_ORDER);
  expectTargetRefused(
      "struct_size", "rg_target.struct_size", [](rg_target& t) { t.struct_size = 3; }, RG_ERROR_BAD_STRUCT);
}

TEST_F(BadPictures, lightThatIsNoLight) {
  const auto nan = static_cast<float>(kNaN);
  expectLightRefused("sky", "sky_radiance", [&](rg_lighting& l) { l.sky_radiance[1] = nan; });
  expectLightRefused("ground", "ground_radiance", [](rg_lighting& l) { l.ground_radiance[0] = -1.0f; });
  expectLightRefused("sun", "sun_irradiance",
                     [&](rg_lighting& l) { l.sun_irradiance[2] = static_cast<float>(kInfinity); });
  expectLightRefused("to the sun", "sun_direction", [](rg_lighting& l) { l.sun_direction[2] = 3.0f; });
  expectLightRefused(
      "no cube", "environment_cube", [](rg_lighting& l) { l.environment_cube = 4711; }, RG_ERROR_WRONG_ORDER);
  expectLightRefused(
      "a flat cube", "environment_cube", [&](rg_lighting& l) { l.environment_cube = textures[0]; },
      RG_ERROR_WRONG_ORDER);
  expectLightRefused("lamps that are not there", "rg_lighting.lamps",
                     [](rg_lighting& l) { l.lamp_count = 2; });
  rg_lamp lamp{};
  expectLightRefused("a huge count of lamps", "rg_lighting.lamps",
                     [&](rg_lighting& l) { l.lamps = &lamp, l.lamp_count = 0xFFFFFFFF; });
  expectLightRefused("more lamps on the glass than there are", "rg_lighting.lamps_on_glass",
                     [&](rg_lighting& l) { l.lamps = &lamp, l.lamp_count = 1, l.lamps_on_glass = 2; });
  const auto lampRefused = [&](const std::string& field, const std::function<void(rg_lamp&)>& spoil) {
    rg_lamp bad{};
    spoil(bad);
    expectLightRefused("a lamp", field, [&](rg_lighting& l) { l.lamps = &bad, l.lamp_count = 1; });
  };
  lampRefused("rg_lamp.position_m", [](rg_lamp& l) { l.position_m[0] = kNaN; });
  lampRefused("rg_lamp.direction", [&](rg_lamp& l) { l.direction[0] = nan; });
  lampRefused("rg_lamp.intensity", [](rg_lamp& l) { l.intensity[0] = -1.0f; });
  lampRefused("rg_lamp.cos_inner", [](rg_lamp& l) { l.cos_inner = 2.0f; });
  lampRefused("rg_lamp.cos_outer", [&](rg_lamp& l) { l.cos_outer = nan; });
}

TEST_F(BadPictures, momentsAndViewsThatCannotBeDrawn) {
  rg_draw bad = picture;
  bad.view = nullptr;
  expectDrawsRefused("no view", "rg_view", RG_ERROR_BAD_ARGUMENT, bad);
  bad = picture;
  bad.target = nullptr;
  expectDrawsRefused("no target", "rg_target", RG_ERROR_BAD_ARGUMENT, bad);
  bad = picture;
  bad.struct_size = 1;
  expectDrawsRefused("struct_size", "rg_draw.struct_size", RG_ERROR_BAD_STRUCT, bad);
  for (const int64_t time_ns : {INT64_MIN, INT64_MAX}) {
    bad = picture;
    bad.time_ns = time_ns;
    expectDrawsRefused("a time out of range", "rg_draw.time_ns", RG_ERROR_BAD_ARGUMENT, bad);
  }
  bad = picture;
  bad.time_ns -= 1'100'000'000;
  expectDrawsRefused("a time long gone", "rg_draw.time_ns", RG_ERROR_WRONG_ORDER, bad);
  rg_view view = scene.view;
  bad = picture;
  bad.view = &view;
  view.viewport_px[0] = INT32_MAX;
  expectDrawsRefused("a viewport far off", "viewport_px", RG_ERROR_BAD_ARGUMENT, bad);
  view = scene.view;
  view.eye_from_world[0] = view.eye_from_world[2] = 7.0;
  expectDrawsRefused("an eye that scales", "eye_from_world", RG_ERROR_BAD_ARGUMENT, bad);
  view = scene.view;
  view.projection[0] = 0.0;
  expectDrawsRefused("a projection without inverse", "projection", RG_ERROR_BAD_ARGUMENT, bad);
}

// Extremes that are allowed are drawn: without an error of GL's, and without a change of state.
TEST_F(BadPictures, extremesAreDrawn) {
  std::vector<rg_lamp> lamps(4096);
  for (rg_lamp& lamp : lamps) lamp.position_m[0] = 1e300, lamp.intensity[0] = 1e9f;
  lighting.lamps = lamps.data();
  lighting.lamp_count = static_cast<uint32_t>(lamps.size());
  rg_view far = scene.view;
  far.eye_from_world[12] = far.eye_from_world[13] = far.eye_from_world[14] = 1e300;
  rg_view tiny = scene.view;
  tiny.viewport_px[2] = tiny.viewport_px[3] = 1;
  tiny.viewport_px[0] = tiny.viewport_px[1] = -32768;
  const uint64_t before = stateHash();
  for (const rg_view* view : std::array<const rg_view*, 3>{&scene.view, &far, &tiny}) {
    for (const int64_t time_ns :
         {scene.time_ns, scene.time_ns - 990'000'000, scene.time_ns + (INT64_C(1) << 60)}) {
      picture.view = view;
      picture.time_ns = time_ns;
      EXPECT_EQ(api.draw_world(scene.instance, &picture), RG_OK) << api.last_error(scene.instance);
      EXPECT_EQ(api.draw_glass(scene.instance, &picture), RG_OK) << api.last_error(scene.instance);
    }
  }
  EXPECT_EQ(stateHash(), before);
}

TEST_F(BadPictures, capturesThatCannotBe) {
  rg_capture_info good;
  api.default_capture_info(&good);
  good.view = &scene.view;
  const auto refused = [&](const std::string& field, rg_result code,
                           const std::function<void(rg_capture_info&)>& spoil) {
    rg_capture_info bad = good;
    spoil(bad);
    expectRefused(
        field, [&] { return api.prepare_captures(scene.instance, &bad); }, code, field);
  };
  refused("rg_view", RG_ERROR_BAD_ARGUMENT, [](rg_capture_info& c) { c.view = nullptr; });
  refused("max_faces", RG_ERROR_BAD_ARGUMENT, [](rg_capture_info& c) { c.max_faces = 7; });
  refused("rg_capture_info.struct_size", RG_ERROR_BAD_STRUCT, [](rg_capture_info& c) { c.struct_size = 0; });
  EXPECT_EQ(api.prepare_captures(scene.instance, &good), RG_OK);
}

TEST_F(BadPictures, instancesThatCannotBeMade) {
  rg_create_info good;
  api.default_create_info(&good);
  const auto refused = [&](const std::string& field, rg_result code,
                           const std::function<void(rg_create_info&)>& spoil) {
    rg_create_info bad = good;
    spoil(bad);
    auto* made = reinterpret_cast<rg_instance*>(&bad);
    EXPECT_EQ(api.create(&bad, &made), code) << field;
    EXPECT_EQ(made, nullptr) << field;
    EXPECT_NE(std::string(api.last_error(nullptr)).find(field), std::string::npos) << api.last_error(nullptr);
  };
  refused("struct_size", RG_ERROR_BAD_STRUCT, [](rg_create_info& c) { c.struct_size = 5; });
  refused("max_drops", RG_ERROR_BAD_ARGUMENT, [](rg_create_info& c) { c.max_drops = 999; });
  refused("max_drops", RG_ERROR_BAD_ARGUMENT, [](rg_create_info& c) { c.max_drops = 0xFFFFFFFF; });
  EXPECT_EQ(api.create(&good, nullptr), RG_ERROR_BAD_ARGUMENT);
}

TEST_F(BadPictures, contextsThatCannotBeAttachedTo) {
  scene.expect(api.detach_gl(scene.instance));
  rg_gl_info info;
  api.default_gl_info(&info);
  expectRefused(
      "no get_proc", [&] { return api.attach_gl(scene.instance, &info); }, RG_ERROR_BAD_ARGUMENT, "get_proc");
  info.get_proc = [](void*, const char*) -> void* { return nullptr; };
  expectRefused(
      "a get_proc that knows nothing", [&] { return api.attach_gl(scene.instance, &info); },
      RG_ERROR_GL_VERSION, "OpenGL 4.5");
  info.get_proc = [](void*, const char* name) {
    return std::strcmp(name, "glBindTextureUnit") == 0 ? nullptr : GlContext::getProc(nullptr, name);
  };
  expectRefused(
      "a get_proc with a gap", [&] { return api.attach_gl(scene.instance, &info); }, RG_ERROR_GL_VERSION,
      "get_proc");
  info.struct_size = 2;
  expectRefused(
      "struct_size", [&] { return api.attach_gl(scene.instance, &info); }, RG_ERROR_BAD_STRUCT,
      "rg_gl_info.struct_size");
  scene.expect(scene.attach(GlContext::getProc));
}

TEST_F(BadPictures, nullForADefaultDoesNothing) {
  api.default_create_info(nullptr);
  api.default_gl_info(nullptr);
  api.default_vehicle(nullptr);
  api.default_weather(nullptr);
  api.default_view(nullptr);
  api.default_sample(nullptr);
  api.default_volume_info(nullptr);
  api.default_pane_info(nullptr);
  api.default_wiper_info(nullptr);
  api.default_target(nullptr);
  api.default_lighting(nullptr);
  api.default_draw(nullptr);
  api.default_capture_info(nullptr);
  api.default_rain_pattern(nullptr);
}

}  // namespace
}  // namespace rg::test
