#include "render/shadow.h"

#include <cmath>

namespace host {
namespace {

constexpr int kSize = 2048;
constexpr double kHalfWidth_m = 80.0;
constexpr double kHalfDepth_m = 250.0;

}  // namespace

Shadow::Shadow(const GladGLContext& gl)
    : gl_(gl),
      solid_(gl, {"shadow.vert"}, {"shadow.frag"}),
      cut_out_(gl, {"shadow.vert"}, {"shadow.frag"}, {"MASK"}) {
  gl.CreateTextures(GL_TEXTURE_2D, 1, &texture_);
  gl.TextureStorage2D(texture_, 1, GL_DEPTH_COMPONENT32F, kSize, kSize);
  gl.TextureParameteri(texture_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TextureParameteri(texture_, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  gl.TextureParameteri(texture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl.TextureParameteri(texture_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl.TextureParameteri(texture_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const float lit[4] = {1.0F, 1.0F, 1.0F, 1.0F};
  gl.TextureParameterfv(texture_, GL_TEXTURE_BORDER_COLOR, lit);
  gl.CreateFramebuffers(1, &framebuffer_);
  gl.NamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, texture_, 0);
}

Shadow::~Shadow() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &texture_);
}

void Shadow::draw(std::span<const Instance* const> instances, glm::vec3 to_sun, glm::dvec3 eye_m) {
  const glm::dvec3 z = glm::normalize(glm::dvec3(to_sun));
  const glm::dvec3 x =
      glm::normalize(glm::cross(std::abs(z.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), z));
  const glm::dvec3 y = glm::cross(z, x);
  constexpr double texel_m = 2.0 * kHalfWidth_m / kSize;
  const glm::dvec3 middle{std::floor(glm::dot(x, eye_m) / texel_m) * texel_m,
                          std::floor(glm::dot(y, eye_m) / texel_m) * texel_m, glm::dot(z, eye_m)};
  const glm::dmat4 sun_from_world = glm::transpose(glm::dmat4(
      glm::dvec4(x, -middle.x), glm::dvec4(y, -middle.y), glm::dvec4(z, -middle.z), glm::dvec4(0, 0, 0, 1)));
  // Near the sun 0, far 1: ordinary depth in zero to one.
  glm::dmat4 map_from_sun(1.0);
  map_from_sun[0][0] = map_from_sun[1][1] = 1.0 / kHalfWidth_m;
  map_from_sun[2][2] = -0.5 / kHalfDepth_m;
  map_from_sun[3][2] = 0.5;
  map_from_world_ = map_from_sun * sun_from_world;

  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, kSize, kSize);
  gl_.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthMask(GL_TRUE);
  gl_.DepthFunc(GL_LESS);
  gl_.Disable(GL_CULL_FACE);
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(2.0F, 4.0F);
  const float far = 1.0F;
  gl_.ClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far);
  for (const Instance* instance : instances) {
    gl_.BindVertexArray(instance->scene->vertex_array);
    for (const GpuDraw& draw : instance->scene->draws) {
      const GpuMaterial& material = instance->scene->materials[static_cast<std::size_t>(draw.material)];
      if (draw.part == kPanes || (material.features & kBlend)) continue;
      const glm::mat4 map_from_body(map_from_world_ *
                                    instance->world_from_body[static_cast<std::size_t>(draw.body)]);
      const glm::vec3 at(map_from_body * glm::vec4(draw.middle, 1.0F));
      const float reach = static_cast<float>(1.0 / kHalfWidth_m) * glm::length(draw.half);
      if (std::abs(at.x) > 1.0F + reach || std::abs(at.y) > 1.0F + reach) continue;
      const Program& program = material.features & kMask ? cut_out_ : solid_;
      program.use();
      program.set("u_shadow_from_body", map_from_body);
      if (material.features & kMask) gl_.BindTextureUnit(0, material.base_map);
      gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(draw.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(std::uintptr_t{draw.first} * sizeof(std::uint32_t)));
    }
  }
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
}

glm::mat4 Shadow::mapFromRel(glm::dvec3 eye_m) const {
  glm::dmat4 map_from_rel = map_from_world_;
  map_from_rel[3] = map_from_rel * glm::dvec4(eye_m, 1.0);
  glm::dmat4 texture_from_map(1.0);
  texture_from_map[0][0] = texture_from_map[1][1] = 0.5;
  texture_from_map[3] = glm::dvec4(0.5, 0.5, 0.0, 1.0);
  return glm::mat4(texture_from_map * map_from_rel);
}

}  // namespace host
