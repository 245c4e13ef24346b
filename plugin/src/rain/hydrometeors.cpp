#include "rain/hydrometeors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rain/exponential.h"
#include "rain/hail_law.h"
#include "rain/snow_law.h"

namespace rg::rain {
namespace {

using Classes = std::array<FallClass, kClasses>;

// Of snow, only so many groups are drawn to the end of their reach, the others half as far: a view would hold
// two and a half times as many flakes else (unsourced).
constexpr uint32_t kFarGroups = 3;

// So that the last digits of a machine's pow and sin do not decide where particles are.
double rounded(double value) { return std::round(value * 0x1p20) * 0x1p-20; }

// The size between two that falls at a speed; `speed` grows with size.
template <class F>
double sizeOfSpeed(F&& speed, double from_mm, double to_mm, double speed_mps) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (from_mm + to_mm);
    (speed(middle) < speed_mps ? from_mm : to_mm) = middle;
  }
  return 0.5 * (from_mm + to_mm);
}

// Class `i` of `count` with equal steps of speed.
template <class F>
FallClass classOf(Hydrometeor hydrometeor, F&& speed, double least_mm, double most_mm, uint32_t i,
                  uint32_t count) {
  const double slowest = speed(least_mm), step = (speed(most_mm) - slowest) / count;
  FallClass c;
  c.hydrometeor = hydrometeor;
  c.from_mm = i == 0 ? least_mm : sizeOfSpeed(speed, least_mm, most_mm, slowest + step * i);
  c.to_mm = i + 1 == count ? most_mm : sizeOfSpeed(speed, least_mm, most_mm, slowest + step * (i + 1));
  c.speed_mps = rounded(slowest + step * (i + 0.5));
  return c;
}

// The ten groups' velocities beside that of their size: sideways spread over a disk of 0.5 m/s by the golden
// angle, downwards evenly over 0.5 m/s (flakes of a size differ by 0.3..0.7 m/s). Their mean is 0, so that
// they deliver what their size would.
std::array<glm::dvec3, kDriftGroups> drifts() {
  constexpr double kSideways_mps = 0.5, kDown_mps = 0.5, kGoldenAngle_rad = 2.399963;
  std::array<glm::dvec3, kDriftGroups> made;
  glm::dvec3 sum(0.0);
  for (uint32_t g = 0; g < kDriftGroups; ++g) {
    const double radius = kSideways_mps * std::sqrt((g + 0.5) / kDriftGroups), turn = kGoldenAngle_rad * g;
    const double rank = g * 7 % kDriftGroups;  // so that fast ones are not all at the rim
    made[g] = {radius * std::cos(turn), radius * std::sin(turn),
               kDown_mps * (rank / (kDriftGroups - 1.0) - 0.5)};
    sum += made[g];
  }
  for (glm::dvec3& drift : made) drift -= sum / double{kDriftGroups};
  return made;
}

Classes makeClasses() {
  Classes made;
  for (uint32_t i = 0; i < kSpeedClasses; ++i) {
    const SpeedClass& c = speedClasses()[i];
    made[i] = {Hydrometeor::kRain, c.from_mm, c.to_mm, rounded(c.speed_mps), {}, 1.0};
  }
  const auto flake = [](double melted_mm) { return flakeSpeed_mps(flakeDiameter_mm(melted_mm)); };
  const double least_mm = meltedDiameter_mm(kSmallestFlake_mm), most_mm = meltedDiameter_mm(kLargestFlake_mm);
  const auto groups = drifts();
  for (uint32_t i = 0; i < kFlakeSizes * kDriftGroups; ++i) {
    FallClass c = classOf(Hydrometeor::kSnow, flake, least_mm, most_mm, i / kDriftGroups, kFlakeSizes);
    const glm::dvec3& drift = groups[i % kDriftGroups];
    c.speed_mps = rounded(c.speed_mps + drift.z);
    c.drift_mps = {rounded(drift.x), rounded(drift.y)};
    c.share = 1.0 / kDriftGroups;
    if (i % kDriftGroups >= kFarGroups) c.seen = 0.5;
    made[kFirstSnow + i] = c;
  }
  for (uint32_t i = 0; i < kMeltingSizes; ++i)
    made[kFirstMelting + i] =
        classOf(Hydrometeor::kMeltingSnow, meltingSpeed_mps, least_mm, most_mm, i, kMeltingSizes);
  for (uint32_t i = 0; i < kStoneSizes; ++i)
    made[kFirstHail + i] =
        classOf(Hydrometeor::kHail, stoneSpeed_mps, kSmallestStone_mm, kLargestStone_mm, i, kStoneSizes);
  made[kBouncedClass] = {Hydrometeor::kBouncedHail, kSmallestStone_mm, kLargestStone_mm, 0.0, {}, 0.0};
  return made;
}

