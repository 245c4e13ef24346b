#include "render/gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/mesh_merge.h"
#include "render/renderer.h"
#include "scene/views.h"

namespace host {
namespace {

constexpr float kCell_m = 40.0F;             // culling and lamps go by these squares
constexpr float kReachOfBlockers_m = 60.0F;  // what is further from a shelter does not shade it

void wrap(const GladGLContext& gl, GLuint texture, const Sampler& sampler) {
  gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(sampler.mag_filter));
  gl.TextureParameteri(texture, GL_TEXTURE_WRAP_S, static_cast<GLint>(sampler.wrap_s));
  gl.TextureParameteri(texture, GL_TEXTURE_WRAP_T, static_cast<GLint>(sampler.wrap_t));
}

float meanRoughness(const Scene& scene, const Material& material) {
  if (!material.metallic_roughness_map) return material.roughness;
  const Image& image = scene.images[static_cast<std::size_t>(material.metallic_roughness_map.image)];
  double sum = 0.0;
  for (std::size_t i = 1; i < image.rgba.size(); i += 4) sum += image.rgba[i];
  return material.roughness *
         static_cast<float>(sum / 255.0 /
                            static_cast<double>(std::max<std::size_t>(image.rgba.size() / 4, 1)));
}

std::vector<glm::vec3> nearTriangles(const std::vector<glm::vec3>& corners, const glm::mat4& host_from_file,
                                     const std::vector<ShelterView>& shelters) {
  std::vector<glm::vec3> near;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    glm::vec3 t[3];
    for (std::size_t k = 0; k < 3; ++k) t[k] = glm::vec3(host_from_file * glm::vec4(corners[i + k], 1.0F));
    const glm::vec3 min = glm::min(t[0], glm::min(t[1], t[2])), max = glm::max(t[0], glm::max(t[1], t[2]));
    const bool reaches = std::any_of(shelters.begin(), shelters.end(), [&](const ShelterView& shelter) {
      glm::vec3 low(1e30F), high(-1e30F);
      for (glm::vec3 p : shelter.points_m) low = glm::min(low, p), high = glm::max(high, p);
      return glm::all(glm::lessThan(min, high + kReachOfBlockers_m)) &&
             glm::all(glm::greaterThan(max, low - kReachOfBlockers_m));
    });
    if (reaches) near.insert(near.end(), t, t + 3);
  }
  return near;
}

}  // namespace

GpuScene::GpuScene(const GladGLContext& gl, const Scene& scene, SceneFrame its_frame)
    : frame(its_frame),
      host_from_file(its_frame == SceneFrame::Car ? vehicleFromGltf() : worldFromGltf()),
      gl_(gl) {
  tree.nodes = scene.nodes;
  tree.roots = scene.roots;
  tree.order = scene.order;
  uploadMaterials(scene);
  uploadMeshes(scene);
  for (int index : scene.order) {
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    if (node.light < 0 || scene.lights[static_cast<std::size_t>(node.light)].kind == LightKind::Directional)
      continue;
    const auto* meaning = std::get_if<LightMeaning>(&node.meaning);
    lamps.push_back({index, meaning ? static_cast<int>(meaning->role) : -1,
                     scene.lights[static_cast<std::size_t>(node.light)]});
  }
  if (frame == SceneFrame::Car) measureGlows(scene);
  measureShelters(scene);
}

GpuScene::~GpuScene() {
  gl_.DeleteTextures(static_cast<GLsizei>(textures_.size()), textures_.data());
  gl_.DeleteVertexArrays(1, &vertex_array);
  gl_.DeleteBuffers(1, &vertices_);
  gl_.DeleteBuffers(1, &indices_);
}

