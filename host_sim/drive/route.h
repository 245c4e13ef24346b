// The line a car follows, by arc length.
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace host {

class Route {
 public:
  // A smooth line through the points (world frame, two or more, no two alike in a row): centripetal
  // Catmull-Rom, tabulated every half metre.
  explicit Route(const std::vector<glm::dvec3>& points_m, bool closed = false);

  double length_m() const;
  bool closed() const { return closed_; }
  // The ways below are taken modulo the length on a closed route; elsewhere the line goes straight on beyond
  // its ends.
  glm::dvec3 position(double way_m) const;
  // Unit direction of travel.
  glm::dvec3 direction(double way_m) const;
  // 1 / radius in the horizontal plane, positive in left bends; averaged over a few metres as a driver takes
  // the bend.
  double curvature_per_m(double way_m) const;
  // The way of the nearest point, searched around `near_m` (for a person at the wheel), and over the whole
  // route when near_m < 0.
  double nearestWay(const glm::dvec3& position_m, double near_m) const;

 private:
  double wrapped(double way_m) const;
  glm::dvec3 sample(double way_m) const;

  std::vector<glm::dvec3> table_;  // every kStep_m
  bool closed_ = false;
};

}  // namespace host
