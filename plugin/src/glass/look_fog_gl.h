// The fogged inside of a pane, ready to be drawn.
#pragma once

#include <array>
#include <optional>

#include "gl/objects.h"
#include "gl/program.h"
#include "glass/look_gl.h"

namespace rg::glass {

class FogPainter {
 public:
  explicit FogPainter(const GladGLContext& gl) : gl_(&gl) {}
  // Uses the program (without or with an environment), the pane's fog in that texture unit.
  void bind(const LookFog& fog, size_t with_environment, uint32_t unit);
  void forget();

 private:
  const GladGLContext* gl_;
  std::array<std::optional<gl::Program>, 2> programs_;  // made when a pane is first fogged
  gl::Texture2D covered_;
};

}  // namespace rg::glass
