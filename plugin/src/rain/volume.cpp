#include "rain/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kThinnest_m = 1e-3;  // flatter bodies are called flat
constexpr double kSheet_m = 0.5e-3;   // and made so much thicker to either side
constexpr double kUnitTolerance = 1e-3;
constexpr double kLargest_m = 1e7;  // coordinates beyond are a mistake

bool finite(const dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && glm::length(v) < kLargest_m;
}

std::string complain(const VolumeInfo& info, const std::string& what) {
  return "volume '" + (info.name.empty() ? std::string("(no name)") : info.name) + "': " + what;
}

struct Face {
  uint32_t a, b, c;
  Plane plane;
};

Plane planeThrough(const dvec3& a, const dvec3& b, const dvec3& c) {
  const dvec3 normal = glm::normalize(glm::cross(b - a, c - a));
  return {normal, glm::dot(normal, a)};
}

// Four corners of a tetrahedron among the points, and how many dimensions it has: below three where the next
// corner would lie within kThinnest_m of the others' point, line or plane.
int spread(std::span<const dvec3> p, std::array<uint32_t, 4>& corner) {
  const auto farthest = [&](auto&& distance) {
    uint32_t best = 0;
    for (uint32_t i = 1; i < p.size(); ++i) {
      if (distance(p[i]) > distance(p[best])) best = i;
    }
    return best;
  };
  if (p.empty()) return 0;
  corner[0] = farthest([&](const dvec3& q) { return -q.x; });
  corner[1] = farthest([&](const dvec3& q) { return glm::distance(q, p[corner[0]]); });
  const dvec3 along = p[corner[1]] - p[corner[0]];
  if (glm::length(along) < kThinnest_m) return 0;
  corner[2] = farthest([&](const dvec3& q) { return glm::length(glm::cross(along, q - p[corner[0]])); });
  if (glm::length(glm::cross(along, p[corner[2]] - p[corner[0]])) < kThinnest_m * glm::length(along))
    return 1;
  const Plane base = planeThrough(p[corner[0]], p[corner[1]], p[corner[2]]);
  corner[3] = farthest([&](const dvec3& q) { return std::abs(glm::dot(base.normal, q) - base.d); });
  return std::abs(glm::dot(base.normal, p[corner[3]]) - base.d) >= kThinnest_m ? 3 : 2;
}

// Adds one point to the hull: the faces that see it go, their rim is joined to it.
void addToHull(std::span<const dvec3> p, uint32_t point, double tolerance, std::vector<Face>& faces) {
  std::vector<std::pair<uint32_t, uint32_t>> rim;
  std::vector<Face> kept;
  for (const Face& face : faces) {
    if (glm::dot(face.plane.normal, p[point]) - face.plane.d <= tolerance) {
      kept.push_back(face);
      continue;
    }
    for (const auto& edge :
         {std::pair{face.a, face.b}, std::pair{face.b, face.c}, std::pair{face.c, face.a}}) {
      const auto twin = std::find(rim.begin(), rim.end(), std::pair{edge.second, edge.first});
      if (twin != rim.end())
        rim.erase(twin);
      else
        rim.push_back(edge);
    }
  }
  for (const auto& [a, b] : rim) {
    // A sliver has no direction of its own; its neighbours bound the hull there.
    if (glm::length(glm::cross(p[b] - p[a], p[point] - p[a])) < 1e-12) continue;
    kept.push_back({a, b, point, planeThrough(p[a], p[b], p[point])});
  }
  faces = std::move(kept);
}

// The hull's planes, with those that differ by rounding only taken as one, each moved out until it holds all
// points.
std::vector<Plane> planesOf(std::span<const dvec3> p, const std::vector<Face>& faces) {
  std::vector<Plane> planes;
  for (const Face& face : faces) {
    const bool known = std::any_of(planes.begin(), planes.end(), [&](const Plane& q) {
      return glm::dot(q.normal, face.plane.normal) > 1.0 - 1e-9;
    });
    if (!known) planes.push_back(face.plane);
  }
  for (Plane& plane : planes) {
    for (const dvec3& q : p) plane.d = std::max(plane.d, glm::dot(plane.normal, q));
  }
  return planes;
}

// A sheet's points, moved to either side.
std::vector<dvec3> thickened(std::span<const dvec3> p, const std::array<uint32_t, 4>& corner) {
  const dvec3 up = planeThrough(p[corner[0]], p[corner[1]], p[corner[2]]).normal * kSheet_m;
  std::vector<dvec3> both;
  for (const dvec3& q : p) {
    both.push_back(q + up);
    both.push_back(q - up);
  }
  return both;
}

std::string hull(const VolumeInfo& info, std::vector<dvec3>& p, std::vector<Plane>& planes) {
  std::array<uint32_t, 4> t{};
  const int dimensions = spread(p, t);
  if (dimensions < 2) return complain(info, "its vertices lie on a line (within 1 mm)");
  if (dimensions == 2) {
    p = thickened(p, t);
    spread(p, t);
  }
  std::vector<Face> faces;
  const dvec3 middle = 0.25 * (p[t[0]] + p[t[1]] + p[t[2]] + p[t[3]]);
  const auto addFace = [&](uint32_t a, uint32_t b, uint32_t c) {
    const Plane plane = planeThrough(p[a], p[b], p[c]);
    if (glm::dot(plane.normal, middle) < plane.d)
      faces.push_back({a, b, c, plane});
    else
      faces.push_back({a, c, b, planeThrough(p[a], p[c], p[b])});
  };
  addFace(t[0], t[1], t[2]);
  addFace(t[0], t[1], t[3]);
  addFace(t[0], t[2], t[3]);
  addFace(t[1], t[2], t[3]);
  double size = 0.0;
  for (const dvec3& q : p) size = std::max(size, glm::distance(q, middle));
  for (uint32_t i = 0; i < p.size(); ++i) addToHull(p, i, 1e-9 * size, faces);
  planes = planesOf(p, faces);
  if (planes.size() > Convex::kMaxPlanes) {
    return complain(info, "its hull has " + std::to_string(planes.size()) + " faces, more than 64");
  }
  return {};
}

