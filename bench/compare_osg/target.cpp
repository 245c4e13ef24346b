#include "target.h"

#include <cmath>
#include <vector>

namespace compare {

Target::Target(const GladGLContext& context) : gl(context) {
  gl.CreateTextures(GL_TEXTURE_2D, 1, &colour);
  gl.CreateTextures(GL_TEXTURE_2D, 1, &depth);
  gl.TextureStorage2D(colour, 1, GL_RGBA16F, kWidth_px, kHeight_px);
  gl.TextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, kWidth_px, kHeight_px);
  gl.CreateFramebuffers(1, &framebuffer);
  gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, colour, 0);
  gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, kWidth_px, kHeight_px);
}

void Cover::add(const Target& target) {
  std::vector<float> red(size_t{kWidth_px} * kHeight_px);
  target.gl.GetTextureImage(target.colour, 0, GL_RED, GL_FLOAT,
                            static_cast<GLsizei>(red.size() * sizeof(float)), red.data());
  for (size_t i = 0; i < red.size(); ++i) {
    const size_t column = i % kWidth_px / kBlock_px, row = i / kWidth_px / kBlock_px;
    black_[row * kColumns + column] += red[i] > 0.0f ? 0.0 : 1.0;
  }
  pictures_ += 1.0;
}

double Cover::px() const {
  static_assert(kWidth_px % kBlock_px == 0 && kHeight_px % kBlock_px == 0);
  const double pixels = kBlock_px * kBlock_px * pictures_;
  double sum = 0.0;
  for (const double black : black_) sum -= kBlock_px * kBlock_px * std::log(std::max(black, 0.5) / pixels);
  return sum;
}

}  // namespace compare
