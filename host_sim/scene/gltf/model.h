#pragma once
// The second line of defence: tinygltf gets only what was checked, and neither paths nor files.

#include <tiny_gltf.h>

#include "scene/gltf/document.h"

namespace host::gltf {

/// Parses a document that checkDocument() has passed. Its buffers hold at least their byteLength, its images
/// are RGBA, 8 bits. Fails, naming the element, for buffers and images that are missing, short, outside the
/// model's folder or not to be decoded.
tinygltf::Model parseModel(const Document& document);

}  // namespace host::gltf
