#include "render/low_beam.h"

#include <algorithm>
#include <cmath>

namespace host {

float lowBeam(glm::vec3 away, glm::vec3 aim) {
  const float down = aim.z + kLowBeamAim_rad - away.z, aside = aim.x * away.y - aim.y * away.x;
  const float below = glm::smoothstep(-0.003F, 0.012F, down) / (1.0F + down * down * 278.0F);
  const float ahead = glm::dot(away, aim);
  return ahead > 0.0F ? below * std::exp2(-36.0F * aside * aside) + 0.016F * ahead : 0.0F;
}

}  // namespace host
