// Beyond these nothing of a pane's saved state is taken: far from what any drive comes to, near enough that
// sums stay in range.
#pragma once

#include <cstdint>

namespace rg::glass {

inline constexpr int64_t kMostSaved_pl = INT64_C(1) << 60;
inline constexpr int64_t kMostSavedTicks = INT64_C(1) << 40;

}  // namespace rg::glass
