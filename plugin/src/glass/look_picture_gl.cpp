#include "glass/look_picture_gl.h"

#include <algorithm>

namespace rg::glass {

void LookPicture::fetch(const glm::ivec4& viewport_px, const LookTarget& target, bool exact) {
  const int x = viewport_px.x, y = viewport_px.y, width = viewport_px.z, height = viewport_px.w;
  gl::Canvas& canvas = canvases_.ofSize(width, height);
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
  if (exact) halveOddLevels(canvas.texture);
  texture_ = canvas.texture.name();
}

// From the first level whose sides the driver cannot simply halve.
void LookPicture::halveOddLevels(const gl::Texture2D& picture) {
  const GLuint name = picture.name();
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  gl_->Disablei(GL_BLEND, 0);
  gl_->BindVertexArray(no_layout_.name());
  gl_->BindTextureUnit(0, name);
  gl_->BindSampler(0, 0);
  programs_->use(LookStage::halve);
  bool odd = false;
  glm::ivec2 size(picture.width(), picture.height());
  for (int level = 1; size != glm::ivec2(1); ++level) {
    odd = odd || size.x % 2 != 0 || size.y % 2 != 0;
    size = glm::max(size / 2, glm::ivec2(1));
    if (!odd) continue;
    gl_->TextureParameteri(name, GL_TEXTURE_BASE_LEVEL, level - 1);  // no level is read while it is written
    gl_->TextureParameteri(name, GL_TEXTURE_MAX_LEVEL, level - 1);
    level_.attachColor(0, name, level);
    gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, level_.name());
    gl_->ViewportIndexedf(0, 0.0f, 0.0f, static_cast<float>(size.x), static_cast<float>(size.y));
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_->TextureParameteri(name, GL_TEXTURE_BASE_LEVEL, 0);
  gl_->TextureParameteri(name, GL_TEXTURE_MAX_LEVEL, 1000);  // GL's own
}

void LookPicture::forget() {
  source_.forget();
  canvases_.forget();
  level_.forget();
  no_layout_.forget();
}

}  // namespace rg::glass
