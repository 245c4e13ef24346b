// A windscreen's mesh, for tests of the glass below the ABI and through it.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace rg::test {

inline constexpr double kPi = std::numbers::pi;
inline double rad(double degrees) { return degrees * kPi / 180.0; }

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec2> uvs;
  std::vector<uint32_t> indices;
};

// A windscreen: width along the vehicle's y, raked by `slope` from the horizontal, its upper edge behind;
// bulging by `bulge_m` in its middle.
inline Mesh windscreen(double width_m = 1.5, double height_m = 0.8, double slope_rad = kPi / 6.0,
                       double bulge_m = 0.0, int cells = 8) {
  Mesh mesh;
  const glm::dvec3 normal(std::sin(slope_rad), 0.0, std::cos(slope_rad));
  const glm::dvec3 up(-std::cos(slope_rad), 0.0, std::sin(slope_rad));
  const glm::dvec3 right(0.0, -1.0, 0.0);
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double s = static_cast<double>(i) / cells, t = static_cast<double>(j) / cells;
      const double out = bulge_m * (1.0 - std::pow(2.0 * s - 1.0, 2.0));
      mesh.positions.emplace_back(right * ((s - 0.5) * width_m) + up * ((t - 0.5) * height_m) + normal * out +
                                  glm::dvec3(1.5, 0.0, 1.2));
      mesh.uvs.emplace_back(static_cast<float>(s), static_cast<float>(t));
    }
  }
  // Seen from outside, right of the inner view is left: counter-clockwise there.
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const auto a = static_cast<uint32_t>(j * (cells + 1) + i), b = a + 1,
                 c = a + static_cast<uint32_t>(cells) + 1, d = c + 1;
      mesh.indices.insert(mesh.indices.end(), {a, c, b, b, c, d});
    }
  }
  return mesh;
}

}  // namespace rg::test
