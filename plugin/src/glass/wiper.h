// A wiper's blade over a pane: at which angle it crosses each texel, and from that what a stroke sweeps. No
// rate of ticks leaves gaps, because a texel is wiped when its angle lies in (before, now], whatever the step
// between both.
#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "glass/pane_map.h"

namespace rg::glass {

// Where a blade crosses a place, in the order of angle: more than once when it stands far across its arm or
// turns on it (pantographs).
struct Crossings {
  static constexpr int kMost = 4;
  int count = 0;
  double angle_rad[kMost] = {};
  double along_m[kMost] = {};  // from the blade's middle, towards its tip
  int segment[kMost] = {};     // piece of the blade, 0 .. kBladeSegments - 1, counted from the pivot's side
};

// One way of the blade, without reversal.
struct Sweep {
  double before_rad = 0.0;
  double now_rad = 0.0;
  bool covers(double angle_rad) const {
    return now_rad > before_rad ? angle_rad > before_rad && angle_rad <= now_rad
                                : angle_rad < before_rad && angle_rad >= now_rad;
  }
};

// Where a blade lies, vehicle frame.
struct BladePose {
  glm::dvec3 middle_m{0.0};
  glm::dvec3 along{0.0};   // unit, from the pivot's side to the tip
  glm::dvec3 across{0.0};  // unit, to greater angles
};
BladePose bladePose(const WiperInfo& info, double angle_rad);

// What a blade passes over in one sweep lies within near_m of this line.
struct SweptStrip {
  glm::dvec2 middle_m{0.0};  // in the plane of Wiper::inPlane
  glm::dvec2 along{0.0};     // unit
  double half_m = 0.0;
  double near_m = 0.0;
  double turned_rad = 0.0;  // so much farther for each metre beyond its ends
  // Whether a blade longer by `beyond_m` at both ends may pass within `off_m` of a place of that plane.
  bool reaches(const glm::dvec2& place_m, double beyond_m, double off_m) const {
    const double most_m = near_m + turned_rad * beyond_m + off_m;
    const glm::dvec2 d = place_m - middle_m;
    return std::abs(along.x * d.y - along.y * d.x) <= most_m &&
           std::abs(glm::dot(along, d)) <= half_m + beyond_m + most_m;
  }
};

// The glass on a tile of the map as a wiper's plane has it.
struct TileInPlane {
  glm::dvec2 low_m{0.0}, high_m{0.0};     // of the tile, grid
  glm::dvec2 middle_m{0.0};               // of its glass, grid
  glm::dvec2 place_m{0.0};                // where that is in the plane,
  glm::dvec2 along_x{0.0}, along_y{0.0};  // and how far a grid metre takes from there
  double off_m = 0.0;                     // no place of its glass is farther from where these say
  double radius_m = -1.0;                 // about `place_m`, of all its glass; less than 0: it has none

  // Whether drops of this radius and less may be crossed anywhere on it; one of them at a place.
  bool isNear(const SweptStrip& strip, double radius_m_of_drops) const {
    return radius_m >= 0.0 && strip.reaches(place_m, radius_m_of_drops, radius_m);
  }
  bool mayCross(const SweptStrip& strip, const glm::dvec2& grid_m, double radius_m_of_drop) const {
    const glm::dvec2 d = grid_m - middle_m;
    return strip.reaches(place_m + d.x * along_x + d.y * along_y, radius_m_of_drop, off_m);
  }
};

class Wiper {
 public:
  // `slot` is where its ridge's pieces begin: slot * kBladeSegments. `seed` is of its wear.
  Wiper(const WiperInfo& info, const PaneMap& map, int slot, uint32_t seed = 1);

  const WiperInfo& info() const { return info_; }
  int slot() const { return slot_; }
  uint64_t fingerprint() const;  // of what it is, and of its slot
  Crossings crossingsAt(const glm::dvec3& vehicle_m, double beyond_end_m = 0.0) const;
  BladePose poseAt(double angle_rad) const { return bladePose(info_, angle_rad); }

  // All texels the blade can cross: first crossings, then second ones and so on, each sorted by piece, then
  // angle. Shared with the GPU's copy of it.
  const std::shared_ptr<const std::vector<shared::SweptTexel>>& swept() const { return swept_; }
  // What of swept() a sweep crosses: kBladeSegments ranges for first crossings, as many for second ones ...
  std::vector<shared::SweptRange> ranges(const Sweep& sweep) const;
  SweptStrip stripOf(const Sweep& sweep) const;
  const std::vector<TileInPlane>& tiles() const { return tiles_; }  // as of the map

  // How far the blade has to turn, from where a sweep begins that meets something at `met_rad`, to this
  // texel's middle beside that; none: it does not come by. Less than 0: it has passed it.
  std::optional<double> ahead_rad(int texel, const Sweep& sweep, double met_rad) const;

  // Texels next to the blade where it turns round at `extreme_rad`, ahead of it in its old direction, for
  // each piece; none: the water leaves the glass.
  std::vector<std::vector<int>> aheadOf(double extreme_rad, double direction) const;
  // The piece is not over the pane at this angle.
  bool offGlass(int segment, double angle_rad) const;
  // How far a piece has still to turn until it has left the glass; < 0: it has.
  double toEdge_rad(int segment, double angle_rad, double direction) const;
  // Where a piece leaves the glass in this direction: the last texel it crosses; -1: it crosses none.
  int edgeTexel(int segment, double direction) const;
  // Way of a piece's middle for each radian that the arm turns.
  double turnsAt_m(int segment, double angle_rad) const;

 private:
  void findTiles(const PaneMap& map);
  glm::dvec2 inPlane(const glm::dvec3& vehicle_m) const;
  glm::dvec2 turnedInPlane(const glm::dvec3& d) const;  // of a vector
  // Angles at which the blade's line, endless, passes a place of its plane.
  std::vector<double> anglesOf(const glm::dvec2& place_m) const;

  WiperInfo info_;
  int slot_;
  glm::dvec3 side_{0.0};
  double texel_m_;
  std::shared_ptr<const std::vector<shared::SweptTexel>> swept_;
  std::vector<double> angles_;  // of swept_
  std::vector<size_t> starts_;  // of each piece's part of swept_, pass by pass; and its end
  // At which angles it crosses a texel's middle, and where a texel's begin.
  std::vector<double> crossed_rad_;
  std::vector<uint32_t> crossed_from_;
  std::vector<TileInPlane> tiles_;
  struct Ends {
    double low_rad = 1e9, high_rad = -1e9;
    int low_texel = -1, high_texel = -1;
    void reach(double angle_rad, int texel);
  };
  std::vector<Ends> ends_;  // of what each piece crosses
};

}  // namespace rg::glass
