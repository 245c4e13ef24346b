// What a car's flat mirrors show: the world and the car itself drawn once more, through each that is seen.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "window/context.h"

namespace host {

/// A mirror's plane and outline as an eye sees it, relative to the eye, world axes.
struct SeenMirror {
  glm::vec3 normal{0.0F};  ///< unit, towards the eye
  float offset_m = 0.0F;   ///< the plane is where normal . p = offset; negative, as the eye is before it
  glm::ivec2 corner_px{0}, size_px{0};  ///< the rectangle of the picture that holds it
};

/// None where the eye is behind it or it is not in the picture. `outline_rel`: its vertices.
std::optional<SeenMirror> seenMirror(std::span<const glm::vec3> outline_rel, glm::vec3 normal,
                                     const glm::mat4& clip_from_rel, glm::ivec2 size_px);

/// Clip from the world (relative to the eye) as it is seen in the mirror, for a picture of the rectangle
/// alone. What lies behind the mirror is before the near plane. Turns faces round.
glm::mat4 clipOfMirrored(const SeenMirror& mirror, const glm::mat4& clip_from_rel, glm::ivec2 size_px);

}  // namespace host
