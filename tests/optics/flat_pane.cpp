#include "flat_pane.h"

#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "glass/mesh_cut.h"
#include "glass/water.h"
#include "shared/glass_beads.glsl"

namespace rg::test {

using shared::GlassDropRecord;

FlatPane::Axes::Axes(double angle_from_horizontal_rad) {
  const double s = std::sin(angle_from_horizontal_rad), c = std::cos(angle_from_horizontal_rad);
  up = {-c, 0.0, s};
  outward = {s, 0.0, c};
}

FlatPane::FlatPane(const GladGLContext& gl, double angle_from_horizontal_rad, double size_m, int texels,
                   bool mirrored)
    : gl_(gl), size_m_(size_m), across_(mirrored ? -1.0 : 1.0), texels_(texels) {
  const Axes axes(angle_from_horizontal_rad);
  right = {0.0, -across_, 0.0};
  up = axes.up;
  outward = axes.outward;
  const double texel_m = size_m / texels;
  for (int corner = 0; corner < 4; ++corner) {
    const double u = corner & 1, v = corner >> 1;
    const glm::dvec3 p = (u - 0.5) * size_m * right + (v - 0.5) * size_m * up;
    for (const double x : {p.x, p.y, p.z, outward.x, outward.y, outward.z, u, v})
      mesh_.vertices.push_back(static_cast<float>(x));
  }
  mesh_.indices =
      mirrored ? std::vector<uint32_t>{0, 1, 2, 1, 3, 2} : std::vector<uint32_t>{0, 2, 1, 1, 2, 3};
  vertices_ = gl::Buffer(gl, std::span<const float>(mesh_.vertices));
  indices_ = gl::Buffer(gl, std::span<const uint32_t>(mesh_.indices));

  const auto count = static_cast<size_t>(texels) * static_cast<size_t>(texels);
  std::vector<glm::vec4> position(count);
  for (size_t k = 0; k < count; ++k) {
    const double u = (static_cast<double>(k % static_cast<size_t>(texels)) + 0.5) / texels - 0.5;
    const double v = (static_cast<double>(k / static_cast<size_t>(texels)) + 0.5) / texels - 0.5;
    position[k] = glm::vec4(glm::vec3(u * size_m * right + v * size_m * up), 1.0f);
  }
  position_ = gl::Texture2D(gl, GL_RGBA32F, texels, texels);
  position_.write(0, 0, 0, 0, texels, texels, GL_RGBA, GL_FLOAT, position.data());
  metric_ = gl::Texture2D(gl, GL_RGBA32F, texels, texels);
  const std::vector<glm::vec4> metric(count, glm::vec4(texel_m, texel_m, 0.0, texel_m * texel_m));
  metric_.write(0, 0, 0, 0, texels, texels, GL_RGBA, GL_FLOAT, metric.data());
  frame_ = gl::Texture2DArray(gl, GL_RGBA16F, texels, texels, 2);
  for (int layer = 0; layer < 2; ++layer) {
    const std::vector<glm::vec4> axis(count, glm::vec4(glm::vec3(layer == 0 ? right : up), 0.0f));
    frame_.write(0, 0, 0, layer, texels, texels, GL_RGBA, GL_FLOAT, axis.data());
  }
  pane.vertex_buffer = vertices_.name();
  pane.index_buffer = indices_.name();
  pane.index_count = 6;
  pane.radius_m = static_cast<float>(0.71 * size_m);
  pane.film_size = glm::ivec2(texels);
  pane.texel_m = static_cast<float>(texel_m);
  pane.position = position_.name();
  pane.metric = metric_.name();
  pane.frame = frame_.name();
}

void FlatPane::cutIntoPieces() {
  const glass::PieceMesh cut = glass::cutIntoPieces(mesh_, pane.film_size);
  vertices_ = gl::Buffer(gl_, std::span<const float>(cut.mesh.vertices));
  indices_ = gl::Buffer(gl_, std::span<const uint32_t>(cut.mesh.indices));
  pieces_ = gl::Buffer(gl_, std::span<const uint32_t>(cut.first));
  pane.vertex_buffer = vertices_.name();
  pane.index_buffer = indices_.name();
  pane.piece_buffer = pieces_.name();
  pane.index_count = static_cast<int32_t>(cut.tiles);
  pane.piece_index_count = static_cast<int32_t>(cut.mesh.indices.size());
}

GlassDropRecord FlatPane::cap(double u_m, double v_m, double base_radius_m, double contact_rad) const {
  GlassDropRecord drop{};
  drop.position_m = glm::vec2(across_ * u_m + 0.5 * size_m_, v_m + 0.5 * size_m_);
  drop.heading = glm::vec2(0.0f, -1.0f);
  drop.base_radius_m = static_cast<float>(base_radius_m);
  drop.height_m = static_cast<float>(base_radius_m * std::tan(0.5 * contact_rad));
  drop.elongation = 1.0f;
  return drop;
}

void FlatPane::putDrops(std::span<const GlassDropRecord> drops) {
  drops_ = gl::Buffer(gl_, drops);
  pane.drop_buffer = drops_.name();
  pane.drop_count = static_cast<int32_t>(drops.size());
}

void FlatPane::putFilm(const std::function<double(double, double)>& thickness_m) {
  const auto texels = static_cast<size_t>(texels_);
  const double texel_m = size_m_ / texels_;
  std::vector<int32_t> volume(texels * texels);
  for (size_t k = 0; k < volume.size(); ++k) {
    const double u = (static_cast<double>(k % texels) + 0.5) * texel_m - 0.5 * size_m_;
    const double v = (static_cast<double>(k / texels) + 0.5) * texel_m - 0.5 * size_m_;
    volume[k] = static_cast<int32_t>(
        std::lround(thickness_m(u, v) * texel_m * texel_m / static_cast<double>(shared::kPicolitre_m3)));
  }
  film_ = gl::Texture2D(gl_, GL_R32I, texels_, texels_);
  film_.write(0, 0, 0, 0, texels_, texels_, GL_RED_INTEGER, GL_INT, volume.data());
  pane.film = film_.name();
}

void FlatPane::putBeads(const std::function<int(double, double)>& number, double share, double contact_rad) {
  const auto texels = static_cast<size_t>(texels_);
  const double texel_m = size_m_ / texels_;
  std::vector<uint32_t> lying(texels * texels, 0);
  for (size_t k = 0; k < lying.size(); ++k) {
    const int count = number((static_cast<double>(k % texels) + 0.5) * texel_m - 0.5 * size_m_,
                             (static_cast<double>(k / texels) + 0.5) * texel_m - 0.5 * size_m_);
    if (count == 0) continue;
    shared::Beads beads{};
    beads.number = count;
    const double radius_m = std::sqrt(share * texel_m * texel_m / (glm::pi<double>() * count));
    beads.volume_pl =
        static_cast<int>(glass::picolitres(count * glass::capShape(contact_rad) * std::pow(radius_m, 3.0)));
    lying[k] = shared::packedBeads(beads);
  }
  beads_ = gl::Texture2D(gl_, GL_R32UI, texels_, texels_);
  beads_.write(0, 0, 0, 0, texels_, texels_, GL_RED_INTEGER, GL_UNSIGNED_INT, lying.data());
  pane.beads = beads_.name();
  pane.bead_contact_rad = static_cast<float>(contact_rad);
}

Picture draw(const GladGLContext& gl, glass::GlassLook& look, const Scene& scene,
             std::span<const glass::LookPane> panes) {
  gl::Texture2D color(gl, GL_RGBA16F, scene.size_px.x, scene.size_px.y);
  gl::Texture2D depth(gl, GL_DEPTH_COMPONENT32F, scene.size_px.x, scene.size_px.y);
  const gl::Framebuffer target(gl, {&color}, &depth);
  gl.DepthMask(GL_TRUE);  // the look leaves it off
  const float farthest = scene.view.reversed_depth ? 0.0f : 1.0f;
  const float depth_value = scene.depth < 0.0f ? farthest : scene.depth;
  gl.ClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &depth_value);
  color.zero();
  if (!scene.picture.empty())
    color.write(0, 0, 0, 0, scene.size_px.x, scene.size_px.y, GL_RGBA, GL_FLOAT, scene.picture.data());
  glass::LookTarget where;
  where.framebuffer = target.name();
  where.color_texture = color.name();
  if (!scene.depths.empty()) {
    depth.write(0, 0, 0, 0, scene.size_px.x, scene.size_px.y, GL_DEPTH_COMPONENT, GL_FLOAT,
                scene.depths.data());
    where.depth_texture = depth.name();
  }
  where.width_px = scene.size_px.x;
  where.height_px = scene.size_px.y;
  look.drawPanes(panes, scene.view, where, scene.light);
  return readTexture(gl, color.name());
}

