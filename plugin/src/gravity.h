#pragma once

namespace rg {

inline constexpr double kGravity_mps2 = 9.81;  // as shared::kRainGravity_mps2

}  // namespace rg
