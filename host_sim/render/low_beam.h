// How a dipped headlight spreads its light.
#pragma once

#include <glm/glm.hpp>

namespace host {

constexpr float kLowBeamAim_rad = 0.0436F;  // a light node of role `head` looks 2.5 degrees down

/// Intensity in a direction (unit, away from the lamp, z up) relative to the brightest; `aim`: where the
/// lamp's node looks. As scene.frag's lowBeam(), which says where it is from.
float lowBeam(glm::vec3 away, glm::vec3 aim);

}  // namespace host
