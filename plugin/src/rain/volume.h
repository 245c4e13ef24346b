// Convex volumes of air that rain does not reach: below a roof, in a tunnel, a car's cabin.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "saved/archive.h"

namespace rg::rain {

// Inside where dot(normal, p) <= d.
struct Plane {
  glm::dvec3 normal{0.0, 0.0, 1.0};
  double d = 0.0;
  static void visit(auto& a, auto& plane) { a(plane.normal, plane.d); }
};

struct Box {
  glm::dvec3 low{0.0};
  glm::dvec3 high{0.0};
};

// What a host gives: either the vertices (their hull is taken) or the planes, the other left empty.
struct VolumeInfo {
  uint32_t vehicle = 0;  // 0: world coordinates; else that vehicle's frame
  std::string name;
  std::span<const glm::dvec3> vertices;  // 3..256, not all on a line
  std::span<const Plane> planes;         // 4..64, unit normals pointing out, enclosing a finite volume
  bool active = true;
};

// A checked convex volume: its faces (outward unit normals), and what bounds it.
struct Convex {
  static constexpr size_t kMaxVertices = 256;
  static constexpr size_t kMaxPlanes = 64;

  std::vector<Plane> planes;
  Box box;
  glm::dvec3 centre{0.0};
  double radius_m = 0.0;  // of a sphere about `centre` that holds it
};

// Builds `out` from `info`. Returns an empty text, or what is wrong with it, naming the volume; then `out` is
// untouched. What is flat (a sheet thinner than 1 mm) is made thicker by 0.5 mm to either side. Refused: NaN
// or infinite numbers, too few or many, vertices on a line, planes that are not of unit length, leave the
// volume open, or enclose nothing (turned inside out). Vertices whose hull has more than 64 faces are refused
// too.
[[nodiscard]] std::string makeConvex(const VolumeInfo& info, Convex& out);

}  // namespace rg::rain
