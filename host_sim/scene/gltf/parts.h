#pragma once
// The parts of a scene, each from a checked model.

#include "scene/gltf/source.h"

namespace host::gltf {

inline glm::vec3 vec3Of(const std::vector<double>& from, glm::vec3 otherwise) {
  return from.size() == 3 ? glm::vec3(glm::dvec3(from[0], from[1], from[2])) : otherwise;
}

/// Materials with their images' indices; the default material comes last.
std::vector<Material> readMaterials(const Source& source);

/// Meshes as triangles, with normals and tangents where they are missing. Lines and points are left out with
/// a warning.
std::vector<Mesh> readMeshes(const Source& source, const std::vector<Material>& materials,
                             std::vector<std::string>& warnings);

std::vector<Light> readLights(const Source& source);

/// Nodes without their meaning; parents, in_scene and matrices are not set.
std::vector<Node> readNodes(const Source& source);

/// Morph weights are left out with a warning.
std::vector<Animation> readAnimations(const Source& source, std::vector<std::string>& warnings);

}  // namespace host::gltf
