// What of some instances is in a view, in the order it is to be drawn.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "render/instance.h"

namespace host {

struct DrawItem {
  const Instance* instance = nullptr;
  const GpuDraw* draw = nullptr;
  glm::mat4 rel_from_body{1.0F};
  glm::vec3 middle{0.0F}, half{0.0F};  ///< bounds, relative to the eye, world axes
  float distance_m = 0.0F;             ///< eye to bounds, 0 within
  int rank = 0;                        ///< solid near to far in bands, cut out alike, blended
  const GpuMaterial& material() const {
    return instance->scene->materials[static_cast<std::size_t>(draw->material)];
  }
};

class DrawList {
 public:
  /// `least_size`: bounds that are smaller than that share of their distance are left out,
  /// and those beyond `farthest_m`.
  DrawList(glm::dvec3 eye_m, const glm::mat4& clip_from_rel, float least_size = 0.0F,
           float farthest_m = 1e9F);
  void add(const Instance& instance, unsigned parts);
  /// Solid parts from near to far, then cut-out ones, then blended ones from far to near. Far off, those that
  /// look alike stand together, so that they can be drawn at once.
  void sort();
  const std::vector<DrawItem>& items() const { return items_; }

 private:
  glm::dvec3 eye_m_;
  std::array<glm::vec4, 5> planes_;  ///< left, right, bottom, top, near: inside where positive
  float least_size_, farthest_m_;
  std::vector<DrawItem> items_;
};

}  // namespace host
