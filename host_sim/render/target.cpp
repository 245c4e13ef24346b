#include "render/target.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace host {

Target::Target(const Context& context, glm::ivec2 size_px) : gl_(context.gl()) { resize(size_px); }

Target::~Target() { release(); }

void Target::resize(glm::ivec2 size_px) {
  if (size_px == size_px_) return;
  release();
  size_px_ = size_px;
  gl_.CreateTextures(GL_TEXTURE_2D, 1, &colour_);
  gl_.TextureStorage2D(colour_, 1, GL_RGBA16F, size_px.x, size_px.y);
  gl_.CreateTextures(GL_TEXTURE_2D, 1, &depth_);
  gl_.TextureStorage2D(depth_, 1, GL_DEPTH_COMPONENT32F, size_px.x, size_px.y);
  for (GLuint texture : {colour_, depth_}) {
    gl_.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    gl_.TextureParameteri(texture, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl_.TextureParameteri(texture, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }
  gl_.CreateFramebuffers(1, &framebuffer_);
  gl_.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0);
  gl_.NamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
}

void Target::release() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &colour_);
  gl_.DeleteTextures(1, &depth_);
  framebuffer_ = colour_ = depth_ = 0;
}

ColourPicture::ColourPicture(const GladGLContext& gl, glm::ivec2 size_px) : gl_(gl), size_px_(size_px) {
  gl.CreateTextures(GL_TEXTURE_2D, 1, &colour_);
  gl.TextureStorage2D(colour_, 1, GL_RGBA16F, size_px.x, size_px.y);
  gl.TextureParameteri(colour_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TextureParameteri(colour_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TextureParameteri(colour_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.CreateFramebuffers(1, &framebuffer_);
  gl.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0);
}

ColourPicture::~ColourPicture() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &colour_);
}

MirrorPicture::MirrorPicture(const GladGLContext& gl, glm::ivec2 size_px) : gl_(gl), size_px_(size_px) {
  constexpr int kMostLevels = 4;
  const auto longer_px = static_cast<unsigned>(std::max(size_px.x, size_px.y));
  gl.CreateTextures(GL_TEXTURE_2D, 1, &colour_);
  gl.TextureStorage2D(colour_, std::min(kMostLevels, static_cast<int>(std::bit_width(longer_px))), GL_RGBA16F,
                      size_px.x, size_px.y);
  gl.TextureParameteri(colour_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  gl.TextureParameteri(colour_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TextureParameteri(colour_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.CreateTextures(GL_TEXTURE_2D, 1, &depth_);
  gl.TextureStorage2D(depth_, 1, GL_DEPTH_COMPONENT32F, size_px.x, size_px.y);
  gl.CreateFramebuffers(1, &framebuffer_);
  gl.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0);
  gl.NamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
}

MirrorPicture::~MirrorPicture() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &colour_);
  gl_.DeleteTextures(1, &depth_);
}

Picture::Picture(const Context& context, glm::ivec2 size_px) : gl_(context.gl()), size_px_(size_px) {
  gl_.CreateTextures(GL_TEXTURE_2D, 1, &colour_);
  gl_.TextureStorage2D(colour_, 1, GL_RGBA8, size_px.x, size_px.y);
  gl_.CreateFramebuffers(1, &framebuffer_);
  gl_.NamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, colour_, 0);
}

Picture::~Picture() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &colour_);
}

std::vector<std::uint8_t> Picture::read() const {
  const auto row = static_cast<std::size_t>(size_px_.x) * 3;
  const auto rows = static_cast<std::size_t>(size_px_.y);
  std::vector<std::uint8_t> bottom_first(row * rows), top_first(row * rows);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl_.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl_.GetTextureImage(colour_, 0, GL_RGB, GL_UNSIGNED_BYTE, static_cast<GLsizei>(bottom_first.size()),
                      bottom_first.data());
  for (std::size_t y = 0; y < rows; ++y) {
    std::copy_n(bottom_first.data() + y * row, row, top_first.data() + (rows - 1 - y) * row);
  }
  return top_first;
}

void beginPicture(const GladGLContext& gl, GLuint framebuffer, glm::ivec2 size_px) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, size_px.x, size_px.y);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthMask(GL_TRUE);
  gl.Disable(GL_BLEND);
  gl.Disable(GL_SCISSOR_TEST);
  gl.FrontFace(GL_CCW);
}

}  // namespace host
