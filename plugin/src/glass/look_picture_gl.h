// The target's picture, fetched so that glass can show it bent and blurred.
#pragma once

#include <glm/glm.hpp>

#include "gl/objects.h"
#include "glass/look_gl.h"

namespace rg::glass {

class LookPicture {
 public:
  explicit LookPicture(const GladGLContext& gl) : gl_(&gl), target_(gl) {}

  // Copies what the viewport of the target shows, as it is there, with mips.
  void fetch(const glm::ivec4& viewport_px, const LookTarget& target);
  uint32_t texture() const { return picture_.name(); }
  void forget();

 private:
  const GladGLContext* gl_;
  gl::Texture2D picture_;
  gl::Framebuffer target_;
};

}  // namespace rg::glass
