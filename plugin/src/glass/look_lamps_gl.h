// Lamps for the look's shaders: those that shine brightest at the eye.
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "gl/objects.h"
#include "glass/look_gl.h"
#include "glass/look_programs_gl.h"

namespace rg::glass {

inline constexpr int kMostLookLamps = 16;  // shaders/optics/look_lamp.glsl

// Storage buffer 4 of the variants LAMPS.
class LookLamps {
 public:
  LookLamps(const GladGLContext& gl, LookPrograms& programs);
  // Binds the block. False when none shines at the eye: then it is not needed.
  bool put(std::span<const LookLamp> lamps, const glm::dvec3& eye_world_m);
  // Puts those out that the target's depth says are hidden; the look's frame is bound.
  void hide();
  void forget();

 private:
  const GladGLContext* gl_;
  LookPrograms* programs_;
  gl::Buffer block_;
};

}  // namespace rg::glass
