// Light from all around: a cube map of the sky (computed, or a picture), what rough surfaces mirror of it,
// and its irradiance.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "render/program.h"
#include "render/sky.h"

namespace host {

class Environment {
 public:
  explicit Environment(const GladGLContext& gl);
  ~Environment();
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

  /// From now on a picture (latitude-longitude, row 0 up) instead of the computed sky.
  void setPicture(std::span<const float> rgb, int width, int height);
  /// Draws the cubes anew when the weather's light is no longer what they show.
  void update(const Sky& sky);

  /// Sharp, for the background. With mips (box).
  GLuint sky() const { return sky_; }
  /// Mip i as a surface of roughness (i / lastMip())^2 mirrors it.
  GLuint mirrored() const { return mirrored_; }
  float lastMip() const { return kMips - 1; }
  /// What the cubes' values are to be multiplied with: the light changes more often than the cubes are drawn.
  float brightness() const { return brightness_; }
  /// Coefficients for shaders/frame.glsl, brightness included.
  std::array<glm::vec4, 9> irradiance() const;
  glm::vec3 skyRadiance() const { return upper_ * brightness_; }
  glm::vec3 groundRadiance() const { return lower_ * brightness_; }
  glm::vec3 horizonRadiance() const { return horizon_ * brightness_; }
  bool isPicture() const { return picture_ != 0; }
  /// The latitude-longitude picture, or 0.
  GLuint picture() const { return picture_; }

 private:
  static constexpr int kSkySize = 256, kMirrorSize = 128, kMips = 6;
  void draw(const Sky& sky);
  void faces(const Program& program, GLuint cube, int level, int size) const;
  void prefilter() const;
  void measure();

  const GladGLContext& gl_;
  Program sky_program_, picture_program_, prefilter_program_;
  GLuint sky_ = 0, mirrored_ = 0, picture_ = 0, framebuffer_ = 0, no_vertices_ = 0;
  std::optional<Sky> drawn_;
  float brightness_ = 1.0F;
  std::array<glm::vec3, 9> sh_{};
  glm::vec3 upper_{0.0F}, lower_{0.0F}, horizon_{0.0F};
};

}  // namespace host
