#include "glass/look_picture_gl.h"

#include <algorithm>

namespace rg::glass {

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
  canvas.texture =
      gl::Texture2D(*gl_, GL_RGBA16F, width, height, mipmaps_ ? gl::fullMipLevels(width, height) : 1);
  canvas.framebuffer = gl::Framebuffer(*gl_, {&canvas.texture});
  canvas.framebuffer.requireComplete("what the glass's look draws into");
  return canvas;
}

void Canvases::forget() {
  for (Canvas& canvas : canvases_) {
    canvas.texture.forget();
    canvas.framebuffer.forget();
  }
}

void LookPicture::fetch(const glm::ivec4& viewport_px, const LookTarget& target) {
  const int x = viewport_px.x, y = viewport_px.y, width = viewport_px.z, height = viewport_px.w;
  Canvas& canvas = canvases_.ofSize(width, height);
  GLuint source = target.framebuffer;
  if (target.color_texture != 0) {  // whatever the host's framebuffer has set to be read
    source_.attachColor(0, target.color_texture);
    gl_->NamedFramebufferReadBuffer(source_.name(), GL_COLOR_ATTACHMENT0);
    source = source_.name();
  }
  gl_->Disablei(GL_SCISSOR_TEST, 0);
  gl_->BlitNamedFramebuffer(source, canvas.framebuffer.name(), x, y, x + width, y + height, 0, 0, width,
                            height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  canvas.texture.generateMipmaps();
  texture_ = canvas.texture.name();
}

void LookPicture::forget() {
  source_.forget();
  canvases_.forget();
}

}  // namespace rg::glass
