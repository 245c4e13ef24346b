// Wet panes before painted pictures: what tests of the look share.
#pragma once

#include <glm/gtc/constants.hpp>
#include <random>

#include "environment.h"
#include "flat_pane.h"
#include "gl_fixture.h"

namespace rg::test {

inline const double kRake = glm::radians(30.0);
inline const double kFov = glm::radians(40.0);

inline std::vector<glm::vec4> paint(glm::ivec2 size_px, const std::function<glm::vec3(int x, int y)>& color) {
  std::vector<glm::vec4> pixels;
  for (int y = 0; y < size_px.y; ++y) {
    for (int x = 0; x < size_px.x; ++x) pixels.emplace_back(color(x, y), 1.0f);
  }
  return pixels;
}

inline std::vector<shared::GlassDropRecord> scatter(const FlatPane& pane, int count, double radius_m,
                                                    double contact_rad, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.12, 0.12);
  std::vector<shared::GlassDropRecord> drops;
  for (int k = 0; k < count; ++k) {
    drops.push_back(pane.cap(place(random), place(random), radius_m, contact_rad));
    drops.back().seed = static_cast<uint32_t>(k) * 7919u + 1u;
  }
  return drops;
}

inline glm::vec3 checks(int x, int y) { return glm::vec3(static_cast<float>((x / 8 + y / 8) % 2)); }

class Look : public GlTest {
 protected:
  Scene inside(glm::ivec2 size_px) const {
    Scene scene;
    scene.size_px = size_px;
    scene.view = forwardView(size_px, kFov);
    return scene;
  }
  glass::GlassLook look{gl};
};

}  // namespace rg::test
