#include "rain/draw_gl.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "rain/region.h"
#include "shared/rain_look.glsl"

namespace rg::rain {
namespace {

using glm::dvec3, glm::vec3, glm::vec4;
using shared::RainLook;

vec4 wide(const vec3& v) { return vec4(v, 0.0f); }

constexpr double kFarthestLamp_m = 1e9;  // squares of floats overflow at 1e19; nothing is seen of it by then

// The lamps nearest to the eye, seen from it.
uint32_t setLamps(std::span<const DropLamp> given, const dvec3& eye, RainLook& look) {
  std::vector<const DropLamp*> lamps;
  for (const DropLamp& lamp : given) {
    if (glm::distance(lamp.position_m, eye) < kFarthestLamp_m) lamps.push_back(&lamp);
  }
  const size_t count = std::min<size_t>(lamps.size(), shared::kRainLamps);
  std::partial_sort(lamps.begin(), lamps.begin() + static_cast<std::ptrdiff_t>(count), lamps.end(),
                    [&](const DropLamp* a, const DropLamp* b) {
                      return glm::distance(a->position_m, eye) < glm::distance(b->position_m, eye);
                    });
  for (size_t i = 0; i < count; ++i) {
    look.lamps[i] = {vec4(vec3(lamps[i]->position_m - eye), lamps[i]->cos_inner),
                     vec4(lamps[i]->direction, lamps[i]->cos_outer), wide(lamps[i]->intensity)};
  }
  return static_cast<uint32_t>(count);
}

void setLight(const RainLighting& lighting, RainLook& look) {
  look.sky = wide(lighting.sky_radiance);
  look.ground = wide(lighting.ground_radiance);
  look.sun_direction = wide(lighting.sun_direction);
  look.sun_irradiance =
      wide(glm::length(lighting.sun_direction) > 0.0f ? lighting.sun_irradiance : vec3(0.0f));
}

void setView(const RainDraw& draw, RainLook& look) {
  const glm::dmat4& p = draw.view->clipFromEye;
  const glm::dmat3 eyeFromWorld(draw.view->eyeFromWorld);
  look.clipFromWorldAtEye = glm::mat4(p * glm::dmat4(eyeFromWorld));
  look.forward = wide(vec3(glm::transpose(eyeFromWorld) * dvec3(0, 0, -1)));
  look.viewport = vec4(draw.viewport_px);
  // Lengths, of pictures that stand on their heads too.
  look.focal = vec4(0.5 * std::abs(p[0][0]) * draw.viewport_px.z,
                    0.5 * std::abs(p[1][1]) * draw.viewport_px.w, draw.gain, draw.target.exposure);
  look.depth_rows = vec4(p[2][2], p[3][2], p[2][3], p[3][3]);
  look.zero_to_one = draw.view->clip_zero_to_one ? 1 : 0;
  look.srgb = draw.target.srgb ? 1 : 0;
}

uint32_t levelsOfCube(const GladGLContext& gl, GLuint cube) {
  if (cube == 0) return 0;
  GLint size = 0;
  gl.GetTextureLevelParameteriv(cube, 0, GL_TEXTURE_WIDTH, &size);
  return static_cast<uint32_t>(std::floor(std::log2(std::max(size, 1)))) + 1;
}

}  // namespace

Canvas::Canvas(const GladGLContext& gl)
    : gl_(gl),
      look_(gl, sizeof(RainLook)),
      nearest_(gl, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE),
      mipmapped_(gl, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE),
      colour_only_(gl),
      block_(std::make_unique<RainLook>()) {}
Canvas::~Canvas() = default;

// With the depth buffer read in the shader it must not be attached: the host's colour goes on a framebuffer
// of ours.
void Canvas::bindTarget(const RainTarget& target) {
  if (!readsDepth(target)) {
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    return;
  }
  colour_only_.attachColor(0, target.color_texture);
  colour_only_.drawColors(1);
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, colour_only_.name());
}

void Canvas::setState(const RainDraw& draw) {
  const glm::ivec4& v = draw.viewport_px;
  gl_.ViewportIndexedf(0, static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
                       static_cast<float>(v.w));
  gl_.ClipControl(GL_LOWER_LEFT, draw.view->clip_zero_to_one ? GL_ZERO_TO_ONE : GL_NEGATIVE_ONE_TO_ONE);
  gl_.Enablei(GL_BLEND, 0);
  gl_.BlendEquationSeparatei(0, GL_FUNC_ADD, GL_FUNC_ADD);
  gl_.BlendFuncSeparatei(0, GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO,
                         GL_ONE);  // the target's alpha is the host's
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_DEPTH_CLAMP);  // the host's near plane does not cut drops
  gl_.DepthMask(GL_FALSE);
  if (readsDepth(draw.target)) {
    gl_.Disable(GL_DEPTH_TEST);
    gl_.BindTextureUnit(0, draw.target.depth_texture);
    gl_.BindSampler(0, nearest_.name());
  } else {
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(draw.view->reversed_depth ? GL_GEQUAL : GL_LEQUAL);
  }
  if (draw.target.color_texture != 0) {
    // Read by kernels between draws, not while one draws.
    gl_.BindTextureUnit(2, draw.target.color_texture);
    gl_.BindSampler(2, nearest_.name());
  }
  if (draw.lighting.environment_cube != 0) {
    gl_.BindTextureUnit(1, draw.lighting.environment_cube);
    gl_.BindSampler(1, mipmapped_.name());
  }
}

void Canvas::begin(const RainDraw& draw) {
  RainLook& look = *block_;
  setView(draw, look);
  setLight(draw.lighting, look);
  look.lamp_count = setLamps(draw.lighting.lamps, coneOf(*draw.view).eye_m, look);
  look.colour_behind = draw.target.color_texture != 0 ? 1 : 0;
  look.environment = levelsOfCube(gl_, draw.lighting.environment_cube);
  look_.write(0, &look, sizeof look);
  bindTarget(draw.target);
  setState(draw);
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, 2, look_.name());
}

void Canvas::forget() {
  look_.forget();
  nearest_.forget();
  mipmapped_.forget();
  colour_only_.forget();
}

}  // namespace rg::rain
