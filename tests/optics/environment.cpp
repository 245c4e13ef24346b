#include "environment.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace rg::test {
namespace {

// One row's four channels, each as runs: a length above 128 repeats a byte, else that many bytes follow.
std::vector<uint8_t> readRow(std::ifstream& in, size_t width) {
  std::array<uint8_t, 4> head{};
  in.read(reinterpret_cast<char*>(head.data()), 4);
  if (head[0] != 2 || head[1] != 2) throw std::runtime_error("not run-length coded");
  std::vector<uint8_t> row(width * 4);
  for (size_t at = 0; at < row.size();) {
    const int length = in.get();
    if (length < 0) throw std::runtime_error("ends early");
    const bool repeat = length > 128;
    const int count = repeat ? length - 128 : length;
    for (int k = 0, value = 0; k < count && at < row.size(); ++k) {
      if (k == 0 || !repeat) value = in.get();
      row[at++] = static_cast<uint8_t>(value);
    }
  }
  return row;
}

}  // namespace

Panorama readRadiance(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  while (std::getline(in, line) && !line.starts_with("-Y ")) {
  }
  Panorama out;
  if (std::sscanf(line.c_str(), "-Y %d +X %d", &out.height, &out.width) != 2)
    throw std::runtime_error(path + ": no Radiance picture");
  const auto width = static_cast<size_t>(out.width);
  for (int y = 0; y < out.height; ++y) {
    const std::vector<uint8_t> row = readRow(in, width);
    for (size_t x = 0; x < width; ++x) {
      const float scale = std::ldexp(1.0f, row[3 * width + x] - 136);
      out.pixels.push_back(scale * glm::vec3(row[x], row[width + x], row[2 * width + x]));
    }
  }
  return out;
}

glm::vec3 Panorama::towards(const glm::vec3& d) const {
  const float pi = 3.14159265f;
  const float x = (0.5f - std::atan2(d.y, d.x) / (2.0f * pi)) * static_cast<float>(width) - 0.5f;
  const float y = (0.5f - std::asin(glm::clamp(d.z, -1.0f, 1.0f)) / pi) * static_cast<float>(height) - 0.5f;
  const float fx = x - std::floor(x), fy = y - std::floor(y);
  const auto pixel = [&](int column, int row) {
    const int wrapped = (column % width + width) % width, clamped = glm::clamp(row, 0, height - 1);
    return pixels[static_cast<size_t>(clamped) * static_cast<size_t>(width) + static_cast<size_t>(wrapped)];
  };
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  return glm::mix(glm::mix(pixel(column, row), pixel(column + 1, row), fx),
                  glm::mix(pixel(column, row + 1), pixel(column + 1, row + 1), fx), fy);
}

}  // namespace rg::test
