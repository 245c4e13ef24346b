#include "gl/canvases.h"

#include <algorithm>

namespace rg::gl {

Canvas& Canvases::ofSize(int width, int height) {
  const auto found = std::find_if(canvases_.begin(), canvases_.end(), [&](const Canvas& canvas) {
    return canvas.texture.width() == width && canvas.texture.height() == height;
  });
  if (found != canvases_.end()) {
    canvases_.splice(canvases_.begin(), canvases_, found);
    return canvases_.front();
  }
  if (canvases_.size() >= kMost) canvases_.pop_back();
  Canvas& canvas = canvases_.emplace_front();
  canvas.texture = Texture2D(*gl_, GL_RGBA16F, width, height, mipmaps_ ? fullMipLevels(width, height) : 1);
  canvas.framebuffer = Framebuffer(*gl_, {&canvas.texture});
  canvas.framebuffer.requireComplete("a texture to draw into");
  return canvas;
}

void Canvases::forget() {
  for (Canvas& canvas : canvases_) {
    canvas.texture.forget();
    canvas.framebuffer.forget();
  }
}

}  // namespace rg::gl
