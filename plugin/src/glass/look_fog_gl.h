// The fogged inside of a pane, ready to be drawn.
#pragma once

#include "gl/objects.h"
#include "glass/look_gl.h"

namespace rg::glass {

class FogPainter {
 public:
  explicit FogPainter(const GladGLContext& gl) : gl_(&gl) {}
  // The pane's fog, in that texture unit.
  void bind(const LookFog& fog, uint32_t unit);
  void forget();

 private:
  const GladGLContext* gl_;
  gl::Texture2D covered_;
};

}  // namespace rg::glass
