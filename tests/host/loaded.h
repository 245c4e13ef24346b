#pragma once
// Scenes as the host loads them, and what it says of those it does not.

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <string>

#include "gltf_files.h"
#include "scene/scene.h"

namespace files {

constexpr float kRounding = 1e-5F;  // products of a few floats near 1

inline host::Scene load(const Gltf& g) {
  const TempFolder folder;
  return host::loadScene(folder.write("model.glb", g.glb()));
}

/// What loading the file says; empty when it loads.
inline std::string complaint(const std::filesystem::path& file) {
  try {
    host::loadScene(file);
    return "";
  } catch (const host::SceneError& error) {
    return error.what();
  }
}

inline void expectNear(const glm::vec3& a, const glm::vec3& b) {
  EXPECT_LT(glm::distance(a, b), kRounding) << a.x << ' ' << a.y << ' ' << a.z;
}

}  // namespace files
