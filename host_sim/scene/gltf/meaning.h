#pragma once
// extras.rainglass of nodes, as models/README.md has it.

#include "scene/gltf/document.h"

namespace host::gltf {

/// A node's meaning. Fails, naming node and key, for an unknown type or key, a missing key and a value that
/// cannot be.
Meaning readMeaning(const Json& node, const std::string& where);

/// Fails unless the meanings suit their nodes and each other: panes have uv, shelters a volume, wipers a pane
/// and names occur once. All else of the scene is in place.
void checkMeanings(const Scene& scene);

}  // namespace host::gltf
