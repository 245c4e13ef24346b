#include "gusts.h"

#include <array>
#include <cmath>

#include "shared/hash.glsl"
#include "tick.h"

namespace rg {
namespace {

// Across the wind as along it: 1.92 against 2.39 friction velocities (Panofsky & Dutton 1984).
constexpr double kAcross = 1.92 / 2.39;

constexpr int kOctaves = 3;
constexpr std::array<double, kOctaves> kVariance{1.0, 0.6299605249474366, 0.3968502629920499};  // 2^(-2i/3)

// Of cubic B-spline noise with knots of unit variance a knot's length apart: its variance, and its integral
// time scale in knots. Its autocorrelation is the B-spline of degree 7 (Unser 1999), 151/315 in the middle, 1
// in all.
constexpr double kNoiseVariance = 151.0 / 315.0;
constexpr double kNoiseTime = 0.5 / kNoiseVariance;

constexpr double sum(const std::array<double, kOctaves>& values) {
  double all = 0.0;
  for (const double v : values) all += v;
  return all;
}
// Of all octaves, the longest with knots a unit apart: each one's time counts by its variance.
constexpr double kTime =
    kNoiseTime * (kVariance[0] + kVariance[1] / 2.0 + kVariance[2] / 4.0) / sum(kVariance);

enum Axis : uint32_t { kAlong, kCross };

// Uniform with variance 1.
double knot(uint64_t seed, Axis axis, int octave, int64_t index) {
  const auto i = static_cast<uint64_t>(index);
  const shared::uvec4 h =
      shared::pcg4d({static_cast<uint32_t>(seed),
                     static_cast<uint32_t>(seed >> 32) ^
                         shared::pcg(static_cast<uint32_t>(axis) * kOctaves + static_cast<uint32_t>(octave)),
                     static_cast<uint32_t>(i), static_cast<uint32_t>(i >> 32)});
  constexpr double kWidth = 3.4641016151377544;  // sqrt(12)
  return kWidth * (static_cast<double>(shared::openUnitFloat(h.x)) - 0.5);
}

// From sums and products alone, so that every machine's wind is the same.
double noise(uint64_t seed, Axis axis, int octave, double at) {
  const double from = std::floor(at), f = at - from, g = 1.0 - f;
  const auto i = static_cast<int64_t>(from);
  const double weights[4] = {g * g * g, 4.0 + 3.0 * f * f * (f - 2.0), 4.0 + 3.0 * g * g * (g - 2.0),
                             f * f * f};
  double value = 0.0;
  for (int k = 0; k < 4; ++k) value += weights[k] / 6.0 * knot(seed, axis, octave, i + k);
  return value;
}

// Of unit variance, with an integral time scale of time_s.
double swing(const Gusts& gusts, Axis axis, int64_t tick) {
  const double longest = static_cast<double>(tick) * kTickSeconds * kTime / gusts.time_s;
  double value = 0.0;
  for (int octave = 0; octave < kOctaves; ++octave) {
    value += std::sqrt(kVariance[static_cast<size_t>(octave)] / (sum(kVariance) * kNoiseVariance)) *
             noise(gusts.seed, axis, octave, longest * (1 << octave));
  }
  return value;
}

}  // namespace

glm::dvec3 Gusts::at(int64_t tick, const glm::dvec3& mean_mps) const {
  if (share == 0.0) return mean_mps;
  const glm::dvec3 along(mean_mps.x, mean_mps.y, 0.0), across(-mean_mps.y, mean_mps.x, 0.0);
  const glm::dvec3 wind_mps =
      mean_mps + share * (swing(*this, kAlong, tick) * along + kAcross * swing(*this, kCross, tick) * across);
  return glm::clamp(wind_mps, glm::dvec3(-kStrongestWind_mps), glm::dvec3(kStrongestWind_mps));
}

}  // namespace rg
