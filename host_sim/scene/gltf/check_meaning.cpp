// What a node's meaning asks of the node and of the others.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scene/gltf/meaning.h"
#include "scene/views.h"

namespace host::gltf {

namespace {

struct Check {
  const Scene& scene;
  std::map<std::string, std::set<std::string>> names;  // by type: each name once
  int eyes = 0;
  int routes = 0;
  int steering_wheels = 0;

  std::string where(int node) const {
    return elementName(scene.file, "node", static_cast<std::size_t>(node), at(node).name);
  }
  const Node& at(int node) const { return scene.nodes[static_cast<std::size_t>(node)]; }
  const Mesh* meshOf(int node) const {
    return at(node).mesh < 0 ? nullptr : &scene.meshes[static_cast<std::size_t>(at(node).mesh)];
  }

  void once(int node, const char* type, const std::string& name) {
    if (names[type].insert(name).second) return;
    fail(where(node), "extras.rainglass.name: there is a " + std::string(type) + " \"" + name + "\" already");
  }

  void single(int node, const char* type, int& count) const {
    if (++count > 1)
      fail(where(node), "extras.rainglass: there is another " + std::string(type) + " already");
  }

  const Mesh& needMesh(int node, const char* type) const {
    const Mesh* mesh = meshOf(node);
    if (mesh == nullptr || mesh->primitives.empty()) {
      fail(where(node), "extras.rainglass: a " + std::string(type) + " needs a mesh of triangles");
    }
    return *mesh;
  }

  void needUv(int node, const char* type) const {
    for (const Primitive& primitive : needMesh(node, type).primitives) {
      if (primitive.uv0.empty()) {
        fail(where(node),
             "extras.rainglass: a " + std::string(type) + " needs TEXCOORD_0 in all of its mesh");
      }
    }
  }

  /// A node whose axes carry meaning may be scaled, but not to nothing.
  void needExtent(int node, const char* type) const {
    const float determinant = glm::determinant(glm::mat3(at(node).scene_from_node));
    if (std::abs(determinant) > 1e-12F) return;
    fail(where(node), "extras.rainglass: a " + std::string(type) + " is scaled to nothing");
  }

  void needAxes(int node, const char* type) const {
    needExtent(node, type);
    if (glm::determinant(glm::mat3(at(node).scene_from_node)) > 0.0F) return;
    fail(where(node), "extras.rainglass: a " + std::string(type) + " must not be mirrored");
  }

  void operator()(int, const std::monostate&) const {}
  void operator()(int node, const PaneMeaning& pane);
  void operator()(int node, const ShelterMeaning& shelter);
  void operator()(int node, const WiperMeaning& wiper);
  void operator()(int node, const EyeMeaning&) { single(node, "eye", eyes); }
  void operator()(int node, const CameraMeaning& camera) { once(node, "camera", camera.name); }
  void operator()(int node, const RouteMeaning&);
  void operator()(int node, const LightMeaning&) const;
  void operator()(int node, const WheelMeaning&) const { needAxes(node, "wheel"); }
  void operator()(int node, const SteeringWheelMeaning&);
  void operator()(int node, const NeedleMeaning&) const { needAxes(node, "needle"); }
  void operator()(int node, const DigitMeaning&) const { needAxes(node, "digit"); }
  void operator()(int node, const MirrorMeaning& mirror) const {
    if (mirror.wet)
      needUv(node, "mirror that is wet");
    else
      needMesh(node, "mirror");
    needExtent(node, "mirror");
  }
};

/// The largest triangle's share that a flat hull lacks: is there a point off the plane of three others?
bool hasVolume(const std::vector<glm::vec3>& points) {
  const glm::vec3& a = points.front();
  const auto farthest = [&](auto&& distance) {
    return *std::max_element(points.begin(), points.end(), [&](const glm::vec3& p, const glm::vec3& q) {
      return distance(p) < distance(q);
    });
  };
  const glm::vec3 b = farthest([&](const glm::vec3& p) { return glm::distance(p, a); });
  const glm::vec3 ab = b - a;
  const glm::vec3 c = farthest([&](const glm::vec3& p) { return glm::length(glm::cross(ab, p - a)); });
  const glm::vec3 normal = glm::cross(ab, c - a);
  const glm::vec3 d = farthest([&](const glm::vec3& p) { return std::abs(glm::dot(normal, p - a)); });
  constexpr float kThinnest_m = 1e-3F;
  return glm::length(normal) > 0.0F && std::abs(glm::dot(normal, d - a)) > kThinnest_m * glm::length(normal);
}

void Check::operator()(int node, const PaneMeaning& pane) {
  once(node, "pane", pane.name);
  needUv(node, "pane");
  needExtent(node, "pane");
}

void Check::operator()(int node, const ShelterMeaning& shelter) {
  once(node, "shelter", shelter.name);
  std::vector<glm::vec3> points_m;
  for (const Primitive& primitive : needMesh(node, "shelter").primitives) {
    for (const glm::vec3& p : primitive.positions_m)
      points_m.emplace_back(at(node).scene_from_node * glm::vec4(p, 1.0F));
  }
  if (!hasVolume(points_m)) fail(where(node), "extras.rainglass: a shelter is flat, its hull needs a volume");
}

void Check::operator()(int node, const WiperMeaning& wiper) {
  once(node, "wiper", wiper.name);
  needAxes(node, "wiper");
  if (at(node).has_matrix)
    fail(where(node), "extras.rainglass: a wiper turns, so it needs a rotation, not a matrix");
  const bool has_pane = std::any_of(scene.order.begin(), scene.order.end(), [&](int i) {
    const auto* pane = std::get_if<PaneMeaning>(&at(i).meaning);
    return pane != nullptr && pane->name == wiper.pane;
  });
  if (!has_pane)
    fail(where(node), "extras.rainglass.pane is \"" + wiper.pane + "\", but there is no such pane");
}

void Check::operator()(int node, const RouteMeaning&) {
  single(node, "route", routes);
  if (at(node).mesh >= 0) fail(where(node), "extras.rainglass: a route must have no mesh");
}

void Check::operator()(int node, const LightMeaning&) const {
  needExtent(node, "light");
  if (at(node).light >= 0) return;
  for (const Primitive& primitive : needMesh(node, "light without KHR_lights_punctual").primitives) {
    const glm::vec3 glow = scene.materials[static_cast<std::size_t>(primitive.material)].emissive;
    if (glow != glm::vec3(0.0F)) return;
  }
  fail(where(node), "extras.rainglass: a light needs KHR_lights_punctual or a mesh with emissive material");
}

void Check::operator()(int node, const SteeringWheelMeaning&) {
  single(node, "steering wheel", steering_wheels);
  needAxes(node, "steering wheel");
}

}  // namespace

void checkMeanings(const Scene& scene) {
  Check check{scene, {}, 0, 0, 0};
  for (const int node : scene.order) {
    std::visit([&](const auto& meaning) { check(node, meaning); }, check.at(node).meaning);
  }
}

}  // namespace host::gltf
