// Pictures read back from the GPU, for tests to look at.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace rg::test {

// Rows from the bottom up, as GL has them.
struct Picture {
  int width = 0, height = 0;
  std::vector<glm::vec4> pixels;
  const glm::vec4& at(int x, int y) const {
    return pixels[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

// Level 0 of a 2D texture of any colour format; waits for the GPU. Client pixel store must be at its
// defaults.
Picture readTexture(const GladGLContext& gl, GLuint texture, int level = 0);

// Colour 0 of a framebuffer.
Picture readFramebuffer(const GladGLContext& gl, GLuint framebuffer, int width, int height);

// Greatest difference in any of red, green and blue; the sizes must agree.
float greatestDifference(const Picture& a, const Picture& b);

// Writes an 8-bit binary PPM, clamped, without tone curve: to look at while working. False when it could not.
bool writePpm(const std::string& path, const Picture& picture);

}  // namespace rg::test
