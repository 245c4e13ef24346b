#include "render/instance.h"

#include <algorithm>
#include <cmath>

#include "render/low_beam.h"

namespace host {
namespace {

constexpr float kCandelaPerUnit = 1000.0F;
constexpr float kFaintest_klx = 0.004F;
constexpr float kFarthest_m = 60.0F, kFarthestBeam_m = 120.0F;
constexpr float kHeadlight_m = 0.06F;  // radius of its bright glass, as projectors and reflectors have it

}  // namespace

float lampReach(const LampNow& lamp) {
  const float brightest = std::max({lamp.intensity.x, lamp.intensity.y, lamp.intensity.z});
  return std::min(std::sqrt(brightest / kFaintest_klx), lamp.low_beam ? kFarthestBeam_m : kFarthest_m);
}

void Instance::place(const Placement& to) {
  placement = to;
  const std::vector<glm::mat4> nodes =
      scene->tree.sceneFromNode(to.poses.empty() ? scene->tree.restPoses() : to.poses);
  const glm::dmat4 world_from_file = to.world_from_host * glm::dmat4(scene->host_from_file);
  world_from_body.clear();
  for (int node : scene->bodies) {
    world_from_body.push_back(node < 0 ? world_from_file
                                       : world_from_file * glm::dmat4(nodes[static_cast<std::size_t>(node)]));
  }
  lamps.clear();
  for (const GpuLamp& lamp : scene->lamps) {
    const float level = lamp.role < 0 ? 1.0F : to.lamp_levels[static_cast<std::size_t>(lamp.role)];
    if (level <= 0.0F) continue;
    const glm::dmat4 world_from_lamp =
        world_from_file * glm::dmat4(nodes[static_cast<std::size_t>(lamp.node)]);
    LampNow now;
    now.position_m = glm::dvec3(world_from_lamp[3]);
    now.direction = -glm::normalize(glm::vec3(world_from_lamp[2]));
    now.intensity = lamp.light.colour * (lamp.light.intensity * level / kCandelaPerUnit);
    if (lamp.role == static_cast<int>(LightRole::Head)) {
      // A spot's flat middle would burn two discs into the road before the bumper.
      now.low_beam = true;
      now.cos_inner = 1.0F;
      now.cos_outer = std::cos(0.24F);
    } else if (lamp.light.kind == LightKind::Spot) {
      now.cos_inner = std::cos(lamp.light.inner_cone_rad);
      now.cos_outer = std::cos(lamp.light.outer_cone_rad);
    }
    lamps.push_back(now);
  }
}

void Instance::addGlares(glm::dvec3 eye_m, std::vector<Glare>& glares) const {
  for (const LampNow& lamp : lamps) {
    const glm::vec3 away(glm::normalize(eye_m - lamp.position_m));
    const float share = lamp.low_beam ? lowBeam(away, lamp.direction) : 0.0F;
    if (share > 0.0F)
      glares.push_back({lamp.position_m, share * lamp.intensity, kHeadlight_m, scene->headlights_glow});
  }
  for (const GpuGlow& glow : scene->glows) {
    const glm::vec3 intensity =
        glow.radiance_area * placement.lamp_levels[static_cast<std::size_t>(glow.role)];
    const glm::dvec3 position_m(worldFromHost() * glm::dvec4(glow.position_m, 1.0));
    const glm::dvec3 normal(worldFromHost() * glm::dvec4(glow.normal, 0.0));
    const auto cosine = static_cast<float>(glm::dot(glm::normalize(eye_m - position_m), normal));
    if (cosine > 0.0F && intensity != glm::vec3(0.0F))
      glares.push_back({position_m, cosine * intensity, std::sqrt(cosine * glow.area_m2 / 3.14159F), true});
  }
}

}  // namespace host
