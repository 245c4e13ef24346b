// A scene placed in the world.
#pragma once

#include <vector>

#include "render/gpu_scene.h"
#include "render/renderer.h"

namespace host {

struct Instance {
  const GpuScene* scene = nullptr;
  Placement placement;
  std::vector<glm::dmat4> world_from_body;
  std::vector<LampNow> lamps;  ///< those that shine
  bool traffic = false;        ///< seen in every picture
  float open = 1.0F;  ///< share of the sky's light that reaches it as a whole: 1 for roads, whose shelters
                      ///< count per pixel

  void place(const Placement& to);
  /// Its lamps as an eye looks into them, added to `glares`.
  void addGlares(glm::dvec3 eye_m, std::vector<Glare>& glares) const;
  glm::dmat4 worldFromHost() const { return placement.world_from_host; }
};

/// How far a lamp is worth drawing by, m.
float lampReach(const LampNow& lamp);

}  // namespace host
