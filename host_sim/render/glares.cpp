#include "render/glares.h"

#include <algorithm>
#include <cmath>

namespace host {

GlarePainter::GlarePainter(const GladGLContext& gl)
    : gl_(gl), program_(gl, {"frame.glsl", "glare.vert"}, {"glare.frag"}) {
  gl_.CreateVertexArrays(1, &no_vertices_);
}

GlarePainter::~GlarePainter() { gl_.DeleteVertexArrays(1, &no_vertices_); }

// Stands a little before its lamp, so that the lamp's own mesh does not hide it.
void GlarePainter::paint(std::span<const Glare> glares, const View& view, glm::ivec2 size_px,
                         double extinction_per_m) {
  constexpr float kBefore_m = 0.35F;
  constexpr float kDrawnWell_px = 2.5F;  // radius
  const glm::dvec3 eye_m(glm::inverse(view.eye_from_world)[3]);
  gl_.Enable(GL_BLEND);
  gl_.BlendFunc(GL_ONE, GL_ONE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GREATER);
  gl_.DepthMask(GL_FALSE);
  gl_.Disable(GL_CULL_FACE);
  gl_.BindVertexArray(no_vertices_);
  program_.use();
  program_.set("u_focal", 0.5F * glm::vec2(size_px) *
                              glm::vec2(static_cast<float>(view.projection[0][0]),
                                        static_cast<float>(view.projection[1][1])));
  for (const Glare& lamp : glares) {
    const glm::vec3 place(lamp.position_m - eye_m);
    const float distance_m = std::max(glm::length(place), 2.0F * kBefore_m);
    const float radius_px =
        lamp.radius_m / distance_m * 0.5F * static_cast<float>(size_px.y * view.projection[1][1]);
    const float shown = lamp.mesh_glows ? glm::clamp(kDrawnWell_px - radius_px, 0.0F, 1.0F) : 1.0F;
    if (shown <= 0.0F) continue;
    const float clear = std::exp(-static_cast<float>(extinction_per_m) * distance_m);
    const float area_m2 = 3.14159F * lamp.radius_m * lamp.radius_m;
    program_.set("u_place", glm::vec4(place * (1.0F - kBefore_m / distance_m), lamp.radius_m));
    program_.set("u_radiance", lamp.intensity * (shown * clear / area_m2));
    gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_BLEND);
}

}  // namespace host
