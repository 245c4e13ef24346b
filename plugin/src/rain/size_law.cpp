#include "rain/size_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rain/exponential.h"

namespace rg::rain {
namespace {

constexpr double kAtlasTop = 9.65, kAtlasFall = 10.3, kAtlasRate_per_mm = 0.6;

// Integral of D^n v(D) exp(-a D).
double movingMoment(int n, double a, double x, double y) {
  return kAtlasTop * moment(n, a, x, y) - kAtlasFall * moment(n, a + kAtlasRate_per_mm, x, y);
}

// A drop's volume in mm3 is pi/6 D^3; 1 mm3/(m2 s) is 3.6e-3 mm/h.
constexpr double kSphere = std::numbers::pi / 6.0;
constexpr double kMmPerHour = 3.6e-3;

}  // namespace

double fallSpeed(double diameter_mm) {
  return kAtlasTop - kAtlasFall * std::exp(-kAtlasRate_per_mm * diameter_mm);
}

double diameterOfSpeed(double speed_mps) {
  return -std::log((kAtlasTop - speed_mps) / kAtlasFall) / kAtlasRate_per_mm;
}

const std::array<SpeedClass, kSpeedClasses>& speedClasses() {
  static const std::array<SpeedClass, kSpeedClasses> classes = [] {
    std::array<SpeedClass, kSpeedClasses> made;
    const double slowest = fallSpeed(kSmallest_mm), step = (fallSpeed(kLargest_mm) - slowest) / kSpeedClasses;
    for (uint32_t i = 0; i < kSpeedClasses; ++i) {
      made[i].from_mm = i == 0 ? kSmallest_mm : diameterOfSpeed(slowest + step * i);
      made[i].to_mm = i + 1 == kSpeedClasses ? kLargest_mm : diameterOfSpeed(slowest + step * (i + 1));
      made[i].speed_mps = slowest + step * (i + 0.5);
    }
    return made;
  }();
  return classes;
}

SizeLaw SizeLaw::of(double rate_mm_h) {
  SizeLaw law;
  if (!(rate_mm_h > 0.0)) return law;
  law.rate_mm_h = std::min(rate_mm_h, kMaxRate_mm_h);
  // Below 1e-3 mm/h the slope grows without bound while nothing is left to see: held there.
  law.slope_per_mm = 4.1 * std::pow(std::max(law.rate_mm_h, 1e-3), -0.21);
  law.n0_per_m3_mm = 1.0;
  law.n0_per_m3_mm = law.rate_mm_h / law.delivered_mm_h();
  return law;
}

double SizeLaw::numberDensity(double from_mm, double to_mm) const {
  return n0_per_m3_mm > 0.0 ? n0_per_m3_mm * moment(0, slope_per_mm, from_mm, to_mm) : 0.0;
}

double SizeLaw::flux(double from_mm, double to_mm) const {
  return n0_per_m3_mm > 0.0 ? n0_per_m3_mm * movingMoment(0, slope_per_mm, from_mm, to_mm) : 0.0;
}

double SizeLaw::water_g_m3() const {
  return n0_per_m3_mm > 0.0
             ? 1e-3 * kSphere * n0_per_m3_mm * moment(3, slope_per_mm, kSmallest_mm, kLargest_mm)
             : 0.0;
}

double SizeLaw::delivered_mm_h() const {
  if (!(n0_per_m3_mm > 0.0)) return 0.0;
  return kMmPerHour * kSphere * n0_per_m3_mm * movingMoment(3, slope_per_mm, kSmallest_mm, kLargest_mm);
}

double SizeLaw::cover_per_m() const {
  return n0_per_m3_mm > 0.0 ? 1e-6 * (std::numbers::pi / 4.0) * n0_per_m3_mm *
                                  moment(2, slope_per_mm, kSmallest_mm, kLargest_mm)
                            : 0.0;
}

double SizeLaw::meanSpeedSeen_mps() const {
  return movingMoment(2, slope_per_mm, kSmallest_mm, kLargest_mm) /
         moment(2, slope_per_mm, kSmallest_mm, kLargest_mm);
}

double SizeLaw::meanDiameter_mm() const {
  return moment(1, slope_per_mm, kSmallest_mm, kLargest_mm) /
         moment(0, slope_per_mm, kSmallest_mm, kLargest_mm);
}

double SizeLaw::meanDiameterReachingGround_mm() const {
  return movingMoment(1, slope_per_mm, kSmallest_mm, kLargest_mm) /
         movingMoment(0, slope_per_mm, kSmallest_mm, kLargest_mm);
}

double SizeLaw::quantile(double from_mm, double to_mm, double u) const {
  return rain::quantile(slope_per_mm, from_mm, to_mm, u);
}

double extinction_per_m(double rate_mm_h) {
  return rate_mm_h > 0.0 ? 0.312e-3 * std::pow(rate_mm_h, 0.67) : 0.0;
}

double visibility_m(double rate_mm_h) {
  return rate_mm_h > 0.0 ? 3.0 / extinction_per_m(rate_mm_h) : HUGE_VAL;
}

}  // namespace rg::rain
