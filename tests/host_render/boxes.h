// Scenes made of boxes.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace host {

/// A box in the file's axes (y up), seen from outside.
inline Primitive box(glm::vec3 min, glm::vec3 max, int material) {
  Primitive p;
  p.material = material;
  for (int axis = 0; axis < 3; ++axis) {
    for (float side : {-1.0F, 1.0F}) {
      glm::vec3 n(0.0F), u(0.0F), v(0.0F);
      n[axis] = side;
      u[(axis + 1) % 3] = side;
      v[(axis + 2) % 3] = 1.0F;
      const auto base = static_cast<std::uint32_t>(p.positions_m.size());
      for (glm::vec3 corner : {n - u - v, n + u - v, n + u + v, n - u + v}) {
        p.positions_m.push_back(glm::mix(min, max, 0.5F * (corner + 1.0F)));
        p.normals.push_back(n);
      }
      for (std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) p.indices.push_back(base + i);
    }
  }
  return p;
}

inline void add(Scene& scene, const Primitive& primitive) {
  Node node;
  node.mesh = static_cast<int>(scene.meshes.size());
  node.in_scene = true;
  scene.meshes.push_back({"", {primitive}});
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  scene.order.push_back(static_cast<int>(scene.nodes.size()));
  scene.nodes.push_back(node);
}

inline Material paint(glm::vec3 colour) {
  Material material;
  material.base_colour = glm::vec4(colour, 1.0F);
  material.metallic = 0.0F;
  return material;
}

}  // namespace host
