#include "rain/standing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rg::rain {
namespace {

constexpr double kReferenceReach_per_m = 1.25 * 1663.0;  // visibility factor 1.25 at the reference resolution
constexpr double kCellsPerReach = 6.0;

// Steele, Lea & Flood (2014), "Fast splittable pseudorandom number generators": SplitMix64's mixing.
uint64_t mix(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// ln(x) for x in (0, 1] (not below 1e-300), from exact operations alone so that every machine's rain is the
// same: x = m 2^e, ln m = 2 atanh((m - 1) / (m + 1)), |s| < 0.172 below. So many terms of its series leave
// out less than 3e-8.
double portableLog(double x) {
  const auto bits = std::bit_cast<uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1022;
  double mantissa = std::bit_cast<double>((bits & 0x000fffffffffffffu) | 0x3fe0000000000000u);  // 0.5 .. 1
  if (mantissa < 0.70710678118654752) {
    mantissa *= 2.0;
    --exponent;
  }
  const double s = (mantissa - 1.0) / (mantissa + 1.0), q = s * s;
  return 2.0 * s * (1.0 + q * (1.0 / 3 + q * (1.0 / 5 + q / 7))) + exponent * 0.69314718055994531;
}

}  // namespace

Candidates::Candidates(uint64_t seed, const CellKey& cell) {
  const uint64_t xy = uint64_t{static_cast<uint32_t>(cell.x)} << 32 | static_cast<uint32_t>(cell.y);
  const uint64_t zk = uint64_t{static_cast<uint32_t>(cell.z)} << 32 | cell.kind;
  state_ = mix(mix(mix(seed + 0x9e3779b97f4a7c15u) ^ xy) + zk);
}

uint64_t Candidates::draw() {
  state_ += 0x9e3779b97f4a7c15u;
  return mix(state_);
}

const Candidate& Candidates::next() {
  const uint64_t a = draw(), b = draw();
  candidate_.chance *= (static_cast<double>(a >> 32) + 0.5) * 0x1p-32;
  candidate_.size = (static_cast<double>(a & 0xffffffffu) + 0.5) * 0x1p-32;
  candidate_.fraction_x = static_cast<uint32_t>(b & 0xffffu);
  candidate_.fraction_y = static_cast<uint32_t>(b >> 16 & 0xffffu);
  candidate_.fraction_z = static_cast<uint32_t>(b >> 32 & 0xffffu);
  candidate_.id = static_cast<uint32_t>(a ^ b >> 32);
  return candidate_;
}

const std::array<ClassLattice, kSpeedClasses>& classLattices() {
  static const std::array<ClassLattice, kSpeedClasses> lattices = [] {
    std::array<ClassLattice, kSpeedClasses> made;
    for (uint32_t i = 0; i < kSpeedClasses; ++i) {
      made[i].drops = speedClasses()[i];
      // Rounded, so that the last digits of a machine's exp and log do not decide where drops are.
      made[i].drops.speed_mps = std::round(made[i].drops.speed_mps * 0x1p20) * 0x1p-20;
      made[i].cell_m =
          std::round(kReferenceReach_per_m * 1e-3 * made[i].drops.to_mm / kCellsPerReach * 0x1p20) * 0x1p-20;
      made[i].cell_m3 = made[i].cell_m * made[i].cell_m * made[i].cell_m;
    }
    return made;
  }();
  return lattices;
}

RateHistory::Entry RateHistory::entryOf(double rate_mm_h) {
  Entry entry;
  entry.law = SizeLaw::of(rate_mm_h);
  entry.per_slope_mm = entry.law.slope_per_mm > 0.0 ? 1.0 / entry.law.slope_per_mm : 0.0;
  for (uint32_t i = 0; i < kSpeedClasses; ++i) {
    const SpeedClass& c = speedClasses()[i];
    entry.density_m3[i] = entry.law.numberDensity(c.from_mm, c.to_mm);
    entry.from_mm[i] = c.from_mm;
    entry.part[i] = -std::expm1(-entry.law.slope_per_mm * (c.to_mm - c.from_mm));
  }
  return entry;
}

// As SizeLaw::quantile, for a thousandth of what diameters are rounded to.
float RateHistory::Entry::diameter_m(uint32_t kind, double size) const {
  const double mm = from_mm[kind] - portableLog(1.0 - size * part[kind]) * per_slope_mm;
  return static_cast<float>(static_cast<double>(static_cast<int64_t>(mm * 1e4 + 0.5)) * 1e-7);
}

void RateHistory::fill(double rate_mm_h) {
  ring_.fill(entryOf(rate_mm_h));
  now_ = wettest_ = 0;
  steady_ = kTicks;
}

void RateHistory::add(double rate_mm_h) {
  const uint32_t before = now_;
  now_ = (now_ + 1) % kTicks;
  const bool same = SizeLaw::of(rate_mm_h).rate_mm_h == ring_[before].law.rate_mm_h;
  if (same && steady()) return;  // all entries are alike
  ring_[now_] = same ? ring_[before] : entryOf(rate_mm_h);
  steady_ = same ? steady_ + 1 : 1;
  for (uint32_t i = 0; i < kTicks; ++i) {
    if (ring_[i].law.rate_mm_h > ring_[wettest_].law.rate_mm_h) wettest_ = i;
  }
}

}  // namespace rg::rain
