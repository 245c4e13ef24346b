#include "render/mesh_merge.h"

#include <cmath>
#include <map>
#include <tuple>

#include "render/renderer.h"

namespace host {
namespace {

template <typename... Kinds>
bool means(const Node& node) {
  return (std::holds_alternative<Kinds>(node.meaning) || ...);
}

/// Which body each node belongs to: that of the nearest node above it, itself included, that can move.
std::vector<int> bodiesOf(const Scene& scene, std::vector<int>& bodies) {
  std::vector<bool> moves(scene.nodes.size(), false);
  for (const Animation& animation : scene.animations) {
    for (const AnimationChannel& channel : animation.channels)
      moves[static_cast<std::size_t>(channel.node)] = true;
  }
  bodies = {-1};
  std::vector<int> body(scene.nodes.size(), 0);
  for (int index : scene.order) {
    const auto i = static_cast<std::size_t>(index);
    const Node& node = scene.nodes[i];
    if (moves[i] ||
        means<WiperMeaning, WheelMeaning, SteeringWheelMeaning, NeedleMeaning, DigitMeaning>(node)) {
      body[i] = static_cast<int>(bodies.size());
      bodies.push_back(index);
    } else if (node.parent >= 0) {
      body[i] = body[static_cast<std::size_t>(node.parent)];
    }
  }
  return body;
}

/// The nearest meaning above a node decides its part and whose lamp it is.
std::pair<unsigned, int> partAndRole(const Scene& scene, int index) {
  unsigned part = kBody;
  int role = -1;
  for (int i = index; i >= 0; i = scene.nodes[static_cast<std::size_t>(i)].parent) {
    const Node& node = scene.nodes[static_cast<std::size_t>(i)];
    if (means<WiperMeaning>(node)) part = kWipers;
    if (means<PaneMeaning>(node)) part = kPanes;
    if (const auto* light = std::get_if<LightMeaning>(&node.meaning); light && role < 0)
      role = static_cast<int>(light->role);
  }
  return {part, role};
}

std::int16_t toShort(float v) {
  return static_cast<std::int16_t>(std::lround(glm::clamp(v, -1.0F, 1.0F) * 32767.0F));
}
std::int8_t toByte(float v) {
  return static_cast<std::int8_t>(std::lround(glm::clamp(v, -1.0F, 1.0F) * 127.0F));
}

glm::vec2 transformed(const TextureUse& use, glm::vec2 uv) {
  const float c = std::cos(use.rotation_rad), s = std::sin(use.rotation_rad);
  const glm::vec2 scaled = use.scale * uv;
  return use.offset + glm::vec2(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
}

/// All maps of a material share one set of coordinates here: the base colour's, or whichever map there is.
const TextureUse& leadingMap(const Material& material) {
  for (const TextureUse* use : {&material.base_colour_map, &material.emissive_map, &material.normal_map,
                                &material.metallic_roughness_map}) {
    if (*use) return *use;
  }
  return material.base_colour_map;
}

MergedVertex vertex(const Primitive& primitive, std::size_t i, const glm::mat4& matrix,
                    const glm::mat3& normals, const TextureUse& map) {
  MergedVertex v{};
  v.position_m = glm::vec3(matrix * glm::vec4(primitive.positions_m[i], 1.0F));
  const glm::vec3 n = normals * primitive.normals[i];
  const glm::vec3 unit = n / std::max(glm::length(n), 1e-20F);
  v.normal = {toShort(unit.x), toShort(unit.y), toShort(unit.z), 0};
  const std::vector<glm::vec2>& uv = map.uv_set == 1 ? primitive.uv1 : primitive.uv0;
  if (!uv.empty()) v.uv = transformed(map, uv[i]);
  v.colour = {255, 255, 255, 255};
  if (!primitive.colours.empty()) {
    for (int k = 0; k < 4; ++k) {
      const float channel = glm::clamp(primitive.colours[i][k], 0.0F, 1.0F);
      v.colour[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(channel * 255.0F));
    }
  }
  if (!primitive.tangents.empty()) {
    const glm::vec3 t = glm::mat3(matrix) * glm::vec3(primitive.tangents[i]);
    const glm::vec3 along = t / std::max(glm::length(t), 1e-20F);
    v.tangent = {toByte(along.x), toByte(along.y), toByte(along.z), toByte(primitive.tangents[i].w)};
  }
  return v;
}

using Key = std::tuple<unsigned, int, int, int, int, int>;  // part, body, material, role, cell

struct Group {
  std::vector<MergedVertex> vertices;
  std::vector<std::uint32_t> indices;
};

void addPrimitive(const Primitive& primitive, const Material& material, const glm::mat4& matrix, Key key,
                  float cell_m, std::map<Key, Group>& groups) {
  const glm::mat3 normals = glm::transpose(glm::inverse(glm::mat3(matrix)));
  const bool mirrored = glm::determinant(glm::mat3(matrix)) < 0.0F;
  std::map<Key, std::vector<std::size_t>> triangles;
  for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
    if (cell_m > 0.0F) {
      const glm::vec3 middle = primitive.positions_m[primitive.indices[t]];
      const glm::vec4 at = matrix * glm::vec4(middle, 1.0F);
      std::get<4>(key) = static_cast<int>(std::floor(at.x / cell_m));
      std::get<5>(key) = static_cast<int>(std::floor(at.z / cell_m));
    }
    triangles[key].push_back(t);
  }
  std::vector<std::uint32_t> place(primitive.positions_m.size());
  constexpr std::uint32_t kNone = ~0U;
  for (const auto& [cell, list] : triangles) {
    Group& group = groups[cell];
    place.assign(place.size(), kNone);
    for (std::size_t t : list) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t i = primitive.indices[t + (mirrored && k > 0 ? 3 - k : k)];
        if (place[i] == kNone) {
          place[i] = static_cast<std::uint32_t>(group.vertices.size());
          group.vertices.push_back(vertex(primitive, i, matrix, normals, leadingMap(material)));
        }
        group.indices.push_back(place[i]);
      }
    }
  }
}

}  // namespace

