#pragma once
// The first line of defence: every type, index, count and range of a glTF document is checked in its JSON,
// before tinygltf sees it.

#include "scene/gltf/document.h"

namespace host::gltf {

/// Fails, naming file and element, unless all of the document that this program uses is sound: lists hold
/// objects, indices point at something, views lie in their buffers and accessors in their views, factors are
/// in range, the nodes are a forest. Buffers' contents are not looked at (their byteLength is taken at its
/// word; see parseModel()).
void checkDocument(const Document& document);

/// A name for messages: `FILE: KIND INDEX "NAME"` of an element of one of the document's lists.
std::string elementOf(const Document& document, const char* list, const char* kind, std::size_t index);

/// Bytes of one component (5120 ... 5126), 0 for an unknown one.
std::size_t componentSize_bytes(int component_type);

}  // namespace host::gltf