// Water of a class whose sizes were spread as 1 exp(-slope D) per m3 per mm, mm/h.
double deliveredOfOne(const FallClass& c, double slope_per_mm) {
  const double density = c.hydrometeor == Hydrometeor::kHail ? kIceDensity : 1.0;
  return 3.6e-3 * std::numbers::pi / 6.0 * density * c.share * c.speed_mps *
         moment(3, slope_per_mm, c.from_mm, c.to_mm);
}

// Fills in the densities of the classes [first, last), which bring down all of the rate together.
void scaleToRate(InTheAir& air, Hydrometeor hydrometeor, double slope_per_mm, uint32_t first, uint32_t last) {
  const double rate_mm_h = air.rates[hydrometeor];
  if (!(rate_mm_h > 0.0)) return;
  air.slope_per_mm[static_cast<uint32_t>(hydrometeor)] = slope_per_mm;
  double of_one = 0.0;
  for (uint32_t i = first; i < last; ++i) of_one += deliveredOfOne(fallClasses()[i], slope_per_mm);
  for (uint32_t i = first; i < last; ++i) {
    const FallClass& c = fallClasses()[i];
    air.density_m3[i] = rate_mm_h / of_one * c.share * moment(0, slope_per_mm, c.from_mm, c.to_mm);
  }
}

double usableRate(double rate_mm_h) { return rate_mm_h > 0.0 ? std::min(rate_mm_h, kMaxRate_mm_h) : 0.0; }

}  // namespace

Rates ratesOf(const WeatherState& weather) {
  const double snow_mm_h = usableRate(weather.snow_mm_h);
  const double melting =
      snow_mm_h > 0.0 && std::isfinite(weather.temperature_c) ? meltingShare(weather.temperature_c) : 0.0;
  Rates rates;
  rates[Hydrometeor::kRain] = usableRate(weather.rain_mm_h);
  rates[Hydrometeor::kSnow] = snow_mm_h * (1.0 - melting);
  rates[Hydrometeor::kMeltingSnow] = snow_mm_h * melting;
  rates[Hydrometeor::kHail] = usableRate(weather.hail_mm_h);
  return rates;
}

const Classes& fallClasses() {
  static const Classes classes = makeClasses();
  return classes;
}

double drawnDiameter_mm(Hydrometeor hydrometeor, double size_mm) {
  switch (hydrometeor) {
    case Hydrometeor::kSnow:
      return flakeDiameter_mm(size_mm);
    case Hydrometeor::kMeltingSnow:
      return meltingDiameter_mm(size_mm);
    default:
      return size_mm;
  }
}

InTheAir InTheAir::of(const Rates& rates) {
  InTheAir air;
  air.rates = rates;
  const SizeLaw rain = SizeLaw::of(rates[Hydrometeor::kRain]);
  air.slope_per_mm[0] = rain.slope_per_mm;
  for (uint32_t i = 0; i < kSpeedClasses; ++i)
    air.density_m3[i] = rain.numberDensity(speedClasses()[i].from_mm, speedClasses()[i].to_mm);
  // One law for dry and melting flakes: they are of the same snow.
  const double snow_mm_h = rates[Hydrometeor::kSnow] + rates[Hydrometeor::kMeltingSnow];
  scaleToRate(air, Hydrometeor::kSnow, snowSlope_per_mm(snow_mm_h), kFirstSnow, kFirstMelting);
  scaleToRate(air, Hydrometeor::kMeltingSnow, snowSlope_per_mm(snow_mm_h), kFirstMelting, kFirstHail);
  scaleToRate(air, Hydrometeor::kHail, hailSlope_per_mm(rates[Hydrometeor::kHail]), kFirstHail,
              kBouncedClass);
  for (uint32_t i = 0; i < kBouncedClass; ++i) {
    const FallClass& c = fallClasses()[i];
    air.part[i] =
        -std::expm1(-air.slope_per_mm[static_cast<uint32_t>(c.hydrometeor)] * (c.to_mm - c.from_mm));
  }
  return air;
}

double InTheAir::quantile(uint32_t kind, double u) const {
  const FallClass& c = fallClasses()[kind];
  return rain::quantile(slope_per_mm[static_cast<uint32_t>(c.hydrometeor)], c.from_mm, c.to_mm, u);
}

double InTheAir::delivered_mm_h(uint32_t kind) const {
  const FallClass& c = fallClasses()[kind];
  const double slope = slope_per_mm[static_cast<uint32_t>(c.hydrometeor)];
  if (!(density_m3[kind] > 0.0)) return 0.0;
  return density_m3[kind] / (c.share * moment(0, slope, c.from_mm, c.to_mm)) * deliveredOfOne(c, slope);
}

}  // namespace rg::rain
