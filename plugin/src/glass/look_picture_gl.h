// Textures the look draws into on its way: the target's picture, fetched so that glass can show it bent and
// blurred, and films made ready.
#pragma once

#include <glm/glm.hpp>
#include <list>
#include <optional>

#include "gl/objects.h"
#include "gl/program.h"
#include "glass/look_gl.h"

namespace rg::glass {

// A texture of half floats with its framebuffer.
struct Canvas {
  gl::Texture2D texture;
  gl::Framebuffer framebuffer;
};

// Canvases by size, so that views and panes of different sizes that take turns do not make them anew each
// time.
class Canvases {
 public:
  Canvases(const GladGLContext& gl, bool mipmaps) : gl_(&gl), mipmaps_(mipmaps) {}
  Canvas& ofSize(int width, int height);
  void forget();

 private:
  static constexpr size_t kMost = 8;
  const GladGLContext* gl_;
  bool mipmaps_;
  std::list<Canvas> canvases_;  // the one used last in front
};

class LookPicture {
 public:
  explicit LookPicture(const GladGLContext& gl)
      : gl_(&gl), source_(gl), canvases_(gl, true), level_(gl), no_layout_(gl) {}

  // Copies what the viewport of the target shows, as it is there, with mips. `exact`: mips are means to the
  // last pixel, for pictures in which single ones matter.
  void fetch(const glm::ivec4& viewport_px, const LookTarget& target, bool exact = false);
  uint32_t texture() const { return texture_; }
  void forget();

 private:
  void halveOddLevels(const gl::Texture2D& picture);

  const GladGLContext* gl_;
  gl::Framebuffer source_;  // reads the target's colour texture
  Canvases canvases_;
  gl::Framebuffer level_;
  gl::VertexArray no_layout_;
  std::optional<gl::Program> halve_;  // made when first wanted
  uint32_t texture_ = 0;
};

}  // namespace rg::glass
