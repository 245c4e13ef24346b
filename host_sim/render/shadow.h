// What the sun does not reach: one depth map around the eye. Only drawn while the sun shines.
#pragma once

#include <span>

#include "render/instance.h"
#include "render/program.h"

namespace host {

class Shadow {
 public:
  explicit Shadow(const GladGLContext& gl);
  ~Shadow();
  Shadow(const Shadow&) = delete;
  Shadow& operator=(const Shadow&) = delete;

  /// Draws the map anew. The map's texels stay where they are in the world as the eye moves, so that edges do
  /// not crawl.
  void draw(std::span<const Instance* const> instances, glm::vec3 to_sun, glm::dvec3 eye_m);
  GLuint texture() const { return texture_; }
  /// 0..1 of the map from positions relative to `eye_m`.
  glm::mat4 mapFromRel(glm::dvec3 eye_m) const;

 private:
  const GladGLContext& gl_;
  Program solid_, cut_out_;
  GLuint texture_ = 0, framebuffer_ = 0;
  glm::dmat4 map_from_world_{1.0};
};

}  // namespace host
