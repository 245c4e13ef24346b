#include "glass/look_picture_gl.h"

namespace rg::glass {

void LookPicture::fetch(const glm::ivec4& viewport_px, const LookTarget& target) {
  const int width = viewport_px.z, height = viewport_px.w;
  if (!picture_ || picture_.width() != width || picture_.height() != height) {
    picture_ = gl::Texture2D(*gl_, GL_RGBA16F, width, height, gl::fullMipLevels(width, height));
    target_.attachColor(0, picture_.name());
    target_.drawColors(1);
    target_.requireComplete("the picture behind the glass");
  }
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->BlitNamedFramebuffer(target.framebuffer, target_.name(), viewport_px.x, viewport_px.y,
                            viewport_px.x + width, viewport_px.y + height, 0, 0, width, height,
                            GL_COLOR_BUFFER_BIT, GL_NEAREST);
  picture_.generateMipmaps();
}

void LookPicture::forget() {
  picture_.forget();
  target_.forget();
}

}  // namespace rg::glass
