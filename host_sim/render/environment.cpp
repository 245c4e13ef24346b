#include "render/environment.h"

#include <cmath>
#include <vector>

namespace host {
namespace {

constexpr float kPi = 3.14159265F;
/// Of grass, fields and wet roads together, for the light that comes up from the ground.
constexpr glm::vec3 kGroundAlbedo{0.10F, 0.105F, 0.09F};
constexpr int kMeasureLevel = 4;  // 16 x 16 of 256 x 256: enough for irradiance, little to read back

GLuint makeCube(const GladGLContext& gl, int size, int levels) {
  GLuint cube = 0;
  gl.CreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
  gl.TextureStorage2D(cube, levels, GL_RGBA16F, size, size);
  gl.TextureParameteri(cube, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(cube, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return cube;
}

/// As shaders/cube.glsl.
glm::vec3 faceDirection(int face, float x, float y) {
  switch (face) {
    case 0:
      return {1.0F, -y, -x};
    case 1:
      return {-1.0F, -y, x};
    case 2:
      return {x, 1.0F, y};
    case 3:
      return {x, -1.0F, -y};
    case 4:
      return {x, -y, 1.0F};
    default:
      return {-x, -y, -1.0F};
  }
}

std::array<float, 9> basis(glm::vec3 d) {
  return {0.282095F,
          0.488603F * d.y,
          0.488603F * d.z,
          0.488603F * d.x,
          1.092548F * d.x * d.y,
          1.092548F * d.y * d.z,
          0.315392F * (3.0F * d.z * d.z - 1.0F),
          1.092548F * d.x * d.z,
          0.546274F * (d.x * d.x - d.y * d.y)};
}

/// Whether cubes drawn for `a` may stand for `b` but for their brightness.
bool alike(const Sky& a, const Sky& b) {
  const double drift = std::abs(std::log(overcastZenith(a) / overcastZenith(b)));
  return a.to_sun == b.to_sun && std::abs(cloudCover(a) - cloudCover(b)) < 0.02 &&
         (drift < 0.7 || cloudCover(a) < 1.0);
}

}  // namespace

Environment::Environment(const GladGLContext& gl)
    : gl_(gl),
      sky_program_(gl, {"full.vert"}, {"cube.glsl", "sky_cube.frag"}),
      picture_program_(gl, {"full.vert"}, {"cube.glsl", "latlong.glsl", "latlong_cube.frag"}),
      prefilter_program_(gl, {"full.vert"}, {"cube.glsl", "prefilter.frag"}) {
  sky_ = makeCube(gl, kSkySize, 9);
  mirrored_ = makeCube(gl, kMirrorSize, kMips);
  // One mip per look-up: half the cost in software, and neighbouring mips differ little.
  gl.TextureParameteri(mirrored_, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  gl.CreateFramebuffers(1, &framebuffer_);
  gl.CreateVertexArrays(1, &no_vertices_);
}

Environment::~Environment() {
  for (GLuint texture : {sky_, mirrored_, picture_}) gl_.DeleteTextures(1, &texture);
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteVertexArrays(1, &no_vertices_);
}

void Environment::setPicture(std::span<const float> rgb, int width, int height) {
  gl_.DeleteTextures(1, &picture_);
  gl_.CreateTextures(GL_TEXTURE_2D, 1, &picture_);
  gl_.TextureStorage2D(picture_, 1, GL_RGB16F, width, height);
  gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.TextureSubImage2D(picture_, 0, 0, 0, width, height, GL_RGB, GL_FLOAT, rgb.data());
  gl_.TextureParameteri(picture_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TextureParameteri(picture_, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  drawn_.reset();
}

void Environment::update(const Sky& sky) {
  if (picture_ != 0) {
    if (!drawn_) draw(sky);
    brightness_ = 1.0F;
    return;
  }
  if (!drawn_ || !alike(*drawn_, sky)) draw(sky);
  const bool overcast = cloudCover(*drawn_) >= 1.0;
  brightness_ = overcast ? static_cast<float>(overcastZenith(sky) / overcastZenith(*drawn_)) : 1.0F;
}

void Environment::draw(const Sky& sky) {
  drawn_ = sky;
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_BLEND);
  gl_.Disable(GL_CULL_FACE);
  if (picture_ != 0) {
    gl_.BindTextureUnit(0, picture_);
    faces(picture_program_, sky_, 0, kSkySize);
  } else {
    const auto cover = static_cast<float>(cloudCover(sky));
    const auto zenith = static_cast<float>(overcastZenith(sky));
    const auto day = static_cast<float>(daylight(sky));
    const glm::vec3 to_sun = glm::normalize(sky.to_sun);
    // Level ground under the sky: overcast 7/9 pi L, clear about 12 klx of sky, and the sun.
    const glm::vec3 irradiance =
        glm::mix(glm::vec3(11.0F, 12.0F, 14.0F) * day, glm::vec3(zenith * 7.0F / 9.0F * kPi), cover) +
        sunIrradiance(sky) * std::max(to_sun.z, 0.0F);
    sky_program_.set("u_cover", cover);
    sky_program_.set("u_zenith", zenith);
    sky_program_.set("u_day", day);
    sky_program_.set("u_to_sun", to_sun);
    sky_program_.set("u_ground", kGroundAlbedo * irradiance / kPi);
    faces(sky_program_, sky_, 0, kSkySize);
  }
  gl_.GenerateTextureMipmap(sky_);
  prefilter();
  measure();
}

void Environment::faces(const Program& program, GLuint cube, int level, int size) const {
  program.use();
  gl_.BindVertexArray(no_vertices_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, size, size);
  for (int face = 0; face < 6; ++face) {
    program.set("u_face", face);
    gl_.NamedFramebufferTextureLayer(framebuffer_, GL_COLOR_ATTACHMENT0, cube, level, face);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }
}

void Environment::prefilter() const {
  gl_.BindTextureUnit(4, sky_);
  for (int level = 0; level < kMips; ++level) {
    const float share = static_cast<float>(level) / (kMips - 1);
    const float roughness = share * share;  // the shader asks for mip sqrt(roughness) * lastMip
    prefilter_program_.set("u_roughness", std::max(roughness, 0.001F));
    prefilter_program_.set("u_source_lod", 1.0F + 0.75F * static_cast<float>(level));
    faces(prefilter_program_, mirrored_, level, kMirrorSize >> level);
  }
}

void Environment::measure() {
  constexpr int size = kSkySize >> kMeasureLevel;
  std::vector<glm::vec4> texels(6 * size * size);
  gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  gl_.GetTextureImage(sky_, kMeasureLevel, GL_RGBA, GL_FLOAT,
                      static_cast<GLsizei>(texels.size() * sizeof(glm::vec4)), texels.data());
  sh_.fill(glm::vec3(0.0F));
  upper_ = lower_ = horizon_ = glm::vec3(0.0F);
  float above = 0.0F, below = 0.0F, level = 0.0F;
  for (int i = 0; i < 6 * size * size; ++i) {
    const float x = (2.0F * static_cast<float>(i % size) + 1.0F) / size - 1.0F;
    const float y = (2.0F * static_cast<float>(i / size % size) + 1.0F) / size - 1.0F;
    const float solid_angle = 4.0F / (size * size) * std::pow(1.0F + x * x + y * y, -1.5F);
    const glm::vec3 to = glm::normalize(faceDirection(i / (size * size), x, y));
    const glm::vec3 radiance = solid_angle * glm::vec3(texels[static_cast<std::size_t>(i)]);
    const std::array<float, 9> y_lm = basis(to);
    for (std::size_t k = 0; k < 9; ++k) sh_[k] += radiance * y_lm[k];
    (to.z > 0.0F ? upper_ : lower_) += radiance;
    (to.z > 0.0F ? above : below) += solid_angle;
    if (to.z > 0.0F && to.z < 0.2F) horizon_ += radiance, level += solid_angle;
  }
  upper_ /= above;
  lower_ /= below;
  horizon_ /= level;
}

std::array<glm::vec4, 9> Environment::irradiance() const {
  // Cosine lobe per order over pi (1, 2/3, 1/4) times the basis' constants: Ramamoorthi & Hanrahan 2001, eqs.
  // 8 and 13.
  constexpr std::array<float, 9> factor = {0.282095F,         0.488603F * 2 / 3, 0.488603F * 2 / 3,
                                           0.488603F * 2 / 3, 1.092548F / 4,     1.092548F / 4,
                                           0.315392F / 4,     1.092548F / 4,     0.546274F / 4};
  std::array<glm::vec4, 9> result{};
  for (std::size_t k = 0; k < 9; ++k) result[k] = glm::vec4(sh_[k] * factor[k] * brightness_, 0.0F);
  return result;
}

}  // namespace host
