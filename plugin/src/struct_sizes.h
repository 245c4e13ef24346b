// How large the ABI's structs are in each minor of the header: a host may have been compiled against any of
// them, and its structs have no more room than that.
#pragma once

#include <array>
#include <cstddef>

#include "rainglass/rainglass.h"

namespace rg {

struct SizeSince {
  uint32_t minor;
  size_t bytes;
};

// Its size from minor 0 on (or from where there is such a struct), and from every minor in which it grew.
template <typename T>
inline constexpr std::array kSizes = {SizeSince{0, sizeof(T)}};
template <>
inline constexpr std::array kSizes<rg_weather> = {SizeSince{0, offsetof(rg_weather, hail_mm_h)},
                                                  SizeSince{1, sizeof(rg_weather)}};
template <>
inline constexpr std::array kSizes<rg_sample> = {SizeSince{0, offsetof(rg_sample, opening_knots)},
                                                 SizeSince{4, sizeof(rg_sample)}};
template <>
inline constexpr std::array kSizes<rg_pane_info> = {SizeSince{0, offsetof(rg_pane_info, demister)},
                                                    SizeSince{3, offsetof(rg_pane_info, slide_direction)},
                                                    SizeSince{4, sizeof(rg_pane_info)}};
template <>
inline constexpr std::array kSizes<rg_wiper_info> = {SizeSince{0, offsetof(rg_wiper_info, blade_turn)},
                                                     SizeSince{2, sizeof(rg_wiper_info)}};
template <>
inline constexpr std::array kSizes<rg_lighting> = {SizeSince{0, offsetof(rg_lighting, lamps_on_glass)},
                                                   SizeSince{3, sizeof(rg_lighting)}};
template <>
inline constexpr std::array kSizes<rg_rain_stats> = {
    SizeSince{0, offsetof(rg_rain_stats, snow_mm_h)}, SizeSince{1, offsetof(rg_rain_stats, ground_water_mm)},
    SizeSince{5, offsetof(rg_rain_stats, splash_thinning)}, SizeSince{6, sizeof(rg_rain_stats)}};
template <>
inline constexpr std::array kSizes<rg_pane_stats> = {SizeSince{0, offsetof(rg_pane_stats, dropped_s)},
                                                     SizeSince{3, offsetof(rg_pane_stats, run_on_ml)},
                                                     SizeSince{7, sizeof(rg_pane_stats)}};

template <typename T>
inline constexpr size_t kFirstSize = kSizes<T>.front().bytes;

// A minor that is not known here has what the newest has that is.
template <typename T>
constexpr size_t sizeIn(uint32_t minor) {
  size_t bytes = kFirstSize<T>;
  for (const SizeSince& size : kSizes<T>) {
    if (size.minor <= minor) bytes = size.bytes;
  }
  return bytes;
}

}  // namespace rg
