// What all drawing of rain shares: a picture as it is asked for, and the canvas for it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "gl/loader.h"
#include "gl/objects.h"
#include "tick.h"

namespace rg::shared {
struct RainLook;
}

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
  float gain = 1.0f;
};

// The host's target as rain is drawn into it, and light and view as shaders want them.
// [thread: GL, context current, for all of it]
class Canvas {
 public:
  explicit Canvas(const GladGLContext& gl);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // Binds uniform buffer 2 (the look), the draw framebuffer, texture units 0 (depth, where it is read), 1
  // (environment) and 2 (the target's colour so far) with their samplers; sets viewport, blending
  // ("premultiplied over"; the target's alpha stays) and depth state. Call within a state guard.
  void begin(const RainDraw& draw);
  // Whether depth is read in the shader; else it is tested.
  static bool readsDepth(const RainTarget& target) {
    return target.color_texture != 0 && target.depth_texture != 0;
  }

  void forget();

 private:
  void bindTarget(const RainTarget& target);
  void setState(const RainDraw& draw);

  const GladGLContext& gl_;
  gl::Buffer look_;
  gl::Sampler nearest_, mipmapped_;
  gl::Framebuffer colour_only_;
  std::unique_ptr<shared::RainLook> block_;
};

}  // namespace rg::rain
