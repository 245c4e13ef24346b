// The library comes and goes: loaded, used, unloaded, and again. Under the asan preset LeakSanitizer looks
// on.
#include <gtest/gtest.h>

#include <thread>

#include "gl_fixture.h"
#include "small_scene.h"

namespace rg::test {
namespace {

GLuint makeTarget(const GladGLContext& gl, std::array<GLuint, 2>& textures) {
  GLuint framebuffer = 0;
  gl.CreateFramebuffers(1, &framebuffer);
  gl.CreateTextures(GL_TEXTURE_2D, 2, textures.data());
  gl.TextureStorage2D(textures[0], 1, GL_RGBA16F, SmallScene::kSize_px, SmallScene::kSize_px);
  gl.TextureStorage2D(textures[1], 1, GL_DEPTH_COMPONENT32F, SmallScene::kSize_px, SmallScene::kSize_px);
  gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, textures[0], 0);
  gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, textures[1], 0);
  const float depth = 1.0f;
  gl.ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &depth);
  return framebuffer;
}

// A refused call too: what it keeps of its message must not keep the library.
void useAll(const GladGLContext& gl) {
  const PluginLibrary library;
  const rg_api& api = *library.api;
  rg_instance* none = nullptr;
  EXPECT_LT(api.create(nullptr, &none), 0);
  EXPECT_STRNE(api.last_error(nullptr), "");
  SmallScene scene(api);
  EXPECT_EQ(scene.attach(GlContext::getProc), RG_OK);
  std::array<GLuint, 2> textures{};
  GLuint framebuffer = makeTarget(gl, textures);
  rg_target target = scene.target(framebuffer);
  for (int i = 0; i < 6; ++i) {
    target.color_texture = i < 3 ? textures[0] : 0;
    target.depth_texture = i < 3 ? textures[1] : 0;
    scene.expect(scene.step());
    scene.expect(api.step_gpu(scene.instance));
    scene.expect(scene.draw(api.draw_world, target));
    scene.expect(scene.draw(api.draw_glass, target));
    scene.expect(scene.draw(api.draw_finish, target));
  }
  EXPECT_EQ(api.detach_gl(scene.instance), RG_OK);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteTextures(2, textures.data());
}

class Load : public GlTest {};

TEST_F(Load, andUseAndUnloadTwiceLeavesNothing) {
  useAll(gl);
  EXPECT_FALSE(PluginLibrary::isLoaded()) << "something in the library keeps it from being unloaded";
  useAll(gl);
  EXPECT_FALSE(PluginLibrary::isLoaded());
}

TEST_F(Load, exportsOneSymbolAndSpeaksOneMajor) {
  const PluginLibrary library;
  for (const uint32_t other : {0u, RG_ABI_MAJOR + 1, (RG_ABI_MAJOR - 1) << 16 | RG_ABI_MINOR,
                               (RG_ABI_MAJOR + 1) << 16 | RG_ABI_MINOR, UINT32_MAX})
    EXPECT_EQ(library.entry(other), nullptr) << other;
  EXPECT_EQ(library.api->struct_size, sizeof(rg_api));
  EXPECT_EQ(library.api->abi_minor, RG_ABI_MINOR);
  EXPECT_STRNE(library.api->version, "");
  for (const char* hidden : {"rgTable", "gladLoadGLContext", "gladLoadGLContextUserPtr", "glClear"}) {
    EXPECT_EQ(library.symbol(hidden), nullptr) << hidden;
  }
}

TEST_F(Load, severalInstancesLiveSideBySide) {
  const PluginLibrary library;
  const rg_api& api = *library.api;
  SmallScene a(api), b(api);
  ASSERT_EQ(a.attach(GlContext::getProc), RG_OK);
  ASSERT_EQ(b.attach(GlContext::getProc), RG_OK);
  for (int i = 0; i < 4; ++i) {
    a.expect(a.step());
    a.expect(api.step_gpu(a.instance));
    b.expect(b.step());
    b.expect(api.step_gpu(b.instance));
  }
  uint64_t hash_a = 0, hash_b = 1;
  a.expect(api.get_hash(a.instance, RG_HASH_STATE, &hash_a));
  b.expect(api.get_hash(b.instance, RG_HASH_STATE, &hash_b));
  EXPECT_EQ(hash_a, hash_b);
  a.expect(api.detach_gl(a.instance));
  b.expect(b.step());
  b.expect(api.step_gpu(b.instance));
  b.expect(api.detach_gl(b.instance));
}

TEST_F(Load, attachesAgainAfterDetachAndAfterALostContext) {
  const PluginLibrary library;
  const rg_api& api = *library.api;
  SmallScene scene(api);
  std::array<GLuint, 2> textures{};
  GLuint framebuffer = makeTarget(gl, textures);
  const rg_target target = scene.target(framebuffer);
  const auto frame = [&] {
    scene.expect(scene.step());
    scene.expect(api.step_gpu(scene.instance));
    scene.expect(scene.draw(api.draw_world, target));
    scene.expect(scene.draw(api.draw_glass, target));
  };
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  frame();
  EXPECT_EQ(scene.attach(GlContext::getProc), RG_ERROR_WRONG_ORDER);
  EXPECT_EQ(api.detach_gl(scene.instance), RG_OK);
  EXPECT_EQ(api.detach_gl(scene.instance), RG_ERROR_WRONG_ORDER);
  EXPECT_EQ(api.step_gpu(scene.instance), RG_ERROR_WRONG_ORDER);
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  frame();
  EXPECT_EQ(api.context_lost(scene.instance), RG_OK);
  ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
  frame();
  EXPECT_EQ(api.detach_gl(scene.instance), RG_OK);
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteTextures(2, textures.data());
}

TEST_F(Load, destroyingAnAttachedInstanceTouchesNoContext) {
  const PluginLibrary library;
  {
    SmallScene scene(*library.api);
    ASSERT_EQ(scene.attach(GlContext::getProc), RG_OK);
    scene.expect(scene.step());
    scene.expect(library.api->step_gpu(scene.instance));
    std::thread([&scene] {
      scene.api.destroy(std::exchange(scene.instance, nullptr));
    }).join();  // no context is current there
  }
  EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(Load, refusesAContextThatIsTooOld) {
  const PluginLibrary library;
  SmallScene scene(*library.api);
  const auto older = [](void*, const char* name) -> void* {
    static constexpr auto kVersion = [](GLenum) {
      return reinterpret_cast<const GLubyte*>("3.1 An Old Driver");
    };
    if (std::strcmp(name, "glGetString") != 0) return GlContext::getProc(nullptr, name);
    return reinterpret_cast<void*>(static_cast<const GLubyte* (*)(GLenum)>(kVersion));
  };
  EXPECT_EQ(scene.attach(older), RG_ERROR_GL_VERSION);
  EXPECT_NE(std::string(library.api->last_error(scene.instance)).find("3.1 An Old Driver"),
            std::string::npos);
  EXPECT_EQ(scene.attach(nullptr), RG_ERROR_BAD_ARGUMENT);
  EXPECT_EQ(library.api->step_gpu(scene.instance), RG_ERROR_WRONG_ORDER);
}

}  // namespace
}  // namespace rg::test
