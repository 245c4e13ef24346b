// How much of the sky is seen from inside a shelter (a tunnel, below a canopy, in a cabin): rays against the
// scene's own triangles, once at loading, on a coarse grid of points in a box around the shelter. It makes
// tunnels dark with a bright mouth, and tells the eye how far to open.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "render/ray_tree.h"

namespace host {

/// The light that comes in at points of a box, relative to the zenith of an overcast sky: x its mean over all
/// directions, yzw its gradient (L(w) ~ x + yzw . w). Radiance of the CIE overcast sky where a ray is free;
/// where it is blocked, of lit ground outside the shelter or of the dark inside.
struct SkyGrid {
  std::string name;
  glm::mat4 box_from_scene{1.0F};  ///< 0..1 in the box, its borders included
  glm::ivec3 cells{2};
  glm::vec3 border{0.1F};  ///< share of the box on each side where it fades into the open
  float probe_step_m =
      0.3F;  ///< surfaces ask that far before them, so that a wall does not take from behind it
  std::vector<glm::vec4> light;  ///< cells.x * y * z, x fastest
  float lit = 1.0F;              ///< how bright the air in it is on the mean, by that in the open

  /// How far the point is inside: 0 outside, 1 within the borders.
  float share(glm::vec3 scene_m) const;
  /// Interpolated light.
  glm::vec4 at(glm::vec3 scene_m) const;
};

/// Light in the open, in the same measure.
constexpr glm::vec4 kOpenSky{0.3333F, 0.0F, 0.0F, 0.5833F};

/// Measures around the hull of `points_m`. `step_m`: points' distance aimed at; `border_m`: how far the box
/// reaches beyond the hull.
SkyGrid measureSky(const RayTree& tree, std::span<const glm::vec3> points_m, float step_m, float border_m);

}  // namespace host
