#include "render/ray_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace host {
namespace {

constexpr std::uint32_t kLeaf = 6;

bool meetsBox(glm::vec3 min, glm::vec3 max, glm::vec3 from, glm::vec3 inverse, float reach_m) {
  const glm::vec3 a = (min - from) * inverse;
  const glm::vec3 b = (max - from) * inverse;
  const glm::vec3 in = glm::min(a, b), out = glm::max(a, b);
  return std::max({in.x, in.y, in.z, 0.0F}) <= std::min({out.x, out.y, out.z, reach_m});
}

/// Where the ray meets a triangle, or `reach_m` (Moeller & Trumbore 1997).
float meetsTriangle(const glm::vec3* corner, glm::vec3 from, glm::vec3 direction, float reach_m) {
  const glm::vec3 u = corner[1] - corner[0], v = corner[2] - corner[0];
  const glm::vec3 p = glm::cross(direction, v);
  const float det = glm::dot(u, p);
  if (std::abs(det) < 1e-12F) return reach_m;
  const glm::vec3 s = from - corner[0];
  const float a = glm::dot(s, p) / det;
  if (a < 0.0F || a > 1.0F) return reach_m;
  const glm::vec3 q = glm::cross(s, u);
  const float b = glm::dot(direction, q) / det;
  if (b < 0.0F || a + b > 1.0F) return reach_m;
  const float t = glm::dot(v, q) / det;
  return t > 1e-4F && t < reach_m ? t : reach_m;
}

}  // namespace

RayTree::RayTree(std::vector<glm::vec3> corners) {
  const auto count = static_cast<std::uint32_t>(corners.size() / 3);
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0U);
  corners_.reserve(corners.size());
  if (count > 0) build(0, count, order, corners);
  for (std::uint32_t triangle : order) {
    for (std::uint32_t k = 0; k < 3; ++k) corners_.push_back(corners[3 * triangle + k]);
  }
}

std::uint32_t RayTree::build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order,
                             const std::vector<glm::vec3>& corners) {
  const auto self = static_cast<std::uint32_t>(boxes_.size());
  boxes_.emplace_back();
  Box box{.first = first, .count = count};
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      box.min = glm::min(box.min, corners[3 * order[i] + k]);
      box.max = glm::max(box.max, corners[3 * order[i] + k]);
    }
  }
  if (count > kLeaf) {
    const glm::vec3 size = box.max - box.min;
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const auto middle = [&](std::uint32_t t) {
      return corners[3 * t][axis] + corners[3 * t + 1][axis] + corners[3 * t + 2][axis];
    };
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto half = static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(begin, begin + half, begin + static_cast<std::ptrdiff_t>(count),
                     [&](std::uint32_t a, std::uint32_t b) { return middle(a) < middle(b); });
    build(first, count / 2, order, corners);
    box.first = build(first + count / 2, count - count / 2, order, corners);
    box.count = 0;
    box.axis = axis;
  }
  boxes_[self] = box;
  return self;
}

float RayTree::nearest(glm::vec3 from, glm::vec3 direction, float reach_m) const {
  if (boxes_.empty()) return reach_m;
  const glm::vec3 inverse = 1.0F / direction;
  std::uint32_t stack[64] = {0};
  int depth = 1;
  while (depth > 0) {
    const std::uint32_t index = stack[--depth];
    const Box& box = boxes_[index];
    if (!meetsBox(box.min, box.max, from, inverse, reach_m)) continue;
    if (box.count == 0) {
      // The nearer child is looked into first: what it holds shortens the ray for the other.
      const bool first_is_near = direction[box.axis] > 0.0F;
      stack[depth++] = first_is_near ? box.first : index + 1;
      stack[depth++] = first_is_near ? index + 1 : box.first;
      continue;
    }
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
      reach_m = meetsTriangle(&corners_[3 * static_cast<std::size_t>(i)], from, direction, reach_m);
    }
  }
  return reach_m;
}

}  // namespace host
