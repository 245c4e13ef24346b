#include "rain/standing.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace rg::rain {
namespace {

constexpr double kReferenceReach_per_m = 1.25 * 1663.0;  // visibility factor 1.25 at the reference resolution
constexpr double kCellsPerReach = 6.0;

// ln(x) for x in (0, 1] (not below 1e-300), from exact operations alone so that every machine's rain is the
// same: x = m 2^e with m in [sqrt(1/2), sqrt(2)), ln m = 2 atanh((m - 1) / (m + 1)), |s| < 0.172 below. So
// many terms of its series leave out less than 3e-8. No branches: several are worked out side by side.
inline double portableLog(double x) {
  constexpr uint64_t kRootHalf = 0x3fe6a09e667f3bcdu, kMantissa = 0x000fffffffffffffu;
  constexpr uint64_t kEven = 0x4330000000000000u;  // 2^52: what is put into its lowest bits is added to it
  const uint64_t above = std::bit_cast<uint64_t>(x) + (0x3ff0000000000000u - kRootHalf);
  const double exponent = std::bit_cast<double>(above >> 52 | kEven) - (0x1p52 + 1023.0);
  const double m = std::bit_cast<double>((above & kMantissa) + kRootHalf);
  const double s = (m - 1.0) / (m + 1.0), q = s * s;
  return 2.0 * s * (1.0 + q * (1.0 / 3 + q * (1.0 / 5 + q * (1.0 / 7)))) + exponent * 0.69314718055994531;
}

// What the sizes of a class are spread by.
struct Spread {
  Spread(const InTheAir& air, uint32_t kind) : part(air.part[kind]), from_mm(fallClasses()[kind].from_mm) {
    const double slope = air.slope_per_mm[static_cast<uint32_t>(fallClasses()[kind].hydrometeor)];
    length_mm = slope > 0.0 ? 1.0 / slope : 0.0;
  }
  double sizeAt_mm(double share) const { return from_mm - length_mm * portableLog(1.0 - part * share); }
  double part, from_mm, length_mm;
};

inline float inSteps_m(double mm) {
  // Sizes are above 0, and lround would not do several at a time.
  // NOLINTNEXTLINE(bugprone-incorrect-roundings)
  return static_cast<float>(static_cast<double>(static_cast<int32_t>(mm * 1e4 + 0.5)) * 1e-7);
}

constexpr size_t kSizesAtOnce = 8;  // diameters: as many as a machine works out side by side, whichever it is

void sizesOf_m(const Spread& spread, const double* shares, float* out) {
  std::array<float, kSizesAtOnce> sizes;
  for (size_t i = 0; i < kSizesAtOnce; ++i) sizes[i] = inSteps_m(spread.sizeAt_mm(shares[i]));
  std::copy(sizes.begin(), sizes.end(), out);
}

constexpr uint32_t kCellsAtOnce = 64;

inline double halfOpen(uint32_t bits) { return (static_cast<double>(bits) + 0.5) * 0x1p-32; }

// Cells of which a candidate has been drawn that exists: it is the next one's turn.
struct Opened {
  std::array<uint64_t, kCellsAtOnce> state, drawn;
  std::array<double, kCellsAtOnce> chance;
  std::array<uint32_t, kCellsAtOnce> cell;

  // Draws a cell's next candidate, as the `count`-th. Returns how many there are then: the cell is forgotten
  // when its chance, and so every later one's, is not above `least`. As that is unforeseeable, a jump would
  // cost more than what it spares.
  uint32_t drawNext(uint32_t count, uint64_t before, double chance_before, uint32_t of, double least) {
    state[count] = before + kSplitMixStep;
    drawn[count] = splitMix(state[count]);
    chance[count] = chance_before * halfOpen(static_cast<uint32_t>(drawn[count] >> 32));
    cell[count] = of;
    return count + (chance[count] > least ? 1u : 0u);
  }
};

// Which of its block a cell is: counted along z, then y, then x.
struct Within {
  Within(uint32_t cell, uint32_t level)
      : x(cell >> 2 * level), y(cell >> level & ((1u << level) - 1)), z(cell & ((1u << level) - 1)) {}
  uint32_t x, y, z;
};

// The first candidates of the cells [first, last) of a block.
uint32_t open(uint64_t seed, const Block& block, uint32_t first, uint32_t last, double least,
              Opened& opened) {
  uint32_t count = 0;
  uint64_t row = 0;
  for (uint32_t cell = first; cell < last; ++cell) {
    const Within at(cell, block.level);
    const uint32_t x = static_cast<uint32_t>(block.x) + at.x, y = static_cast<uint32_t>(block.y) + at.y,
                   z = static_cast<uint32_t>(block.z) + at.z;
    if (cell == first || at.z == 0) row = splitMix(splitMix(seed + kSplitMixStep) ^ (uint64_t{x} << 32 | y));
    count = opened.drawNext(count, splitMix(row + (uint64_t{z} << 32 | block.kind)), 1.0, cell, least);
  }
  return count;
}

// Writes out a candidate of each opened cell and draws their next ones.
uint32_t takeRound(const Block& block, uint32_t count, double least, Opened& opened, Candidates& out) {
  const size_t begin = out.count;
  out.makeRoom(begin + count);
  out.count += count;
  // Where the columns lie is known to stay while they are written.
  double *chance = &out.chance[begin], *size = &out.size[begin];
  int32_t *x = &out.x[begin], *y = &out.y[begin], *z = &out.z[begin];
  uint32_t *fraction_xy = &out.fraction_xy[begin], *fraction_z = &out.fraction_z[begin], *id = &out.id[begin];
  uint32_t left = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t state = opened.state[i] + kSplitMixStep, a = opened.drawn[i], b = splitMix(state);
    const uint32_t cell = opened.cell[i];
    const Within at(cell, block.level);
    chance[i] = opened.chance[i];
    size[i] = halfOpen(static_cast<uint32_t>(a));
    x[i] = block.x + static_cast<int32_t>(at.x);
    y[i] = block.y + static_cast<int32_t>(at.y);
    z[i] = block.z + static_cast<int32_t>(at.z);
    fraction_xy[i] = static_cast<uint32_t>(b);
    fraction_z[i] = static_cast<uint32_t>(b >> 32 & 0xffffu);
    id[i] = static_cast<uint32_t>(a ^ b >> 32);
    left = opened.drawNext(left, state, opened.chance[i], cell, least);
  }
  return left;
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
  return inSteps_m(drawnDiameter_mm(fallClasses()[kind].hydrometeor, Spread(air, kind).sizeAt_mm(size)));
}

