// The standing field: which drops a cell of a class's lattice holds, as a hash of (seed, class, cell).
#pragma once

#include <array>
#include <cstdint>

#include "rain/cells.h"
#include "rain/size_law.h"

namespace rg::rain {

// A drop that may be: it exists wherever its cell would be empty of drops with a probability, exp(-mean
// number), below `chance`. The chances of a cell are products of uniform numbers (Knuth, The Art of Computer
// Programming 2, 3.4.1), so that the drops that exist are a Poisson field of the right density at every rate,
// and a rate that changes only adds or takes away drops, never swaps them.
struct Candidate {
  double chance = 1.0;
  uint32_t fraction_x = 0, fraction_y = 0, fraction_z = 0;  // of the cell, 16 bits
  double size = 0.0;  // 0 .. 1, its place among the class's drops ordered by size
  uint32_t id = 0;
};

// Walks a cell's candidates, chances descending without end.
class Candidates {
 public:
  Candidates(uint64_t seed, const CellKey& cell);
  const Candidate& next();

 private:
  uint64_t draw();
  uint64_t state_;
  Candidate candidate_;
};

// What is fixed about a class: its drops and its cells.
struct ClassLattice {
  SpeedClass drops;
  double cell_m = 1.0;
  double cell_m3 = 1.0;
};
// Cells are a sixth of how far the class's largest drops are seen at visibility factor 1.25: small enough to
// follow the view's edge (they add about a half to its drops), large enough that a view's border has few.
const std::array<ClassLattice, kSpeedClasses>& classLattices();

// Densities of all classes as the rate was over the last seconds: rain that sets in fills the sky from above.
class RateHistory {
 public:
  static constexpr uint32_t kTicks = 1024;  // 8.5 s: longer than the slowest drop falls through the field
  struct Entry {
    SizeLaw law;
    std::array<double, kSpeedClasses> density_m3{};
    // Of a candidate's drop, in whole tenths of a micrometre, so that the last digit of a machine's logarithm
    // does not show.
    float diameter_m(uint32_t kind, double size) const;
    double per_slope_mm = 0.0;
    std::array<double, kSpeedClasses> from_mm{}, part{};  // 1 - exp(-slope * width)
  };
  void fill(double rate_mm_h);
  void add(double rate_mm_h);  // one tick on
  const Entry& now() const { return ring_[now_]; }
  const Entry& ago(uint32_t ticks) const {
    return ring_[(now_ + kTicks - (ticks < kTicks ? ticks : kTicks - 1)) % kTicks];
  }
  const Entry& wettest() const { return ring_[wettest_]; }  // a class has its most drops at the highest rate
  bool steady() const { return steady_ >= kTicks; }

 private:
  static Entry entryOf(double rate_mm_h);
  std::array<Entry, kTicks> ring_{};
  uint32_t now_ = 0, wettest_ = 0, steady_ = 0;
};

}  // namespace rg::rain