void GpuScene::uploadMaterials(const Scene& scene) {
  for (const Material& from : scene.materials) {
    GpuMaterial to;
    const auto take = [&](const TextureUse& use, Feature feature, GLuint& texture, bool mask = false) {
      if (!use) return;
      texture = upload(scene, use, mask);
      to.features |= feature;
    };
    const bool mask = from.alpha_mode == AlphaMode::Mask;
    take(from.base_colour_map, kBaseMap, to.base_map, mask);
    take(from.metallic_roughness_map, kRoughnessMap, to.roughness_map);
    take(from.normal_map, kNormalMap, to.normal_map);
    take(from.emissive_map, kGlowMap, to.glow_map);
    if (mask && from.base_colour_map) to.features |= kMask;
    if (from.alpha_mode == AlphaMode::Blend) to.features |= kBlend;
    to.base = from.base_colour;
    to.surface = {from.metallic, std::max(from.roughness, 0.02F), from.alpha_cutoff, from.normal_scale};
    to.glow = from.emissive;
    to.double_sided = from.double_sided;
    // Rough ground (grass, gravel, bark: 0.9 and more) takes water in; asphalt, concrete and paint are
    // covered by it.
    const float roughness = meanRoughness(scene, from);
    to.film = frame == SceneFrame::Road && !mask ? 1.0F - glm::smoothstep(0.87F, 0.94F, roughness) : 0.0F;
    if (roughness < 0.6F || from.metallic > 0.5F || (to.features & kBlend)) to.features |= kGlossy;
    materials.push_back(to);
  }
}

GLuint GpuScene::upload(const Scene& scene, const TextureUse& use, bool mask) {
  const Image& image = scene.images[static_cast<std::size_t>(use.image)];
  const int levels =
      1 + static_cast<int>(std::floor(std::log2(std::max({image.width_px, image.height_px, 1}))));
  GLuint texture = 0;
  gl_.CreateTextures(GL_TEXTURE_2D, 1, &texture);
  gl_.TextureStorage2D(texture, levels, GL_RGBA8, image.width_px, image.height_px);
  gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
  gl_.TextureSubImage2D(texture, 0, 0, 0, image.width_px, image.height_px, GL_RGBA, GL_UNSIGNED_BYTE,
                        image.rgba.data());
  gl_.GenerateTextureMipmap(texture);
  wrap(gl_, texture, use.sampler);
  if (mask) gl_.TextureParameteri(texture, GL_TEXTURE_MAX_LEVEL, std::max(levels - 4, 0));
  textures_.push_back(texture);
  return texture;
}

void GpuScene::uploadMeshes(const Scene& scene) {
  const MergedScene merged = mergeScene(scene, frame == SceneFrame::Road ? kCell_m : 0.0F);
  bodies = merged.bodies;
  for (const MergedDraw& from : merged.draws) {
    draws.push_back({from.first, from.count, from.body, from.material, from.part, from.role,
                     0.5F * (from.min_m + from.max_m), 0.5F * (from.max_m - from.min_m)});
  }
  if (frame == SceneFrame::Car) {
    glm::vec3 min(1e30F), max(-1e30F);
    for (const MergedVertex& v : merged.vertices) {
      const glm::vec3 p(host_from_file * glm::vec4(v.position_m, 1.0F));
      min = glm::min(min, p), max = glm::max(max, p);
    }
    // A little less than its bounds: bumpers are round and mirrors stand out.
    footprint = {0.45F * (max.x - min.x), 0.42F * (max.y - min.y), 0.5F * (max.x + min.x), max.z};
  }
  const auto make = [&](GLuint& buffer, const void* data, std::size_t bytes) {
    gl_.CreateBuffers(1, &buffer);
    gl_.NamedBufferStorage(buffer, static_cast<GLsizeiptr>(std::max<std::size_t>(bytes, 4)),
                           bytes > 0 ? data : nullptr, 0);
  };
  make(vertices_, merged.vertices.data(), merged.vertices.size() * sizeof(MergedVertex));
  make(indices_, merged.indices.data(), merged.indices.size() * sizeof(std::uint32_t));
  gl_.CreateVertexArrays(1, &vertex_array);
  gl_.VertexArrayVertexBuffer(vertex_array, 0, vertices_, 0, sizeof(MergedVertex));
  gl_.VertexArrayElementBuffer(vertex_array, indices_);
  const auto attribute = [&](GLuint index, GLint size, GLenum type, GLboolean normalised,
                             std::size_t offset) {
    gl_.EnableVertexArrayAttrib(vertex_array, index);
    gl_.VertexArrayAttribFormat(vertex_array, index, size, type, normalised, static_cast<GLuint>(offset));
    gl_.VertexArrayAttribBinding(vertex_array, index, 0);
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(MergedVertex, position_m));
  attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(MergedVertex, normal));
  attribute(2, 2, GL_FLOAT, GL_FALSE, offsetof(MergedVertex, uv));
  attribute(3, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(MergedVertex, colour));
  attribute(4, 4, GL_BYTE, GL_TRUE, offsetof(MergedVertex, tangent));
}

