#pragma once

#include "scene/gltf/document.h"

namespace host::gltf {

/// Fails unless the nodes are sound and form a forest: children exist, no node has two parents or is its own
/// ancestor, no chain is longer than 256 nodes, and the scenes list roots. The document's lists are known to
/// hold objects.
void checkTree(const Document& document);

}  // namespace host::gltf
