// A small picture that scenes are drawn into: a bright sky above dark ground, so that drops, which turn the
// picture round, are seen.
#pragma once

#include "gl_fixture.h"
#include "picture.h"
#include "small_scene.h"

namespace rg::test {

class ScreenTest : public GlTest {
 protected:
  ScreenTest() {
    gl.CreateRenderbuffers(1, &color);
    gl.NamedRenderbufferStorage(color, GL_RGBA16F, kSize_px, kSize_px);
    gl.CreateFramebuffers(1, &framebuffer);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  }
  ~ScreenTest() override {
    gl.DeleteFramebuffers(1, &framebuffer);
    gl.DeleteRenderbuffers(1, &color);
  }

  Picture pictureOf(const SmallScene& scene) const {
    const std::array<float, 4> ground{0.05f, 0.05f, 0.05f, 1.0f}, sky{1.0f, 1.0f, 1.0f, 1.0f};
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, ground.data());
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, kSize_px / 2, kSize_px, kSize_px / 2);
    gl.ClearNamedFramebufferfv(framebuffer, GL_COLOR, 0, sky.data());
    gl.Disable(GL_SCISSOR_TEST);
    scene.expect(scene.draw(scene.api.draw_world, scene.target(framebuffer)));
    scene.expect(scene.draw(scene.api.draw_glass, scene.target(framebuffer)));
    return readFramebuffer(gl, framebuffer, kSize_px, kSize_px);
  }

 private:
  static constexpr int kSize_px = SmallScene::kSize_px;
  GLuint color = 0, framebuffer = 0;
};

}  // namespace rg::test
