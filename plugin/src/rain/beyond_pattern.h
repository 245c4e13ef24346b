// The pattern of rain too far off to be told apart as drops: the project's own, or a user's.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rg::rain {

// Tiles in both directions. Rows go along the fall, from where drops come to where they go.
struct RainPattern {
  static constexpr uint32_t kSmallest_px = 8, kLargest_px = 4096;

  uint32_t width_px = 0, height_px = 0;
  std::vector<uint8_t>
      rgba;           // rgb: normal (x to the side, y along the rows' order, z to the eye), 128 = 0; a: rain
  double mean = 1.0;  // of a, 0 .. 1
  double greatest = 1.0;
};

// Takes tight rows. Returns an empty text, or what is wrong (then `out` is untouched): a side that is not 8
// .. 4096 pixels, or no rain in it at all.
[[nodiscard]] std::string makePattern(uint32_t width_px, uint32_t height_px, std::vector<uint8_t> rgba,
                                      RainPattern& out);

// Streaks of many lengths at random, always the same ones.
RainPattern generatePattern();

}  // namespace rg::rain
