// What all draws of a view share, as shaders/frame.glsl declares it.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace host {

constexpr int kMaxLamps = 64;

/// std140, so members are as laid out here. See shaders/frame.glsl for their meaning.
struct FrameBlock {
  glm::mat4 clip_from_rel{1.0F};
  glm::mat4 shadow_from_rel{1.0F};
  std::array<glm::vec4, 9> sh{};
  glm::vec4 to_sun{0.0F};
  glm::vec4 sun{0.0F};
  glm::vec4 haze{0.0F};
  glm::vec4 air{0.0F};
  glm::vec4 eye{0.0F};
  glm::vec4 plane{0.0F};
  glm::vec4 screen{0.0F};
  glm::mat4 car_from_rel{1.0F};
  glm::vec4 car{0.0F};
  std::array<glm::vec4, kMaxLamps> lamp_place{};
  std::array<glm::vec4, kMaxLamps> lamp_aim{};
  std::array<glm::vec4, kMaxLamps> lamp_intensity{};
};
static_assert(sizeof(FrameBlock) == (8 + 9 + 5 + 7 + 3 * kMaxLamps) * sizeof(glm::vec4));

}  // namespace host
