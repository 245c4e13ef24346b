#include "render/car_mirrors.h"

#include <algorithm>

namespace host {

std::optional<SeenMirror> seenMirror(std::span<const glm::vec3> outline_rel, glm::vec3 normal,
                                     const glm::mat4& clip_from_rel, glm::ivec2 size_px) {
  constexpr float kGrazing = 0.02F;  // m of the eye before its plane
  constexpr int kSmallest_px = 6;    // less shows nothing
  SeenMirror mirror{normal, glm::dot(normal, outline_rel.front()), {}, {}};
  if (mirror.offset_m > -kGrazing) return std::nullopt;
  glm::vec2 low(1.0F), high(-1.0F);
  for (const glm::vec3& p : outline_rel) {
    const glm::vec4 clip = clip_from_rel * glm::vec4(p, 1.0F);
    if (clip.w < 0.01F) return std::nullopt;  // beside or behind the eye
    low = glm::min(low, glm::vec2(clip) / clip.w);
    high = glm::max(high, glm::vec2(clip) / clip.w);
  }
  const glm::vec2 size(size_px);
  mirror.corner_px = glm::max(glm::ivec2(glm::floor((low * 0.5F + 0.5F) * size)), 0);
  mirror.size_px = glm::min(glm::ivec2(glm::ceil((high * 0.5F + 0.5F) * size)), size_px) - mirror.corner_px;
  if (std::min(mirror.size_px.x, mirror.size_px.y) < kSmallest_px) return std::nullopt;
  return mirror;
}

// Reversed depth with the mirror as its near plane, oblique to the view (after Lengyel 2005): z = w there,
// and z > 0 as far as can be seen.
glm::mat4 clipOfMirrored(const SeenMirror& mirror, const glm::mat4& clip_from_rel, glm::ivec2 size_px) {
  constexpr float kFall = 0.3F;
  const glm::vec3 n = mirror.normal;
  glm::mat4 mirrored_from_rel(1.0F);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) mirrored_from_rel[column][row] -= 2.0F * n[row] * n[column];
  }
  mirrored_from_rel[3] = glm::vec4(2.0F * mirror.offset_m * n, 1.0F);
  const glm::vec2 scale = glm::vec2(size_px) / glm::vec2(mirror.size_px);
  const glm::vec2 middle =
      (glm::vec2(mirror.corner_px) + 0.5F * glm::vec2(mirror.size_px)) / glm::vec2(size_px) * 2.0F - 1.0F;
  glm::mat4 cropped(1.0F);
  cropped[0][0] = scale.x;
  cropped[1][1] = scale.y;
  cropped[3][0] = -middle.x * scale.x;
  cropped[3][1] = -middle.y * scale.y;
  glm::mat4 clip = cropped * clip_from_rel * mirrored_from_rel;
  // Its own face, which may be seen from both sides, is not before itself.
  constexpr float kFace_m = 2e-3F;
  const glm::vec4 before(n, -mirror.offset_m - kFace_m);
  for (int column = 0; column < 4; ++column) clip[column][2] = clip[column][3] - kFall * before[column];
  return clip;
}

}  // namespace host
