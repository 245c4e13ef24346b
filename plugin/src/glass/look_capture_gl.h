// The eye's surroundings as a cube of radiance, renewed a few faces at a time: what drops show upside down.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "gl/objects.h"
#include "glass/look_gl.h"

namespace rg::glass {

class LookCapture {
 public:
  explicit LookCapture(const GladGLContext& gl) : gl_(&gl) {}

  // Renews at most `max_faces` faces around the eye: those that have waited longest, where the forward one
  // counts as waiting four times as long.
  void renew(const glm::dmat4& eyeFromWorld, int size_px, int max_faces, const DrawScene& draw,
             DepthUse depth = {});
  void drop();
  void forget();

  // Cube of linear radiance with mips, world axes; 0 until each face has been drawn.
  uint32_t cube() const;

 private:
  void allocate(int size_px);
  int mostWanted(const glm::dvec3& forward) const;

  const GladGLContext* gl_;
  gl::TextureCube cube_;
  gl::Texture2D depth_;
  std::array<gl::Framebuffer, 6> faces_;
  std::array<int, 6> age_{};  // pictures taken since this face's; kNever before its first
};

// View of a cube's face from a point, eyeFromWorld, as GL's cube maps want it (OpenGL 4.5, table 8.19).
glm::dmat4 faceFromWorld(int face, const glm::dvec3& eye_world_m);

}  // namespace rg::glass