bool holds(std::span<const Plane> planes, const dvec3& p, double tolerance) {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const Plane& q) { return glm::dot(q.normal, p) <= q.d + tolerance; });
}

// Corners where three planes meet and all others agree.
std::vector<dvec3> cornersOf(std::span<const Plane> planes) {
  std::vector<dvec3> corners;
  for (size_t i = 0; i < planes.size(); ++i) {
    for (size_t j = i + 1; j < planes.size(); ++j) {
      const dvec3 line = glm::cross(planes[i].normal, planes[j].normal);
      for (size_t k = j + 1; k < planes.size(); ++k) {
        const double det = glm::dot(line, planes[k].normal);
        if (std::abs(det) < 1e-9) continue;
        const dvec3 corner =
            (planes[i].d * glm::cross(planes[j].normal, planes[k].normal) +
             planes[j].d * glm::cross(planes[k].normal, planes[i].normal) + planes[k].d * line) /
            det;
        if (finite(corner) && holds(planes, corner, 1e-6)) corners.push_back(corner);
      }
    }
  }
  return corners;
}

// Whether a ray exists along which no plane is ever met: then the volume is open. An edge of that cone, if
// there is one, lies in two planes.
bool isOpen(std::span<const Plane> planes) {
  bool spans_space = false;
  for (size_t i = 0; i < planes.size(); ++i) {
    for (size_t j = i + 1; j < planes.size(); ++j) {
      const dvec3 line = glm::cross(planes[i].normal, planes[j].normal);
      if (glm::length(line) < 1e-9) continue;
      for (const dvec3& ray : {glm::normalize(line), -glm::normalize(line)}) {
        bool free = true;
        for (const Plane& plane : planes) {
          free = free && glm::dot(plane.normal, ray) <= 1e-9;
          spans_space = spans_space || std::abs(glm::dot(plane.normal, ray)) > 1e-6;
        }
        if (free) return true;
      }
    }
  }
  return !spans_space;
}

std::string checkPlanes(const VolumeInfo& info, std::vector<Plane>& planes) {
  for (size_t i = 0; i < info.planes.size(); ++i) {
    Plane plane = info.planes[i];
    const std::string which = "plane " + std::to_string(i);
    if (!finite(plane.normal) || !std::isfinite(plane.d) || std::abs(plane.d) > kLargest_m) {
      return complain(info, which + " is not a finite number");
    }
    const double length = glm::length(plane.normal);
    if (std::abs(length - 1.0) > kUnitTolerance)
      return complain(info, "the normal of " + which + " is not of unit length");
    plane.normal /= length;
    plane.d /= length;
    planes.push_back(plane);
  }
  return {};
}

std::string boundPlanes(const VolumeInfo& info, std::vector<Plane>& planes, std::vector<dvec3>& corners) {
  corners = cornersOf(planes);
  std::array<uint32_t, 4> tetrahedron{};
  if (isOpen(planes)) return complain(info, "its planes do not enclose a finite volume");
  const int dimensions = spread(corners, tetrahedron);
  if (dimensions == 3) return {};
  std::vector<Plane> turned(planes.begin(), planes.end());
  for (Plane& plane : turned) plane = {-plane.normal, -plane.d};
  if (spread(cornersOf(turned), tetrahedron) == 3)
    return complain(info, "its planes are turned inside out (normals must point out)");
  if (dimensions < 2) return complain(info, "its planes enclose nothing");
  for (Plane& plane : planes) plane.d += kSheet_m;
  corners = cornersOf(planes);
  return {};
}

void bound(std::span<const dvec3> points, Convex& convex) {
  convex.box = {points[0], points[0]};
  for (const dvec3& p : points) {
    convex.box.low = glm::min(convex.box.low, p);
    convex.box.high = glm::max(convex.box.high, p);
  }
  convex.centre = 0.5 * (convex.box.low + convex.box.high);
  convex.radius_m = 0.0;
  for (const dvec3& p : points) convex.radius_m = std::max(convex.radius_m, glm::distance(convex.centre, p));
}

}  // namespace

std::string makeConvex(const VolumeInfo& info, Convex& out) {
  Convex made;
  std::vector<dvec3> points(info.vertices.begin(), info.vertices.end());
  if (info.vertices.empty() == info.planes.empty()) return complain(info, "give either vertices or planes");
  if (!info.vertices.empty()) {
    if (points.size() < 3 || points.size() > Convex::kMaxVertices) {
      return complain(info, "has " + std::to_string(points.size()) + " vertices, not 3 to 256");
    }
    for (size_t i = 0; i < points.size(); ++i) {
      if (!finite(points[i]))
        return complain(info, "vertex " + std::to_string(i) + " is not a finite number");
    }
    if (auto wrong = hull(info, points, made.planes); !wrong.empty()) return wrong;
  } else {
    if (info.planes.size() < 4 || info.planes.size() > Convex::kMaxPlanes) {
      return complain(info, "has " + std::to_string(info.planes.size()) + " planes, not 4 to 64");
    }
    if (auto wrong = checkPlanes(info, made.planes); !wrong.empty()) return wrong;
    if (auto wrong = boundPlanes(info, made.planes, points); !wrong.empty()) return wrong;
  }
  bound(points, made);
  out = std::move(made);
  return {};
}

}  // namespace rg::rain
