// Lamps for the look's shaders: those that shine brightest at the eye.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "gl/objects.h"
#include "glass/look_gl.h"

namespace rg::glass {

inline constexpr int kMostLookLamps = 16;  // shaders/optics/lamps.glsl

// Uniform block 1 of the variants LAMPS.
class LookLamps {
 public:
  explicit LookLamps(const GladGLContext& gl);
  // Binds the block. False when none shines at the eye: then it is not needed.
  bool put(std::span<const LookLamp> lamps, const glm::dvec3& eye_world_m);
  void forget() { block_.forget(); }

 private:
  const GladGLContext* gl_;
  gl::Buffer block_;
};

}  // namespace rg::glass
