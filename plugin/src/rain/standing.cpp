#include "rain/standing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rg::rain {
namespace {

constexpr double kReferenceReach_per_m = 1.25 * 1663.0;  // visibility factor 1.25 at the reference resolution
constexpr double kCellsPerReach = 6.0;

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

const std::array<ClassLattice, kClasses>& classLattices() {
  static const std::array<ClassLattice, kClasses> lattices = [] {
    std::array<ClassLattice, kClasses> made;
    for (uint32_t i = 0; i < kClasses; ++i) {
      ClassLattice& lattice = made[i];
      lattice.drops = fallClasses()[i];
      lattice.largest_mm = drawnDiameter_mm(lattice.drops.hydrometeor, lattice.drops.to_mm);
      const bool swings = lattice.drops.hydrometeor == Hydrometeor::kSnow ||
                          lattice.drops.hydrometeor == Hydrometeor::kMeltingSnow;
      if (swings) lattice.swing_m = static_cast<double>(shared::kRainSwing) * 1e-3 * lattice.largest_mm;
      const auto hydrometeor = static_cast<int32_t>(lattice.drops.hydrometeor);
      lattice.reach_mm =
          lattice.drops.seen *
          std::min(lattice.largest_mm, 1e3 * static_cast<double>(shared::rainReachDiameter(hydrometeor)));
      // Rounded, so that the last digits of a machine's exp and log do not decide where drops are.
      lattice.cell_m =
          std::round(kReferenceReach_per_m * 1e-3 * lattice.reach_mm / kCellsPerReach * 0x1p20) * 0x1p-20;
      if (i == kBouncedClass) lattice.cell_m = 0x1p-12;
      lattice.cell_m3 = lattice.cell_m * lattice.cell_m * lattice.cell_m;
    }
    return made;
  }();
  return lattices;
}

float diameterOf_m(const InTheAir& air, uint32_t kind, double size) {
  const FallClass& c = fallClasses()[kind];
  const double slope = air.slope_per_mm[static_cast<uint32_t>(c.hydrometeor)];
  const double mm = slope > 0.0 ? c.from_mm - portableLog(1.0 - size * air.part[kind]) / slope : c.from_mm;
  const double across_mm = drawnDiameter_mm(c.hydrometeor, mm);
  return static_cast<float>(static_cast<double>(static_cast<int64_t>(across_mm * 1e4 + 0.5)) * 1e-7);
}

void RateHistory::fill(const Rates& rates) {
  ring_.fill(InTheAir::of(rates));
  now_ = 0;
  steady_ = kTicks;
  most_m3_ = ring_[0].density_m3;
  most_of_block_.fill(most_m3_);
}

void RateHistory::add(const Rates& rates) {
  const uint32_t before = now_;
  now_ = (now_ + 1) % kTicks;
  const bool same = rates == ring_[before].rates;
  if (same && steady()) return;  // all entries are alike
  ring_[now_] = same ? ring_[before] : InTheAir::of(rates);
  steady_ = same ? steady_ + 1 : 1;
  noteMost();
}

// A block that is being written anew keeps the most of what was in it until it is full.
void RateHistory::noteMost() {
  Densities& block = most_of_block_[now_ / kBlock];
  if ((now_ + 1) % kBlock == 0) {
    block.fill(0.0);
    for (uint32_t i = now_ + 1 - kBlock; i <= now_; ++i) {
      for (uint32_t kind = 0; kind < kClasses; ++kind)
        block[kind] = std::max(block[kind], ring_[i].density_m3[kind]);
    }
  }
  for (uint32_t kind = 0; kind < kClasses; ++kind)
    block[kind] = std::max(block[kind], ring_[now_].density_m3[kind]);
  most_m3_.fill(0.0);
  for (const Densities& of : most_of_block_) {
    for (uint32_t kind = 0; kind < kClasses; ++kind) most_m3_[kind] = std::max(most_m3_[kind], of[kind]);
  }
}

}  // namespace rg::rain
