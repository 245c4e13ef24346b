#include "picture.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace rg::test {
namespace {

Picture blank(int width, int height) {
  return {width, height, std::vector<glm::vec4>(static_cast<size_t>(width) * static_cast<size_t>(height))};
}

GLsizei byteSize(const Picture& picture) {
  return static_cast<GLsizei>(picture.pixels.size() * sizeof(glm::vec4));
}

}  // namespace

Picture readTexture(const GladGLContext& gl, GLuint texture, int level) {
  GLint width = 0, height = 0;
  gl.GetTextureLevelParameteriv(texture, level, GL_TEXTURE_WIDTH, &width);
  gl.GetTextureLevelParameteriv(texture, level, GL_TEXTURE_HEIGHT, &height);
  Picture picture = blank(width, height);
  gl.GetTextureImage(texture, level, GL_RGBA, GL_FLOAT, byteSize(picture), picture.pixels.data());
  return picture;
}

Picture readFramebuffer(const GladGLContext& gl, GLuint framebuffer, int width, int height) {
  GLint before = 0;
  gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  Picture picture = blank(width, height);
  gl.ReadnPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, byteSize(picture), picture.pixels.data());
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
  return picture;
}

float greatestDifference(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) throw std::invalid_argument("pictures of different size");
  float greatest = 0.0f;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::vec4 d = glm::abs(a.pixels[i] - b.pixels[i]);
    greatest = std::max({greatest, d.x, d.y, d.z});
  }
  return greatest;
}

bool writePpm(const std::string& path, const Picture& picture) {
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << picture.width << ' ' << picture.height << "\n255\n";
  for (int y = picture.height - 1; y >= 0; --y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        file.put(static_cast<char>(std::lround(std::clamp(picture.at(x, y)[c], 0.0f, 1.0f) * 255.0f)));
      }
    }
  }
  return file.good();
}

}  // namespace rg::test
