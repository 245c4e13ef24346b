#pragma once
// Reads accessors of a checked model: the third line of defence, in that each read is held to its buffer once
// more.

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "scene/gltf/model.h"

namespace host::gltf {

struct Source {
  const Document& document;
  const tinygltf::Model& model;

  /// Numbers, `components` per element (1..4), normalised integers mapped to 0..1 or -1..1
  /// (glTF 2.0, 3.6.2.2). Fails, naming `user`, when the accessor has another number of components, is sparse
  /// or has no data, or holds what is not finite.
  std::vector<float> floats(int accessor, int components, const std::string& user) const;
  /// Unsigned integers of any size. Fails as floats() does.
  std::vector<std::uint32_t> integers(int accessor, const std::string& user) const;

  std::size_t count(int accessor) const { return model.accessors[static_cast<std::size_t>(accessor)].count; }
  int components(int accessor) const;

  /// floats() as vectors.
  template <int N>
  std::vector<glm::vec<N, float>> vectors(int accessor, const std::string& user) const {
    const std::vector<float> values = floats(accessor, N, user);
    std::vector<glm::vec<N, float>> vectors(values.size() / N);
    for (std::size_t i = 0; i < values.size(); ++i) vectors[i / N][static_cast<int>(i % N)] = values[i];
    return vectors;
  }
};

}  // namespace host::gltf
