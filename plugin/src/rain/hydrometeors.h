// All that falls, in classes of what falls alike: rain, snow, snow that melts, hail; and how many of each
// class are in the air at given rates.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "rain/size_law.h"
#include "shared/rain_streak.glsl"
#include "tick.h"

namespace rg::rain {

enum class Hydrometeor : uint32_t {
  kRain = shared::kRainIsRain,
  kSnow = shared::kRainIsSnow,
  kMeltingSnow = shared::kRainIsMeltingSnow,
  kHail = shared::kRainIsHail,
  kBouncedHail = shared::kRainIsBouncedHail,  // falls no more
};
inline constexpr uint32_t kHydrometeors = 5;

inline constexpr uint32_t kClasses = shared::kRainClasses;
// Snow drifts unevenly: each of ten groups has a velocity of its own beside that of its size.
inline constexpr uint32_t kDriftGroups = 10;
inline constexpr uint32_t kFlakeSizes = 4, kMeltingSizes = 6, kStoneSizes = 6;
// Where each one's classes begin: rain's by speed, then snow's by size and in each by group, and so on.
inline constexpr uint32_t kFirstSnow = kSpeedClasses;
inline constexpr uint32_t kFirstMelting = kFirstSnow + kFlakeSizes * kDriftGroups;
inline constexpr uint32_t kFirstHail = kFirstMelting + kMeltingSizes;
inline constexpr uint32_t kBouncedClass = kFirstHail + kStoneSizes;
static_assert(kBouncedClass + 1 == kClasses);

// Rates as water, mm/h.
struct Rates {
  std::array<double, kHydrometeors> mm_h{};
  double& operator[](Hydrometeor h) { return mm_h[static_cast<uint32_t>(h)]; }
  double operator[](Hydrometeor h) const { return mm_h[static_cast<uint32_t>(h)]; }
  bool operator==(const Rates&) const = default;
};
// Of a tick's weather, as far as they can be used: each within 0..300, no number counts as 0. From 0 to +2
// deg C snow melts as it falls.
Rates ratesOf(const WeatherState& weather);

// What falls alike. Sizes are those the laws are told in: of a drop or stone its diameter, of a flake that of
// the drop it melts to.
struct FallClass {
  Hydrometeor hydrometeor = Hydrometeor::kRain;
  double from_mm = 0.0, to_mm = 0.0;
  double speed_mps = 0.0;     // downwards
  glm::dvec2 drift_mps{0.0};  // sideways, beside the wind
  double share = 1.0;         // of the particles of its sizes
  double seen = 1.0;          // how far it is drawn, by what its diameter would say
};
const std::array<FallClass, kClasses>& fallClasses();

// What a particle of the laws' size measures across, mm.
double drawnDiameter_mm(Hydrometeor hydrometeor, double size_mm);

// The laws of all classes at given rates.
struct InTheAir {
  Rates rates;
  std::array<double, kHydrometeors> slope_per_mm{};  // of sizes ~ exp(-slope D)
  std::array<double, kClasses> density_m3{};         // particles per m3
  std::array<double, kClasses> part{};               // 1 - exp(-slope * a class's width)
  // Rain by its law (SizeLaw); of the others the classes together deliver exactly their rates.
  static InTheAir of(const Rates& rates);

  // The laws' size below which the share u (0..1) of a class's particles lies.
  double quantile(uint32_t kind, double u) const;
  // Water that a class brings down, mm/h: closed form at the class's speed.
  double delivered_mm_h(uint32_t kind) const;
};

}  // namespace rg::rain
