// Textures to draw into on the way to a picture.
#pragma once

#include <list>

#include "gl/objects.h"

namespace rg::gl {

// A texture of half floats with its framebuffer.
struct Canvas {
  Texture2D texture;
  Framebuffer framebuffer;
};

// Canvases by size, so that views of different sizes that take turns do not make them anew each
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

}  // namespace rg::gl
