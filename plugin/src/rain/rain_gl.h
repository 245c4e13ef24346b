// Draws the falling drops.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "gl/loader.h"
#include "rain/picture.h"
#include "tick.h"

namespace rg::rain {

// A lamp near the drops, world coordinates; a cone with cos_outer -1 is a point lamp.
struct DropLamp {
  glm::dvec3 position_m{0.0};
  glm::vec3 direction{0.0f};
  glm::vec3 intensity{0.0f};
  float cos_inner = -1.0f;
  float cos_outer = -1.0f;
};

struct RainLighting {
  glm::vec3 sky_radiance{1.0f};
  glm::vec3 ground_radiance{0.2f};
  glm::vec3 sun_direction{0.0f};  // towards the sun, unit, or 0
  glm::vec3 sun_irradiance{0.0f};
  std::span<const DropLamp> lamps;  // the 16 nearest to the eye count
  uint32_t environment_cube = 0;    // GL_TEXTURE_CUBE_MAP with mips, or 0
};

struct RainTarget {
  uint32_t framebuffer = 0;
  uint32_t color_texture = 0;  // attached to it, or 0
  uint32_t depth_texture = 0;  // attached to it, or 0. With both given depth is read in the shader and
                               // streaks end softly at surfaces
  int32_t width_px = 0;
  int32_t height_px = 0;
  bool srgb = false;      // the target holds sRGB-encoded values; else linear radiance
  float exposure = 1.0f;  // what radiance was multiplied with before it was written
};

struct RainDraw {
  const ViewState* view = nullptr;
  glm::ivec4 viewport_px{0};
  int64_t time_ns = 0;
  RainTarget target;
  RainLighting lighting;
  // How much stronger than in nature a streak covers what is behind it. 1 = physical (Garg & Nayar), for
  // camera-sensor work; a 2 mm drop exposed for 1/60 s then changes what is behind it by about 1 %.
  float gain = 6.0f;
};

// [thread: GL, context current, for all of it]
class RainRenderer {
 public:
  RainRenderer(const gl::Context& context, uint32_t capacity);  // capacity as of the field
  ~RainRenderer();
  RainRenderer(const RainRenderer&) = delete;
  RainRenderer& operator=(const RainRenderer&) = delete;

  // Takes over what is new and empties `upload`. Touches: program, buffer bindings GL_SHADER_STORAGE_BUFFER 0
  // .. 2.
  void upload(Upload& upload);

  // Draws the drops as of the last upload, placed at draw.time_ns. Call within a state guard; touches:
  // program, vertex array, uniform buffers 0 .. 2, buffer bindings GL_SHADER_STORAGE_BUFFER 0 .. 2 and
  // GL_DRAW_INDIRECT_BUFFER, texture units 0 and 1 with their samplers, draw framebuffer, viewport, blend,
  // depth, raster state. Twice the same draw gives the same picture.
  void draw(const RainDraw& draw);

  void forget();  // the context is lost: free nothing

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace rg::rain
