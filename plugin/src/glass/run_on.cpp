#include "glass/run_on.h"

#include <algorithm>
#include <cmath>

#include "shared/glass_wiper.glsl"

namespace rg::glass {
namespace {

// The fullest ridge that a blade holds, see shared::kFullRidge_pl, has a lesser one.
constexpr double kLargest_m2 = 2e-4;

// Wall shear is Cf rho v^2 / 2, Cf = 0.079 / Re^(1/4) by Blasius (1913), Re of the hydraulic diameter of a
// sheet, four times its height.
double frictionFactor(double speed_mps, double height_m) {
  const double reynolds = kRho_kg_m3 * speed_mps * 4.0 * height_m / kMu_pa_s;
  return 0.079 / std::pow(std::max(reynolds, 1.0), 0.25);
}

}  // namespace

// A sheet of mean height h slows down by k v^2 + a: k = Cf / (2 h), and a by what holds its contact lines,
// gamma (cos receding - cos advancing) for each metre of it (Furmidge 1962). It leaves the blade where that
// slows down more than the sheet's friction does: rate^2 x = k rate^2 (X^2 - x^2), and comes to rest 1 / (2
// k) ln(1 + k v^2 / a) later.
double runOn_m(double area_m2, const PieceStroke& stroke, const Surface& surface) {
  if (!(area_m2 > 0.0) || !(stroke.half_way_m > 0.0) || !(stroke.rate_radps > 0.0)) return 0.0;
  const auto tan_contact = static_cast<float>(std::tan(std::min(surface.advancing_rad, 1.4)));
  const double width_m = static_cast<double>(shared::ridgeWidth_m(static_cast<float>(area_m2), tan_contact));
  const double height_m = area_m2 / width_m, way_m = stroke.half_way_m;
  const double k = frictionFactor(stroke.rate_radps * way_m, height_m) / (2.0 * height_m);
  const double held_mps2 = kGamma_n_m * (std::cos(surface.receding_rad) - std::cos(surface.advancing_rad)) /
                           (kRho_kg_m3 * area_m2);
  const double leaves_m = (std::sqrt(1.0 + 4.0 * k * k * way_m * way_m) - 1.0) / (2.0 * k);
  const double speed2 = stroke.rate_radps * stroke.rate_radps * (way_m * way_m - leaves_m * leaves_m);
  const double rests_m = leaves_m + std::log1p(k * speed2 / std::max(held_mps2, 1e-3)) / (2.0 * k);
  return std::max(rests_m - way_m, 0.0);
}

// Larger ridges run farther: halving finds the least.
int32_t leastToRunOn_pl(double edge_m, double piece_m, const PieceStroke& stroke, const Surface& surface) {
  if (runOn_m(kLargest_m2, stroke, surface) < edge_m) return kNeverRunsOn;
  double low = 0.0, high = kLargest_m2;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (runOn_m(middle, stroke, surface) < edge_m ? low : high) = middle;
  }
  return static_cast<int32_t>(
      std::min<int64_t>(std::max<int64_t>(picolitres(high * piece_m), 1), kNeverRunsOn));
}

}  // namespace rg::glass
