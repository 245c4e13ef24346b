// When a driver is asked to compile: on a GPU in attach_gl, whatever comes into view later.
#include <glad/gl.h>

#include <map>
#include <set>
#include <string>

#include "screen.h"

namespace rg::test {
namespace {

// A driver that calls itself a GPU's, counts the programs that it links and notes those that are used. What
// is drawn is left out, and computed while `idle`: software GL compiles for each draw what a GPU has by then.
struct Driver {
  static inline int linked;
  static inline bool idle, threads;
  static inline std::set<GLuint> used;
  static inline std::map<GLuint, std::string> labels;

  static void begin() {
    linked = 0;
    idle = false;
    threads = true;
    used.clear();
    labels.clear();
  }

  template <class Function>
  static Function real(const char* name) {
    return reinterpret_cast<Function>(GlContext::getProc(nullptr, name));
  }

  static void* getProc(void*, const char* name) {
    const std::string wanted = name;
    const auto as = [](auto function) { return reinterpret_cast<void*>(+function); };
    if (wanted == "glGetString")
      return as([](GLenum what) -> const GLubyte* {
        if (what == GL_RENDERER) return reinterpret_cast<const GLubyte*>("Some GPU");
        return real<PFNGLGETSTRINGPROC>("glGetString")(what);
      });
    if (wanted == "glGetStringi")
      return as([](GLenum what, GLuint i) -> const GLubyte* {
        const GLubyte* text = real<PFNGLGETSTRINGIPROC>("glGetStringi")(what, i);
        const bool hidden =
            !threads && std::string(reinterpret_cast<const char*>(text)) == "GL_KHR_parallel_shader_compile";
        return hidden ? reinterpret_cast<const GLubyte*>("GL_none") : text;
      });
    if (wanted == "glLinkProgram")
      return as([](GLuint program) {
        ++linked;
        real<PFNGLLINKPROGRAMPROC>("glLinkProgram")(program);
      });
    if (wanted == "glUseProgram")
      return as([](GLuint program) {
        used.insert(program);
        real<PFNGLUSEPROGRAMPROC>("glUseProgram")(program);
      });
    if (wanted == "glObjectLabel")
      return as([](GLenum kind, GLuint object, GLsizei length, const GLchar* text) {
        if (kind == GL_PROGRAM) labels[object] = std::string(text, static_cast<size_t>(length));
      });
    if (wanted == "glDispatchCompute")
      return as([](GLuint x, GLuint y, GLuint z) {
        if (!idle) real<PFNGLDISPATCHCOMPUTEPROC>("glDispatchCompute")(x, y, z);
      });
    if (wanted == "glDrawArrays") return as([](GLenum, GLint, GLsizei) {});
    if (wanted == "glDrawElements") return as([](GLenum, GLsizei, GLenum, const void*) {});
    if (wanted == "glDrawArraysIndirect") return as([](GLenum, const void*) {});
    if (wanted == "glDrawElementsIndirect") return as([](GLenum, GLenum, const void*) {});
    if (wanted == "glDrawArraysInstancedBaseInstance")
      return as([](GLenum, GLint, GLsizei, GLsizei, GLuint) {});
    if (wanted == "glMultiDrawArraysIndirect") return as([](GLenum, const void*, GLsizei, GLsizei) {});
    if (wanted == "glMultiDrawElementsIndirect")
      return as([](GLenum, GLenum, const void*, GLsizei, GLsizei) {});
    return GlContext::getProc(nullptr, name);
  }
};

class Compiling : public GlTest {
 protected:
  Compiling() {
    Driver::begin();
    gl.CreateTextures(GL_TEXTURE_2D, 1, &color);
    gl.TextureStorage2D(color, 1, GL_RGBA16F, kSize_px, kSize_px);
    gl.CreateTextures(GL_TEXTURE_2D, 1, &depth);
    gl.TextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, kSize_px, kSize_px);
    gl.CreateFramebuffers(1, &framebuffer);
    gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, color, 0);
    gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
    gl.CreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
    gl.TextureStorage2D(cube, 1, GL_RGBA16F, 4, 4);

    scene.expect(scene.setUprightPane(kMirror, "mirror", {0.3f, 0.7f}, 1.4f, 20000, 0.8));
    scene.expect(scene.setUprightPane(kWindow, "window", {-0.7f, -0.3f}, 1.4f));
    for (const auto& [name, value] : std::map<const char*, double>{{"glow.strength", 1.0},
                                                                   {"wetness.strength", 1.0},
                                                                   {"fog.cabin_temperature_c", 30.0},
                                                                   {"fog.cabin_humidity", 1.0}})
      scene.expect(api.set_parameter(scene.instance, name, value));
  }
  ~Compiling() override {
    gl.DeleteFramebuffers(1, &framebuffer);
    for (const GLuint texture : {color, depth, cube}) gl.DeleteTextures(1, &texture);
  }

