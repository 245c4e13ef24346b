#include "rain/wind_profile.h"

#include <algorithm>
#include <cmath>

#include "gravity.h"

namespace rg::rain {
namespace {

constexpr double kStatedAt_m = 10.0;

// So that the last digits of a machine's log do not decide where drops are.
double rounded(double share) { return std::round(share * 0x1p20) * 0x1p-20; }

// exp(x) E1(x), the exponential integral; for large x, where its factors leave the range of a double, 1 / x.
double scaledE1(double x) { return x < 100.0 ? -std::exp(x) * std::expint(-x) : 1.0 / (x + 1.0); }

}  // namespace

WindProfile WindProfile::of(double roughness_m, double height_m) {
  WindProfile profile;
  if (!(roughness_m > 0.0) || !std::isfinite(height_m)) return profile;
  profile.roughness_m = std::min(roughness_m, 1.0);
  profile.height_m = std::clamp(height_m, 1.0, kStatedAt_m);
  profile.air_share =
      rounded(std::log(profile.height_m / profile.roughness_m) / std::log(kStatedAt_m / profile.roughness_m));
  for (uint32_t kind = 0; kind < kClasses; ++kind)
    profile.drop_share[kind] = kind == kBouncedClass ? 0.0 : profile.dropShare(fallClasses()[kind].speed_mps);
  return profile;
}

double WindProfile::dropShare(double fall_speed_mps) const {
  if (roughness_m == 0.0) return 1.0;
  const double kept = scaledE1(height_m * kGravity_mps2 / (fall_speed_mps * fall_speed_mps));
  return rounded((std::log(height_m / roughness_m) + kept) / std::log(kStatedAt_m / roughness_m));
}

}  // namespace rg::rain
