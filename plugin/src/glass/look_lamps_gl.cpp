#include "glass/look_lamps_gl.h"

#include <glad/gl.h>

#include <algorithm>
#include <vector>

namespace rg::glass {
namespace {

// As in shaders/optics/lamps.glsl (std430).
struct LampsBlock {
  struct Lamp {
    glm::vec4 place_inner, direction_outer, intensity;
  } lamps[kMostLookLamps];
  int32_t count;
  int32_t unused[3];
};
static_assert(sizeof(LampsBlock) == 48 * kMostLookLamps + 16, "std430 lays it out so");

struct AtEye {
  const LookLamp* lamp;
  double irradiance;
};

// Without the cone's soft edge: it only says which lamps matter.
double irradianceAt(const glm::dvec3& eye_m, const LookLamp& lamp) {
  const glm::dvec3 way = eye_m - lamp.position_m;
  const double distance_m = std::max(glm::length(way), 0.1);
  const double cosine = glm::dot(way, glm::dvec3(lamp.direction)) / distance_m;
  if (lamp.cos_outer > -1.0f && cosine <= static_cast<double>(lamp.cos_outer)) return 0.0;
  const double brightest =
      static_cast<double>(std::max({lamp.intensity.x, lamp.intensity.y, lamp.intensity.z}));
  return brightest / (distance_m * distance_m);
}

}  // namespace

LookLamps::LookLamps(const GladGLContext& gl, LookPrograms& programs)
    : gl_(&gl), programs_(&programs), block_(gl, sizeof(LampsBlock)) {}

bool LookLamps::put(std::span<const LookLamp> lamps, const glm::dvec3& eye_world_m) {
  std::vector<AtEye> shining;
  for (const LookLamp& lamp : lamps) {
    const double irradiance = irradianceAt(eye_world_m, lamp);
    if (irradiance > 0.0) shining.push_back({&lamp, irradiance});
  }
  if (shining.empty()) return false;
  std::ranges::stable_sort(shining, std::ranges::greater{}, &AtEye::irradiance);
  shining.resize(std::min<size_t>(shining.size(), kMostLookLamps));
  LampsBlock block{};
  for (const AtEye& seen : shining) {
    const LookLamp& lamp = *seen.lamp;
    block.lamps[block.count++] = {glm::vec4(glm::vec3(lamp.position_m - eye_world_m), lamp.cos_inner),
                                  glm::vec4(lamp.direction, lamp.cos_outer), glm::vec4(lamp.intensity, 0.0f)};
  }
  block_.write(0, &block, sizeof block);
  gl_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, block_.name());
  return true;
}

void LookLamps::hide() {
  programs_->use(LookStage::hide);
  gl_->DispatchCompute(1, 1, 1);
  gl_->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void LookLamps::forget() { block_.forget(); }

}  // namespace rg::glass
