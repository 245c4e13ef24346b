// A city of shelters, and an oracle for it that shares nothing with the plugin: hulls by brute force, and a
// drop's way cut with each of them in turn by geometry alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "oracle/hull.h"
#include "scene.h"

namespace rg::rain::test {

// Told from the oracle by rounding alone: 20 um of the floats that its hulls are made of; and half a
// millimetre by which a turning body's chords leave the bent way. Where a way comes in at more than 6 deg to
// the face, the former is less than 1 mm of it.
constexpr double kRounding_m = 5e-5, kTurning_m = 0.6e-3;

// A body that goes its way steadily: where it is at time t.
struct Course {
  dvec3 from_m{0.0}, velocity_mps{0.0};
  double heading_rad = 0.0, turn_radps = 0.0;
  dvec3 at(double t) const { return from_m + velocity_mps * t; }
  // From the body's frame to the world's, without a quaternion.
  dvec3 outOf(const dvec3& p, double t) const {
    const double a = heading_rad + turn_radps * t, c = std::cos(a), s = std::sin(a);
    return at(t) + dvec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
  }
  dvec3 into(const dvec3& world, double t) const {
    const double a = heading_rad + turn_radps * t, c = std::cos(a), s = std::sin(a);
    const dvec3 p = world - at(t);
    return {c * p.x + s * p.y, -s * p.x + c * p.y, p.z};
  }
  Pose pose(double t) const {
    Pose pose;
    pose.position_m = at(t);
    pose.orientation = glm::angleAxis(heading_rad + turn_radps * t, dvec3(0, 0, 1));
    pose.velocity_mps = velocity_mps;
    pose.angular_velocity_radps = {0, 0, turn_radps};
    return pose;
  }
};

// A convex volume, about a place of its own.
struct Building {
  std::vector<dvec3> points;  // as the field is told them: the world's, or its vehicle's frame
  oracle::Hull hull;          // relative to `at_m`
  dvec3 at_m{0.0};
  double radius_m = 0.0;
  uint32_t vehicle = 0;
  // Shapes are rounded to floats, which is what the oracle's hulls are made of.
  Building(const std::vector<glm::vec3>& shape, const dvec3& at, uint32_t on)
      : hull(shape), at_m(at), vehicle(on) {
    for (const glm::vec3& p : shape) {
      points.push_back(dvec3(p) + at);
      radius_m = std::max(radius_m, glm::length(dvec3(p)));
    }
  }
  std::string tell(Field& field, uint32_t id) const {
    VolumeInfo info;
    info.name = "building";
    info.vehicle = vehicle;
    info.vertices = points;
    return field.setVolume(id, info);
  }
};

// Random shapes: boxes turned about the vertical, prisms, wedges, clouds of points, thin slabs.
inline std::vector<glm::vec3> randomShape(std::mt19937_64& random, double size_m) {
  const auto draw = [&](double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
  };
  std::vector<glm::vec3> points;
  const double turned = draw(0, 6.28), c = std::cos(turned), s = std::sin(turned);
  const auto add = [&](double x, double y, double z) {
    points.emplace_back(c * x - s * y, s * x + c * y, z);
  };
  const double a = draw(0.2, 1.0) * size_m, b = draw(0.2, 1.0) * size_m, h = draw(0.1, 0.8) * size_m;
  switch (std::uniform_int_distribution<int>(0, 4)(random)) {
    case 0:  // a box
      for (int i = 0; i < 8; ++i) add(i & 1 ? a : -a, i & 2 ? b : -b, i & 4 ? h : -h);
      break;
    case 1:  // a column of six sides
      for (int i = 0; i < 6; ++i) {
        add(a * std::cos(i * 1.0472), a * std::sin(i * 1.0472), -h);
        add(a * std::cos(i * 1.0472), a * std::sin(i * 1.0472), h);
      }
      break;
    case 2:  // a roof that leans
      for (int i = 0; i < 8; ++i)
        add(i & 1 ? a : -a, i & 2 ? b : -b, (i & 4 ? 0.05 : 0.0) + (i & 1 ? h : 0.0));
      break;
    case 3:  // anything
      for (int i = 0; i < 9; ++i) add(draw(-a, a), draw(-b, b), draw(-h, h));
      break;
    default:  // a slab of 5 mm
      for (int i = 0; i < 8; ++i) add(i & 1 ? a : -a, i & 2 ? b : -b, i & 4 ? 2.5e-3 : -2.5e-3);
  }
  return points;
}

// The times of [from, to] at which a point that is at p + v t is in the hull moved out by `more_m`.
inline std::optional<std::pair<double, double>> timesIn(const oracle::Hull& hull, const dvec3& p,
                                                        const dvec3& v, double from, double to,
                                                        double more_m) {
  for (const oracle::Face& f : hull.faces()) {
    const double begin = glm::dot(f.outward, p + v * from) - f.d - more_m,
                 end = glm::dot(f.outward, p + v * to) - f.d - more_m;
    if (begin > 0.0 && end > 0.0) return std::nullopt;
    if (begin <= 0.0 && end <= 0.0) continue;
    const double crossing = from + (to - from) * (begin / (begin - end));
    (begin > 0.0 ? from : to) = crossing;
  }
  return std::pair{from, to};
}

// A straight part of a drop's way: at p + v t for the times [from, to].
struct Stretch {
  dvec3 p, v;
  double from = 0.0, to = 0.0;
};

// The part of [from, to] at which p + v t is within a sphere about the origin.
inline std::optional<std::pair<double, double>> timesInSphere(const Stretch& s, double radius_m) {
  const double a = glm::dot(s.v, s.v), b = glm::dot(s.p, s.v), c = glm::dot(s.p, s.p) - radius_m * radius_m,
               under = b * b - a * c;
  if (under < 0.0) return std::nullopt;
  const double from = std::max(s.from, (-b - std::sqrt(under)) / a),
               to = std::min(s.to, (-b + std::sqrt(under)) / a);
  if (from > to) return std::nullopt;
  return std::pair{from, to};
}

// The first time at which the stretch is in the building moved out by `more_m`; infinity when it is not. A
// body's way is cut into milliseconds, in which it bends by less than 10 um.
inline double firstEntry(const Building& b, const Course& course, const Stretch& s, double more_m) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  if (b.vehicle == 0) {
    const Stretch near{s.p - b.at_m, s.v, s.from, s.to};
    if (!timesInSphere(near, b.radius_m + 0.01)) return kNever;
    const auto times = timesIn(b.hull, near.p, near.v, near.from, near.to, more_m);
    return times ? times->first : kNever;
  }
  constexpr double kStep_s = 1e-3;
  const Stretch past{s.p - course.from_m, s.v - course.velocity_mps, s.from, s.to};
  const auto near = timesInSphere(past, b.radius_m + glm::length(b.at_m) + 0.01);
  if (!near) return kNever;
  for (double t = near->first; t < near->second; t += kStep_s) {
    const double end = std::min(t + kStep_s, near->second);
    const dvec3 from = course.into(s.p + s.v * t, t) - b.at_m,
                to = course.into(s.p + s.v * end, end) - b.at_m, v = (to - from) / (end - t);
    if (const auto times = timesIn(b.hull, from - v * t, v, t, end, more_m)) return times->first;
  }
  return kNever;
}

}  // namespace rg::rain::test
