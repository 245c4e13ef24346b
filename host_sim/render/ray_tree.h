// Which triangles a ray meets, on the CPU: a tree of boxes.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace host {

class RayTree {
 public:
  /// Takes triangles, three corners each.
  explicit RayTree(std::vector<glm::vec3> corners);
  /// Whether anything lies on the ray within `reach_m`. Both sides of a triangle count.
  bool hits(glm::vec3 from, glm::vec3 direction, float reach_m) const {
    return nearest(from, direction, reach_m) < reach_m;
  }
  /// How far the ray gets: `reach_m` when nothing stops it before.
  float nearest(glm::vec3 from, glm::vec3 direction, float reach_m) const;

 private:
  struct Box {
    glm::vec3 min{1e30F}, max{-1e30F};
    std::uint32_t first = 0;  ///< triangle, or of an inner box the second child (the first follows it)
    std::uint32_t count = 0;  ///< triangles, 0: an inner box
    int axis = 0;             ///< along which an inner box is divided, its first child lower
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order,
                      const std::vector<glm::vec3>& corners);

  std::vector<Box> boxes_;
  std::vector<glm::vec3> corners_;  ///< in the leaves' order
};

}  // namespace host
