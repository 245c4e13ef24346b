#pragma once
// A glTF file on disk: its JSON, the bytes its buffers and images name, and nothing outside its own folder.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/gltf/fields.h"

namespace host::gltf {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::int64_t kLargestFile_bytes = 512LL << 20;

// The JSON library's destructor is not marked noexcept where clang-tidy looks, though it throws nothing.
struct Document {                // NOLINT(bugprone-exception-escape)
  std::string file;              ///< file name without folder, for messages
  std::filesystem::path folder;  ///< canonical: no link in it
  Json json;
  bool has_bin = false;
  Bytes bin;  ///< a .glb's second chunk
};

/// A regular file's bytes. Fails for whatever else, and above `largest_bytes`.
Bytes readFile(const std::filesystem::path& path, const std::string& where,
               std::int64_t largest_bytes = kLargestFile_bytes);

/// Reads .gltf or .glb, told apart by its first bytes, and parses the JSON, whose nesting is bounded.
Document readDocument(const std::filesystem::path& path);

/// What a buffer's or image's uri names: a data: uri's bytes, or those of a file that lies, links resolved,
/// in `folder` or below.
Bytes readUri(const std::string& uri, const std::filesystem::path& folder, const std::string& where);

}  // namespace host::gltf