/// Headlights have lights of their own beside their mesh. A mesh holds the lamps of both sides.
void GpuScene::measureGlows(const Scene& scene) {
  for (int index : scene.order) {
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    const auto* meaning = std::get_if<LightMeaning>(&node.meaning);
    if (meaning == nullptr || node.mesh < 0) continue;
    if (meaning->role == LightRole::Head) {
      headlights_glow = true;
      continue;
    }
    const glm::mat4 matrix = host_from_file * node.scene_from_node;
    GpuGlow sides[2];
    glm::vec3 normals[2]{}, middles[2]{};
    float areas[2]{};
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const glm::vec3 glow = scene.materials[static_cast<std::size_t>(p.material)].emissive * kGlow;
      for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        glm::vec3 t[3];
        for (std::size_t k = 0; k < 3; ++k)
          t[k] = glm::vec3(matrix * glm::vec4(p.positions_m[p.indices[i + k]], 1.0F));
        const glm::vec3 area = 0.5F * glm::cross(t[1] - t[0], t[2] - t[0]);
        const glm::vec3 middle = (t[0] + t[1] + t[2]) / 3.0F;
        const std::size_t side = middle.y > 0.0F ? 0 : 1;
        normals[side] += area;
        middles[side] += glm::length(area) * middle;
        areas[side] += glm::length(area);
        sides[side].radiance_area = glow;
      }
    }
    for (std::size_t side = 0; side < 2; ++side) {
      const float area_m2 = glm::length(normals[side]);  // what of it faces one way
      if (area_m2 <= 0.0F) continue;
      glows.push_back({static_cast<int>(meaning->role), middles[side] / areas[side], normals[side] / area_m2,
                       sides[side].radiance_area * area_m2, area_m2});
    }
  }
}

void GpuScene::measureShelters(const Scene& scene) {
  const bool car = frame == SceneFrame::Car;
  const std::vector<ShelterView> shelters = car ? carView(scene).shelters : roadView(scene).shelters;
  if (shelters.empty()) return;
  const RayTree tree_of_rays(nearTriangles(opaqueTriangles(scene), host_from_file, shelters));
  for (const ShelterView& shelter : shelters) {
    GpuGrid made;
    made.grid = measureSky(tree_of_rays, shelter.points_m, car ? 0.22F : 3.0F, car ? 0.12F : 3.0F);
    made.grid.name = shelter.name;
    const glm::ivec3 n = made.grid.cells;
    gl_.CreateTextures(GL_TEXTURE_3D, 1, &made.texture);
    gl_.TextureStorage3D(made.texture, 1, GL_RGBA16F, n.x, n.y, n.z);
    gl_.TextureSubImage3D(made.texture, 0, 0, 0, 0, n.x, n.y, n.z, GL_RGBA, GL_FLOAT, made.grid.light.data());
    gl_.TextureParameteri(made.texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    for (const GLenum axis :
         {GLenum{GL_TEXTURE_WRAP_S}, GLenum{GL_TEXTURE_WRAP_T}, GLenum{GL_TEXTURE_WRAP_R}}) {
      gl_.TextureParameteri(made.texture, axis, GL_CLAMP_TO_EDGE);
    }
    textures_.push_back(made.texture);
    grids.push_back(std::move(made));
  }
}

}  // namespace host
