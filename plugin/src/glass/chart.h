// Where a pane's vertices lie on the flat grid of its water: as the host's uvs have it where they are one
// even chart, else laid flat anew from the positions, so that seams and uneven uvs change nothing.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "glass/pane.h"

namespace rg::glass {

// Of a mesh on its chart.
struct ChartTriangle {
  std::array<glm::dvec3, 3> p;
  std::array<glm::dvec2, 3> uv;
  glm::dvec3 normal_area() const { return 0.5 * glm::cross(p[1] - p[0], p[2] - p[0]); }
  double uvArea() const {
    const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
    return 0.5 * (a.x * b.y - a.y * b.x);
  }
  // dP/du and dP/dv
  std::pair<glm::dvec3, glm::dvec3> derivatives() const {
    const glm::dvec2 a = uv[1] - uv[0], b = uv[2] - uv[0];
    const double inv = 1.0 / (2.0 * uvArea());
    const glm::dvec3 e = p[1] - p[0], f = p[2] - p[0];
    return {(e * b.y - f * a.y) * inv, (f * a.x - e * b.x) * inv};
  }
};

using Chart = std::vector<glm::dvec2>;  // of each vertex

ChartTriangle triangleOf(const PaneInfo& info, const Chart& chart, size_t t);

// Metres of glass for a unit along u and v, in the mean square over it.
glm::dvec2 metresPerUnit(const PaneInfo& info, const Chart& chart);

[[noreturn]] void refusePane(const PaneInfo& info, const std::string& why);

// The mesh is checked but for overlaps: the caller finds those of the chart it gets. Throws
// std::invalid_argument naming the pane where uvs in several pieces overlap, or the pane is too curved to be
// laid flat as its seams make it necessary.
Chart chartOf(const PaneInfo& info);

}  // namespace rg::glass
