// Radiance HDR pictures as cubes, for tests of what drops show.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gl/objects.h"

namespace rg::test {

// Latitude-longitude picture: x forward at the middle, y left, z up; rows from the top.
struct Panorama {
  int width = 0, height = 0;
  std::vector<glm::vec3> pixels;
  glm::vec3 towards(const glm::vec3& direction) const;  // bilinear
};

// Radiance RGBE with new-style run lengths (Ward, 1991). Throws std::runtime_error.
Panorama readRadiance(const std::string& path);

// Cube of radiance(direction) in world axes, with mips.
template <class Radiance>
gl::TextureCube makeCube(const GladGLContext& gl, int size_px, const Radiance& radiance) {
  gl::TextureCube cube(gl, GL_RGBA16F, size_px, gl::fullMipLevels(size_px, size_px));
  std::vector<glm::vec4> pixels(static_cast<size_t>(size_px) * static_cast<size_t>(size_px));
  for (int face = 0; face < 6; ++face) {
    for (size_t k = 0; k < pixels.size(); ++k) {
      const float s =
          (static_cast<float>(k % static_cast<size_t>(size_px)) + 0.5f) * 2.0f / static_cast<float>(size_px) -
          1.0f;
      const float t =
          (static_cast<float>(k / static_cast<size_t>(size_px)) + 0.5f) * 2.0f / static_cast<float>(size_px) -
          1.0f;
      // OpenGL 4.5, table 8.19.
      const glm::vec3 towards[6] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                    {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
      pixels[k] = glm::vec4(radiance(glm::normalize(towards[face])), 1.0f);
    }
    cube.write(0, 0, 0, face, size_px, size_px, GL_RGBA, GL_FLOAT, pixels.data());
  }
  cube.generateMipmaps();
  return cube;
}

}  // namespace rg::test