glass::LookView forwardView(glm::ivec2 size_px, double horizontal_fov_rad, const glm::dvec3& eye_m) {
  glass::LookView view;
  view.eyeFromWorld = glm::lookAt(eye_m, eye_m + glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0));
  const double aspect = static_cast<double>(size_px.x) / size_px.y;
  view.clipFromEye =
      glm::perspective(2.0 * std::atan(std::tan(0.5 * horizontal_fov_rad) / aspect), aspect, 0.05, 1000.0);
  view.viewport_px = {0, 0, size_px.x, size_px.y};
  return view;
}

void writeSrgb(const std::string& path, const Picture& picture) {
  const auto encode = [](float x) {
    const float c = glm::clamp(x, 0.0f, 1.0f);
    return static_cast<unsigned char>(
        std::lround(255.0f * (c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1.0f / 2.4f) - 0.055f)));
  };
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return;
  std::fprintf(file, "P6\n%d %d\n255\n", picture.width, picture.height);
  for (int y = picture.height - 1; y >= 0; --y) {
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec4& p = picture.at(x, y);
      const unsigned char bytes[3] = {encode(p.x), encode(p.y), encode(p.z)};
      std::fwrite(bytes, 1, 3, file);
    }
  }
  std::fclose(file);
}

}  // namespace rg::test
