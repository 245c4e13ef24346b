#include "scene/scene.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/gltf/check.h"
#include "scene/gltf/meaning.h"
#include "scene/gltf/parts.h"

namespace host {

namespace {

std::vector<int> rootsOf(const gltf::Source& source, const std::vector<Node>& nodes,
                         std::vector<std::string>& warnings) {
  const auto& scenes = source.model.scenes;
  if (scenes.size() > 1) warnings.push_back(source.document.file + ": has several scenes, one is shown");
  if (!scenes.empty()) return scenes[static_cast<std::size_t>(std::max(source.model.defaultScene, 0))].nodes;
  std::vector<int> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent < 0) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

/// Nodes reached from the roots, parents first.
std::vector<int> orderOf(const Scene& scene) {
  std::vector<int> order = scene.roots;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::vector<int>& children = scene.nodes[static_cast<std::size_t>(order[i])].children;
    order.insert(order.end(), children.begin(), children.end());
  }
  return order;
}

bool isFinite(const glm::mat4& matrix) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(matrix[i / 4][i % 4])) return false;
  }
  return true;
}

void placeNodes(Scene& scene, const gltf::Document& document) {
  const std::vector<glm::mat4> matrices = scene.sceneFromNode(scene.restPoses());
  for (const int index : scene.order) {
    const auto i = static_cast<std::size_t>(index);
    Node& node = scene.nodes[i];
    const std::string where = gltf::elementOf(document, "nodes", "node", i);
    node.in_scene = true;
    node.scene_from_node = matrices[i];
    if (!isFinite(matrices[i])) gltf::fail(where, "its place is not finite");
    node.meaning = gltf::readMeaning(document.json["nodes"][i], where);
  }
}

void readTree(Scene& scene, const gltf::Source& source) {
  scene.nodes = gltf::readNodes(source);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    for (const int child : scene.nodes[i].children)
      scene.nodes[static_cast<std::size_t>(child)].parent = static_cast<int>(i);
  }
  scene.roots = rootsOf(source, scene.nodes, scene.warnings);
  if (scene.roots.empty()) gltf::fail(scene.file, "has no node to show");
  scene.order = orderOf(scene);
  placeNodes(scene, source.document);
}

Scene readScene(const std::filesystem::path& file) {
  const gltf::Document document = gltf::readDocument(file);
  gltf::checkDocument(document);
  tinygltf::Model model = gltf::parseModel(document);
  Scene scene;
  scene.file = document.file;
  for (tinygltf::Image& image : model.images) {
    scene.images.push_back({image.name, image.width, image.height, std::move(image.image)});
  }
  const gltf::Source source{document, model};
  scene.materials = gltf::readMaterials(source);
  scene.lights = gltf::readLights(source);
  scene.meshes = gltf::readMeshes(source, scene.materials, scene.warnings);
  readTree(scene, source);
  scene.animations = gltf::readAnimations(source, scene.warnings);
  gltf::checkMeanings(scene);
  return scene;
}

}  // namespace

glm::mat4 Pose::matrix() const {
  return glm::translate(glm::mat4(1.0F), translation_m) * glm::mat4_cast(rotation) *
         glm::scale(glm::mat4(1.0F), scale);
}

int Scene::findNode(const std::string& name) const {
  for (const int i : order) {
    if (nodes[static_cast<std::size_t>(i)].name == name) return i;
  }
  return -1;
}

std::vector<Pose> Scene::restPoses() const {
  std::vector<Pose> poses;
  poses.reserve(nodes.size());
  for (const Node& node : nodes) poses.push_back(node.pose);
  return poses;
}

std::vector<glm::mat4> Scene::sceneFromNode(const std::vector<Pose>& poses) const {
  std::vector<glm::mat4> matrices(nodes.size(), glm::mat4(1.0F));
  for (const int index : order) {
    const auto i = static_cast<std::size_t>(index);
    const Node& node = nodes[i];
    const glm::mat4 local = node.has_matrix ? node.local : poses[i].matrix();
    matrices[i] = node.parent < 0 ? local : matrices[static_cast<std::size_t>(node.parent)] * local;
  }
  return matrices;
}

Scene loadScene(const std::filesystem::path& file) {
  try {
    return readScene(file);
  } catch (const SceneError&) {
    throw;
  } catch (const std::bad_alloc&) {
    gltf::fail(file.filename().string(), "needs more memory than there is");
  } catch (const std::exception& error) {
    gltf::fail(file.filename().string(), error.what());
  }
}

}  // namespace host
