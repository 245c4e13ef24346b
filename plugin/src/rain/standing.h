// The standing field: which drops a cell of a class's lattice holds, as a hash of (seed, class, cell).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rain/cells.h"
#include "rain/hydrometeors.h"
#include "saved/archive.h"

namespace rg::rain {

// Drops that may be, of one class, column by column. One exists wherever its cell would be empty of drops
// with a probability, exp(-mean number), below `chance`. The chances of a cell are products of uniform
// numbers (Knuth, The Art of Computer Programming 2, 3.4.1), so that the drops that exist are a Poisson field
// of the right density at every rate, and a rate that changes only adds or takes away drops, never swaps
// them.
struct Candidates {
  std::vector<double> chance;
  std::vector<double> size;  // 0 .. 1, its place among the class's drops ordered by size
  std::vector<int32_t> x, y, z;
  std::vector<uint32_t> fraction_xy, fraction_z;  // of the cell, 16 bits each
  std::vector<uint32_t> id;

  size_t count = 0;  // columns have room for more
  void makeRoom(size_t for_count);
  void move(size_t to, size_t from);
};

// Steele, Lea & Flood (2014), "Fast splittable pseudorandom number generators": SplitMix64.
inline constexpr uint64_t kSplitMixStep = 0x9e3779b97f4a7c15u;
inline uint64_t splitMix(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

// A cube of 2^level cells of the standing lattice along each axis.
struct Block {
  int32_t x = 0, y = 0, z = 0;  // the first cell
  uint32_t level = 0;
  uint32_t kind = 0;
};
// Adds those candidates of the block's cells whose chance is above `least`.
void findCandidates(uint64_t seed, const Block& block, double least, Candidates& out);

// What is fixed about a class: its drops and its cells.
struct ClassLattice {
  FallClass drops;
  double largest_mm = 0.0;  // across, as drawn
  double swing_m = 0.0;     // of flakes about their way, as drawn
  double reach_mm = 0.0;    // how far it is seen goes by this: largest_mm, or less
  double cell_m = 1.0;
  double cell_m3 = 1.0;
};
// Cells are a sixth of how far the class's largest drops are seen at visibility factor 1.25: small enough to
// follow the view's edge (they add about a half to its drops), large enough that a view's border has few.
// Bounced stones stand in a lattice of 1/4096 m that is at rest: its cells are places.
const std::array<ClassLattice, kClasses>& classLattices();

// What a candidate's particle measures across, in whole tenths of a micrometre, so that the last digit of a
// machine's logarithm does not show.
float diameterOf_m(const InTheAir& air, uint32_t kind, double size);
void diametersOf_m(const InTheAir& air, uint32_t kind, std::span<const double> sizes, std::span<float> out);

// Densities of all classes as the rates were over the last seconds: rain that sets in fills the sky from
// above.
class RateHistory {
 public:
  static constexpr uint32_t kTicks = 4096;  // 34 s: longer than the slowest flake falls through the field
  void fill(const Rates& rates);
  void add(const Rates& rates);  // one tick on
  const InTheAir& now() const { return ring_[now_]; }
  const InTheAir& ago(uint32_t ticks) const {
    return ring_[(now_ + kTicks - (ticks < kTicks ? ticks : kTicks - 1)) % kTicks];
  }
  // Density of a class at its highest in the history, or a little longer ago; 0: there is none of it.
  double most_m3(uint32_t kind) const { return most_m3_[kind]; }
  bool steady() const { return steady_ >= kTicks; }

  void write(saved::Writer& a) const;
  void read(saved::Reader& a);

 private:
  using Densities = std::array<double, kClasses>;
  static constexpr uint32_t kBlock = 32;

  void noteMost();
  void findMost();

  std::array<InTheAir, kTicks> ring_{};
  std::array<Densities, kTicks / kBlock> most_of_block_{};
  Densities most_m3_{};
  uint32_t now_ = 0, steady_ = 0;
};

}  // namespace rg::rain
