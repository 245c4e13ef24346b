// Textures the look draws into on its way: the target's picture, fetched so that glass can show it bent and
// blurred, and films made ready.
#pragma once

#include <glm/glm.hpp>

#include "gl/canvases.h"
#include "glass/look_gl.h"
#include "glass/look_programs_gl.h"

namespace rg::glass {

class LookPicture {
 public:
  LookPicture(const GladGLContext& gl, LookPrograms& programs)
      : gl_(&gl), programs_(&programs), source_(gl), canvases_(gl, true), level_(gl), no_layout_(gl) {}

  // Copies what the viewport of the target shows, as it is there, with mips. `exact`: mips are means to the
  // last pixel, for pictures in which single ones matter.
  void fetch(const glm::ivec4& viewport_px, const LookTarget& target, bool exact = false);
  uint32_t texture() const { return texture_; }
  void forget();

 private:
  void halveOddLevels(const gl::Texture2D& picture);

  const GladGLContext* gl_;
  LookPrograms* programs_;
  gl::Framebuffer source_;  // reads the target's colour texture
  gl::Canvases canvases_;
  gl::Framebuffer level_;
  gl::VertexArray no_layout_;
  uint32_t texture_ = 0;
};

}  // namespace rg::glass
