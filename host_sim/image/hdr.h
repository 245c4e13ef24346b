#pragma once
// Radiance .hdr pictures (RGBE): an environment's light, latitude-longitude.

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

namespace host {

/// Linear light, row 0 on top.
struct HdrImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> rgb;  ///< width x height x 3
};

/// The picture cannot be used. what() is one line that names the file.
class HdrError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads a file of at most 512 MiB, flat or run-length encoded in the old or the new way, at most 16384 a
/// side and 64 Mi pixels. All eight orders of rows and columns are turned upright. Throws HdrError, and
/// nothing else.
HdrImage loadHdr(const std::filesystem::path& file);

/// The same from memory; `name` is for messages.
HdrImage readHdr(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace host
