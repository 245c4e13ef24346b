#include "scene/gltf/check_tree.h"

#include <cmath>

#include "scene/gltf/check.h"

namespace host::gltf {

namespace {

constexpr int kLongestChain = 256;

std::size_t countOf(const Document& document, const char* list) {
  return document.json.contains(list) ? document.json[list].size() : 0;
}

void checkPose(const Fields& fields) {
  const bool has_parts = fields.has("translation") || fields.has("rotation") || fields.has("scale");
  if (fields.has("matrix") && has_parts)
    fields.failAt("matrix", "is given beside translation, rotation or scale");
  fields.numbers("matrix", 16, 16);
  fields.numbers("translation", 3, 3);
  fields.numbers("scale", 3, 3);
  double length = 0.0;
  const std::vector<float> rotation = fields.numbers("rotation", 4, 4);
  for (const float q : rotation) length += static_cast<double>(q) * static_cast<double>(q);
  if (!rotation.empty() && std::abs(std::sqrt(length) - 1.0) > 0.01) {
    fields.failAt("rotation", "has length " + std::to_string(std::sqrt(length)) + ", must have 1");
  }
}

std::vector<int> parentsOf(const Document& document) {
  const std::size_t count = countOf(document, "nodes");
  std::vector<int> parents(count, -1);
  for (std::size_t i = 0; i < count; ++i) {
    const Fields fields(document.json["nodes"][i], elementOf(document, "nodes", "node", i));
    fields.index("mesh", countOf(document, "meshes"));
    checkPose(fields);
    for (const int child : fields.indices("children", count)) {
      int& parent = parents[static_cast<std::size_t>(child)];
      if (parent >= 0) {
        fail(elementOf(document, "nodes", "node", static_cast<std::size_t>(child)),
             "is a child of node " + std::to_string(parent) + " and of node " + std::to_string(i));
      }
      parent = static_cast<int>(i);
    }
  }
  return parents;
}

void checkChains(const Document& document, const std::vector<int>& parents) {
  std::vector<int> depth(parents.size(), 0);  // 0: not yet known
  for (std::size_t i = 0; i < parents.size(); ++i) {
    std::vector<std::size_t> chain;
    int at = static_cast<int>(i);
    while (at >= 0 && depth[static_cast<std::size_t>(at)] == 0) {
      chain.push_back(static_cast<std::size_t>(at));
      at = parents[chain.back()];
      // A walk up that is longer than there are nodes goes round in a ring, and is in it by now.
      if (chain.size() > parents.size())
        fail(elementOf(document, "nodes", "node", chain.back()), "is its own ancestor");
    }
    int below = at < 0 ? 0 : depth[static_cast<std::size_t>(at)];
    for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
      depth[*node] = ++below;
      if (below > kLongestChain) {
        fail(elementOf(document, "nodes", "node", *node),
             "has more than " + std::to_string(kLongestChain - 1) + " ancestors");
      }
    }
  }
}

void checkScenes(const Document& document, const std::vector<int>& parents) {
  for (std::size_t i = 0; i < countOf(document, "scenes"); ++i) {
    const Fields fields(document.json["scenes"][i], elementOf(document, "scenes", "scene", i));
    std::vector<bool> seen(parents.size(), false);
    for (const int node : fields.indices("nodes", parents.size())) {
      const auto n = static_cast<std::size_t>(node);
      if (parents[n] >= 0)
        fields.failAt("nodes", "lists node " + std::to_string(node) + ", which has a parent");
      if (seen[n]) fields.failAt("nodes", "lists node " + std::to_string(node) + " twice");
      seen[n] = true;
    }
  }
  Fields(document.json, document.file).index("scene", countOf(document, "scenes"));
}

}  // namespace

void checkTree(const Document& document) {
  const std::vector<int> parents = parentsOf(document);
  checkChains(document, parents);
  checkScenes(document, parents);
}

}  // namespace host::gltf
