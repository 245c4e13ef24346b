#include "glass/wear.h"

#include <cmath>

#include "glass/random.h"

namespace rg::glass {
namespace {

// All unsourced: in the order of what streaked windscreens show, a haze a hand's width apart and lines some
// millimetres wide.
constexpr double kNicks_per_m = 40.0;
constexpr double kThickestStreak_m = 25e-6;
constexpr double kHaze_m = 0.8e-6;  // hardened rubber leaves it in bands
constexpr double kBand_m = 0.03;
constexpr double kSmear_m = 6e-6;

double unit(uint32_t seed, uint32_t k) {
  return static_cast<double>(shared::unitFloat(shared::pcg(seed ^ shared::pcg(k))));
}

}  // namespace

Wear::Wear(double residual_film_m, double blade_m, double worn, uint32_t seed)
    : residual_film_m_(residual_film_m), worn_(worn), seed_(seed) {
  const auto count = static_cast<uint32_t>(std::lround(kNicks_per_m * blade_m * worn));
  for (uint32_t k = 0; k < count; ++k) {
    const double deep = unit(seed, 3 * k + 2);
    nicks_.push_back({(unit(seed, 3 * k) - 0.5) * blade_m, 1.2e-3 + 1.5e-3 * unit(seed, 3 * k + 1),
                      kThickestStreak_m * (0.15 + 0.85 * deep * deep)});
  }
}

double Wear::residual_m(double along_m) const {
  double film_m = residual_film_m_;
  for (const Nick& nick : nicks_) {
    const double x = (along_m - nick.along_m) / nick.half_width_m;
    if (std::abs(x) < 3.0) film_m += nick.film_m * std::exp(-x * x);
  }
  const double band = along_m / kBand_m + 1000.0;
  const double share = band - std::floor(band);
  const auto cell = static_cast<uint32_t>(band);
  const double haze =
      std::lerp(unit(~seed_, cell), unit(~seed_, cell + 1), share * share * (3.0 - 2.0 * share));
  return film_m + worn_ * kHaze_m * haze * haze;
}

double Wear::smear_m() const { return worn_ * kSmear_m; }

}  // namespace rg::glass
