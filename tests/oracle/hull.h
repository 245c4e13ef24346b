// The oracle's own idea of a convex volume: made straight from its points by trying every plane through three
// of them, and asked by geometry alone. It shares nothing with the plugin's hull, tree, birth test or clip.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <vector>

namespace oracle {

struct Face {
  glm::dvec3 outward;
  double d = 0.0;
};

class Hull {
 public:
  explicit Hull(const std::vector<glm::vec3>& points) {
    std::vector<glm::dvec3> p;
    for (const glm::vec3& q : points) {
      if (std::ranges::find(p, glm::dvec3(q)) == p.end()) p.emplace_back(q);
    }
    for (const glm::dvec3& q : p) centre_ += q / static_cast<double>(p.size());
    for (const glm::dvec3& q : p) radius_m_ = std::max(radius_m_, glm::distance(q, centre_));
    for (size_t a = 0; a < p.size(); ++a) {
      for (size_t b = a + 1; b < p.size(); ++b) {
        for (size_t c = b + 1; c < p.size(); ++c) addIfAFace(p, p[a], p[b], p[c]);
      }
    }
  }

  const std::vector<Face>& faces() const { return faces_; }

  // How deep a point lies inside: its distance from the nearest face; negative outside.
  double depth(const glm::dvec3& p) const {
    double least = 1e30;
    for (const Face& f : faces_) least = std::min(least, f.d - glm::dot(f.outward, p));
    return least;
  }

  // How deep the deepest point of a segment lies inside; negative when it stays outside: how far at least.
  // Depth is concave along the segment, so that thirds close in on its greatest (to a micrometre of a metre's
  // length in 34 steps).
  double depth(const glm::dvec3& a, const glm::dvec3& b) const {
    const glm::dvec3 way = b - a;
    const double length2 = glm::dot(way, way);
    const double nearest = length2 > 0.0 ? std::clamp(glm::dot(centre_ - a, way) / length2, 0.0, 1.0) : 0.0;
    const double beyond_m = glm::distance(a + way * nearest, centre_) - radius_m_;
    if (beyond_m > 0.0) return -beyond_m;
    double apart_m = 0.0;
    for (const Face& f : faces_)
      apart_m = std::max(apart_m, std::min(glm::dot(f.outward, a), glm::dot(f.outward, b)) - f.d);
    if (apart_m > 0.0) return -apart_m;
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 34; ++i) {
      const double third = (high - low) / 3.0;
      if (depth(a + way * (low + third)) < depth(a + way * (high - third)))
        low += third;
      else
        high -= third;
    }
    return depth(a + way * (0.5 * (low + high)));
  }

 private:
  void addIfAFace(const std::vector<glm::dvec3>& p, const glm::dvec3& a, const glm::dvec3& b,
                  const glm::dvec3& c) {
    constexpr double kSliver_m2 = 1e-6,
                     kRounding_m = 2e-5;  // points come as floats: 6e-5 m apart a kilometre out
    glm::dvec3 normal = glm::cross(b - a, c - a);
    const double twice_area_m2 = glm::length(normal);
    if (twice_area_m2 < kSliver_m2) return;
    normal /= twice_area_m2;
    if (glm::dot(normal, centre_ - a) > 0.0) normal = -normal;
    double d = glm::dot(normal, a);
    for (const glm::dvec3& q : p) {
      if (glm::dot(normal, q) > d + kRounding_m) return;
    }
    for (const glm::dvec3& q : p) d = std::max(d, glm::dot(normal, q));
    const bool known =
        std::ranges::any_of(faces_, [&](const Face& f) { return glm::distance(f.outward, normal) < 1e-7; });
    if (!known) faces_.push_back({normal, d});
  }

  std::vector<Face> faces_;
  glm::dvec3 centre_{0.0};
  double radius_m_ = 0.0;
};

}  // namespace oracle