void diametersOf_m(const InTheAir& air, uint32_t kind, std::span<const double> sizes, std::span<float> out) {
  size_t i = 0;
  if (fallClasses()[kind].hydrometeor == Hydrometeor::kRain) {  // as wide as the laws say
    const Spread spread(air, kind);
    for (; i + kSizesAtOnce <= sizes.size(); i += kSizesAtOnce) sizesOf_m(spread, &sizes[i], &out[i]);
  }
  for (; i < sizes.size(); ++i) out[i] = diameterOf_m(air, kind, sizes[i]);
}

void Candidates::makeRoom(size_t for_count) {
  if (for_count <= chance.size()) return;
  const size_t room = std::bit_ceil(std::max<size_t>(for_count, 1024));
  for (auto* column : {&chance, &size}) column->resize(room);
  for (auto* column : {&x, &y, &z}) column->resize(room);
  for (auto* column : {&fraction_xy, &fraction_z, &id}) column->resize(room);
}

void Candidates::move(size_t to, size_t from) {
  for (auto* column : {&chance, &size}) (*column)[to] = (*column)[from];
  for (auto* column : {&x, &y, &z}) (*column)[to] = (*column)[from];
  for (auto* column : {&fraction_xy, &fraction_z, &id}) (*column)[to] = (*column)[from];
}

// Round by round: the first candidates of many cells, then the second ones of those that have any, and so on.
// How many a cell has is unforeseeable; how many of all have one more is told by the round before.
void findCandidates(uint64_t seed, const Block& block, double least, Candidates& out) {
  const uint32_t cells = 1u << 3 * block.level;
  Opened opened;
  for (uint32_t first = 0; first < cells; first += kCellsAtOnce) {
    uint32_t count = open(seed, block, first, std::min(first + kCellsAtOnce, cells), least, opened);
    while (count > 0) count = takeRound(block, count, least, opened, out);
  }
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
  findMost();
}

void RateHistory::findMost() {
  most_m3_.fill(0.0);
  for (const Densities& of : most_of_block_) {
    for (uint32_t kind = 0; kind < kClasses; ++kind) most_m3_[kind] = std::max(most_m3_[kind], of[kind]);
  }
}

// As runs of what is alike: rates seldom change.
void RateHistory::write(saved::Writer& a) const {
  a(now_, steady_);
  for (uint32_t i = 0; i < kTicks;) {
    uint32_t end = i + 1;
    while (end < kTicks && ring_[end].rates == ring_[i].rates) ++end;
    const uint32_t run = end - i;
    a(run, ring_[i].rates.mm_h);
    i = end;
  }
  for (uint32_t i = 0; i < most_of_block_.size();) {
    uint32_t end = i + 1;
    while (end < most_of_block_.size() && most_of_block_[end] == most_of_block_[i]) ++end;
    const uint32_t run = end - i;
    a(run, most_of_block_[i]);
    i = end;
  }
}

void RateHistory::read(saved::Reader& a) {
  a.within(now_, 0u, kTicks - 1);
  a(steady_);
  for (uint32_t i = 0; i < kTicks;) {
    uint32_t run = 0;
    Rates rates;
    a.within(run, 1u, kTicks - i);
    a.within(rates.mm_h, 0.0, 300.0);
    std::fill_n(ring_.begin() + i, run, InTheAir::of(rates));
    i += run;
  }
  for (uint32_t i = 0; i < most_of_block_.size();) {
    uint32_t run = 0;
    Densities densities{};
    a.within(run, 1u, static_cast<uint32_t>(most_of_block_.size()) - i);
    a.within(densities, 0.0, 1e7);
    std::fill_n(most_of_block_.begin() + i, run, densities);
    i += run;
  }
  findMost();
}

}  // namespace rg::rain