MergedScene mergeScene(const Scene& scene, float cell_m) {
  MergedScene merged;
  const std::vector<int> body = bodiesOf(scene, merged.bodies);
  std::map<Key, Group> groups;
  for (int index : scene.order) {
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    if (node.mesh < 0 || means<ShelterMeaning>(node)) continue;
    const int its_body = body[static_cast<std::size_t>(index)];
    const int mover = merged.bodies[static_cast<std::size_t>(its_body)];
    const glm::mat4 body_from_scene =
        mover < 0 ? glm::mat4(1.0F)
                  : glm::inverse(scene.nodes[static_cast<std::size_t>(mover)].scene_from_node);
    const auto [part, role] = partAndRole(scene, index);
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const Key key{part, its_body, primitive.material, role, 0, 0};
      addPrimitive(primitive, scene.materials[static_cast<std::size_t>(primitive.material)],
                   body_from_scene * node.scene_from_node, key, mover < 0 ? cell_m : 0.0F, groups);
    }
  }
  for (const auto& [key, group] : groups) {
    MergedDraw draw;
    std::tie(draw.part, draw.body, draw.material, draw.role, std::ignore, std::ignore) = key;
    draw.first = static_cast<std::uint32_t>(merged.indices.size());
    draw.count = static_cast<std::uint32_t>(group.indices.size());
    const auto base = static_cast<std::uint32_t>(merged.vertices.size());
    for (std::uint32_t i : group.indices) merged.indices.push_back(base + i);
    for (const MergedVertex& v : group.vertices) {
      draw.min_m = glm::min(draw.min_m, v.position_m);
      draw.max_m = glm::max(draw.max_m, v.position_m);
    }
    merged.vertices.insert(merged.vertices.end(), group.vertices.begin(), group.vertices.end());
    merged.draws.push_back(draw);
  }
  return merged;
}

std::vector<glm::vec3> opaqueTriangles(const Scene& scene) {
  std::vector<glm::vec3> corners;
  for (int index : scene.order) {
    const Node& node = scene.nodes[static_cast<std::size_t>(index)];
    if (node.mesh < 0 || means<ShelterMeaning, PaneMeaning>(node)) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (scene.materials[static_cast<std::size_t>(primitive.material)].alpha_mode != AlphaMode::Opaque)
        continue;
      for (std::uint32_t i : primitive.indices) {
        corners.push_back(glm::vec3(node.scene_from_node * glm::vec4(primitive.positions_m[i], 1.0F)));
      }
    }
  }
  return corners;
}

}  // namespace host
