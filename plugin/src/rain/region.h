// Which cells of a class's standing lattice a view looks into: found row by row, as the volume is convex.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "saved/inputs.h"
#include "tick.h"

namespace rg::rain {

// The near part of a view's frustum, from its eye, world axes. Side planes only: the field does not end at
// the host's near or far plane.
struct Cone {
  glm::dvec3 eye_m{0.0};
  std::array<glm::dvec3, 4> inward;   // unit normals of the side planes, all through the eye
  std::array<glm::dvec3, 4> corners;  // unit directions of the edges
  bool valid = false;                 // false: the matrices are no perspective view
  static void visit(auto& a, auto& cone) {
    a.within(cone.eye_m, -kAnyNumber, kAnyNumber);
    a.within(cone.inward, -kAnyNumber, kAnyNumber);
    a.within(cone.corners, -kAnyNumber, kAnyNumber);
    a(cone.valid);
  }
};
Cone coneOf(const ViewState& view);
// The view ray through clip (x, y) is middle + x right + y up, world axes, as long as makes its depth 1.
struct Rays {
  glm::dvec3 middle{0.0}, right{0.0}, up{0.0};
};
Rays raysOf(const Cone& cone, const ViewState& view);
// How long a view's streaks are exposed: 0 .. 0.25 s; what is no number counts as 0.
double exposureOf(const ViewState& view);
glm::dvec3 eyeVelocityOf(const ViewState& view);  // 0 when it is no number

// How far beyond the cone cells are wanted, so that no drop or streak is missed until the next tick.
struct Margin {
  glm::dvec3 ahead_m{
      0.0};  // a drop's way past the eye in the coming tick: room where drops come in, none where they go out
  glm::dvec3 streak_m{0.0};  // half a streak, either sense
  double sides_m = 0.0;      // at the sides, for turning
  double reach_m = 0.0;      // how far the class is seen ..
  glm::dvec3 middle_m{0.0};  // .. about this place, from the eye
};

// What a cone widened by a margin is bounded by.
struct Region {
  Region() = default;
  Region(const Cone& cone, const Margin& margin);
  // Whether all of the other one lies within, its eye having `moved_m` from this one's.
  bool holds(const Region& other, const glm::dvec3& moved_m) const;

  std::array<glm::dvec3, 4> inward{};
  std::array<double, 4> wider_m{};  // so far out the sides lie
  double reach_m = 0.0;
  glm::dvec3 middle_m{0.0};

  static void visit(auto& a, auto& region) {
    a.within(region.inward, -1.1, 1.1);
    a(region.wider_m, region.reach_m, region.middle_m);
  }
};

// Cells [first, last) of a row along x.
struct RowSpan {
  int32_t first = 0;
  int32_t last = 0;
  bool operator==(const RowSpan&) const = default;
};

// The rows of a region: y in [y0, y0 + ny), z in [z0, z0 + nz). Those of one y follow each other, and are
// followed by those of the next, but for room to find them so many at once.
struct RowSet {
  static constexpr int32_t kRows = 48, kAtOnce = 8;
  static_assert(kRows % kAtOnce == 0);
  static constexpr int32_t kFarthest = 1 << 28, kLongest = 64;  // row, and cells of it
  int32_t y0 = 0, z0 = 0, ny = 0, nz = 0;
  std::array<RowSpan, size_t{kRows} * kRows> rows;

  bool hasZ(int32_t z) const { return z >= z0 && z < z0 + nz; }
  // The rows of one y, from z0 on; null when there are none.
  const RowSpan* line(int32_t y) const { return y >= y0 && y < y0 + ny ? &rows[at(y)] : nullptr; }
  RowSpan* line(int32_t y) { return &rows[at(y)]; }
  void clear() { ny = nz = 0; }

  template <class Archive>
  static void visit(Archive& a, auto& set) {
    a.within(set.y0, -kFarthest, kFarthest), a.within(set.z0, -kFarthest, kFarthest);
    a.within(set.ny, 0, kRows), a.within(set.nz, 0, kRows);
    for (int32_t y = set.y0; y < set.y0 + set.ny; ++y) {
      auto* span = set.line(y);
      for (int32_t i = 0; i < set.nz; ++i, ++span) {
        auto count = static_cast<uint8_t>(span->last - span->first);
        a.within(span->first, -kFarthest, kFarthest);
        a.within(count, 0, kLongest);
        if constexpr (Archive::kReads) span->last = span->first + count;
      }
    }
  }

 private:
  size_t at(int32_t y) const {
    return static_cast<size_t>(y - y0) * static_cast<size_t>((nz + kAtOnce - 1) / kAtOnce * kAtOnce);
  }
};

// The cells whose cube touches the cone widened by the margin (a few more at its edges). `eye_cells` is the
// eye's place in the lattice, in cells. A region too large for RowSet is cut at 22 cells from the eye.
void findRows(const Cone& cone, const Margin& margin, const glm::dvec3& eye_cells, double cell_m,
              RowSet& out);

}  // namespace rg::rain
