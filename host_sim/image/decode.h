#pragma once
// PNG and JPEG files to RGBA, 8 bits. (PNG through libpng, which inflates no more than the rows its header
// promises.)

#include <cstdint>
#include <span>
#include <vector>

namespace host {

struct Pixels {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< width x height x 4, row 0 on top
};

inline constexpr int kLongestImageSide_px = 16384;
inline constexpr std::int64_t kLargestImage_px = 64LL << 20;

/// Throws std::runtime_error, a few words, for anything that is no sound PNG or JPEG of at most 16384 a side
/// and 64 Mi pixels.
Pixels decodePixels(std::span<const std::uint8_t> file);

}  // namespace host