  void steps(int count) {
    for (int i = 0; i < count; ++i) {
      scene.expect(scene.step());
      scene.expect(api.step_gpu(scene.instance));
    }
  }

  // One after the other, with all that is drawn by another program for it.
  void drawAll(int32_t color_space) {
    Driver::idle = true;
    for (uint32_t kind = 0; kind < 32; ++kind) drawAs(kind, color_space);
    Driver::idle = false;
  }

  void drawAs(uint32_t kind, int32_t color_space) {
    const bool lamp_shines = (kind & 1) != 0, surrounded = (kind & 2) != 0, sharp = (kind & 4) != 0;
    const bool near = (kind & 8) != 0, outside = (kind & 16) != 0;
    scene.expect(api.set_parameter(scene.instance, "glass.pupil_m", sharp ? 0.0 : 5e-3));
    rg_view view = scene.view;
    view.vehicle = outside ? 0 : kCar;
    if (near) view.projection[0] = view.projection[5] = 20.0;  // a texel of the windscreen is many pixels
    rg_target target = scene.target(framebuffer);
    target.color_space = color_space;
    if (!sharp) {
      target.color_texture = color;
      target.depth_texture = depth;
    }
    rg_lamp lamp{{40.0, 0.0, 1.0}, {-1.0f, 0.0f, 0.0f}, {1e4f, 1e4f, 1e4f}, -1.0f, -1.0f};
    rg_lighting lighting;
    api.default_lighting(&lighting);
    lighting.environment_cube = surrounded ? cube : 0;
    lighting.lamps = &lamp;
    lighting.lamp_count = lighting.lamps_on_glass = lamp_shines ? 1 : 0;
    rg_draw draw;
    api.default_draw(&draw);
    draw.time_ns = scene.time_ns;
    draw.view = &view;
    draw.target = &target;
    draw.lighting = &lighting;
    for (const auto function : {api.draw_world, api.draw_glass, api.draw_finish})
      scene.expect(function(scene.instance, &draw));
  }

  // Of the look's, but for craters, which need a flooded pane, and for a mirror that has a wiper at work.
  static std::string unused() {
    std::string all;
    for (const auto& [program, label] : Driver::labels) {
      const bool not_here =
          label.find("crater") != std::string::npos || label.find("MIRROR RIDGES") != std::string::npos;
      if (!Driver::used.contains(program) && label.starts_with("glass/look_") && !not_here)
        all += label + "\n";
    }
    return all;
  }

  static constexpr int kSize_px = SmallScene::kSize_px;
  static constexpr uint32_t kMirror = 2, kWindow = 3;
  PluginLibrary plugin;
  const rg_api& api = *plugin.api;
  SmallScene scene{api};
  GLuint color = 0, depth = 0, cube = 0, framebuffer = 0;
};

TEST_F(Compiling, isDoneAsTheContextIsAttachedAndNeverInTheFrame) {
  scene.expect(scene.attach(Driver::getProc));
  const int at_attach = Driver::linked;
  EXPECT_GT(at_attach, 0);
  steps(20);
  drawAll(RG_LINEAR_HDR);
  scene.expect(scene.setWiper(2, kMirror, 0.7));
  scene.snow_mm_h = scene.hail_mm_h = 20.0;
  scene.temperature_c = -1.0;
  steps(20);
  drawAll(RG_LINEAR_HDR);
  EXPECT_EQ(Driver::linked, at_attach);
  EXPECT_EQ(unused(), "") << "compiled for nobody, or this test does not draw all that there is";

  drawAs(0, RG_SRGB);
  const int with_encoded = Driver::linked;
  EXPECT_GT(with_encoded, at_attach);
  drawAll(RG_SRGB);
  EXPECT_EQ(Driver::linked, with_encoded) << "all for such targets come with the first";
  scene.expect(api.detach_gl(scene.instance));
}

TEST_F(Compiling, onlyWhatATargetOfSrgbShowsIsAddedWhereTheDriverHasNoThreads) {
  Driver::threads = false;
  scene.expect(scene.attach(Driver::getProc));
  const int at_attach = Driver::linked;
  steps(4);
  drawAll(RG_LINEAR_HDR);
  EXPECT_EQ(Driver::linked, at_attach);
  Driver::idle = true;
  drawAs(0, RG_SRGB);
  EXPECT_GT(Driver::linked, at_attach);
  EXPECT_LT(Driver::linked, at_attach + 12);
  scene.expect(api.detach_gl(scene.instance));
}

}  // namespace
}  // namespace rg::test
