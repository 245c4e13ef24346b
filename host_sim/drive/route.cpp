#include "drive/route.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace host {
namespace {

constexpr double kStep_m = 0.5;
constexpr double kBend_m = 6.0;  // half the length over which curvature is averaged: about 0.5 s at 90 km/h

// Barry & Goldman 1988: centripetal Catmull-Rom between b and c.
glm::dvec3 catmullRom(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d,
                      double s) {
  const double ta = 0.0, tb = ta + std::sqrt(glm::distance(a, b)), tc = tb + std::sqrt(glm::distance(b, c)),
               td = tc + std::sqrt(glm::distance(c, d));
  const double t = std::lerp(tb, tc, s);
  const auto blend = [t](const glm::dvec3& p, const glm::dvec3& q, double tp, double tq) {
    return glm::mix(p, q, (t - tp) / (tq - tp));
  };
  const glm::dvec3 ab = blend(a, b, ta, tb), bc = blend(b, c, tb, tc), cd = blend(c, d, tc, td);
  const glm::dvec3 abc = blend(ab, bc, ta, tc), bcd = blend(bc, cd, tb, td);
  return blend(abc, bcd, tb, tc);
}

std::vector<glm::dvec3> smoothLine(const std::vector<glm::dvec3>& p, bool closed) {
  const auto n = static_cast<long>(p.size());
  const auto at = [&](long i) -> glm::dvec3 {
    if (closed) return p[static_cast<size_t>((i % n + n) % n)];
    if (i < 0) return 2.0 * p[0] - p[1];
    if (i >= n) return 2.0 * p[static_cast<size_t>(n - 1)] - p[static_cast<size_t>(n - 2)];
    return p[static_cast<size_t>(i)];
  };
  std::vector<glm::dvec3> line;
  for (long i = 0; i < (closed ? n : n - 1); ++i) {
    const int pieces =
        std::max(2, static_cast<int>(std::ceil(glm::distance(at(i), at(i + 1)) / (kStep_m / 2))));
    for (int k = 0; k < pieces; ++k)
      line.push_back(catmullRom(at(i - 1), at(i), at(i + 1), at(i + 2), static_cast<double>(k) / pieces));
  }
  line.push_back(closed ? p.front() : p.back());
  return line;
}

// The line cut into pieces of equal length.
std::vector<glm::dvec3> evenly(const std::vector<glm::dvec3>& line) {
  std::vector<glm::dvec3> table{line.front()};
  double left_m = kStep_m;
  for (size_t i = 1; i < line.size(); ++i) {
    glm::dvec3 from = line[i - 1];
    double piece_m = glm::distance(from, line[i]);
    while (piece_m >= left_m) {
      from += (line[i] - from) * (left_m / piece_m);
      table.push_back(from);
      piece_m -= left_m;
      left_m = kStep_m;
    }
    left_m -= piece_m;
  }
  return table;
}

}  // namespace

Route::Route(const std::vector<glm::dvec3>& points_m, bool closed) : closed_(closed) {
  if (points_m.size() < 2) throw std::invalid_argument("a route needs two points");
  for (size_t i = 1; i < points_m.size(); ++i) {
    if (glm::distance(points_m[i - 1], points_m[i]) < 1e-3)
      throw std::invalid_argument("a route has two points in the same place");
  }
  table_ = evenly(smoothLine(points_m, closed));
  if (table_.size() < 3) throw std::invalid_argument("a route is shorter than a metre");
}

double Route::length_m() const { return static_cast<double>(table_.size() - 1) * kStep_m; }

double Route::wrapped(double way_m) const {
  if (!closed_) return way_m;
  const double rest = std::fmod(way_m, length_m());
  return rest < 0.0 ? rest + length_m() : rest;
}

glm::dvec3 Route::sample(double way_m) const {
  const double x = way_m / kStep_m;
  const double last = static_cast<double>(table_.size() - 1);
  const auto i = static_cast<size_t>(std::clamp(std::floor(x), 0.0, last - 1.0));
  return table_[i] + (table_[i + 1] - table_[i]) * (x - static_cast<double>(i));
}

glm::dvec3 Route::position(double way_m) const {
  // A quadratic B-spline over the table: the direction has no jumps that a passenger would see.
  const double w = wrapped(way_m);
  return (sample(w - kStep_m) + 2.0 * sample(w) + sample(w + kStep_m)) * 0.25;
}

glm::dvec3 Route::direction(double way_m) const {
  const double w = wrapped(way_m);
  return glm::normalize(position(w + 1.5) - position(w - 1.5));
}

double Route::curvature_per_m(double way_m) const {
  const glm::dvec3 a = direction(way_m - kBend_m), b = direction(way_m + kBend_m);
  return std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y) / (2.0 * kBend_m);
}

double Route::nearestWay(const glm::dvec3& position_m, double near_m) const {
  const double window_m = near_m < 0.0 ? length_m() : 30.0;
  const double start = near_m < 0.0 ? 0.0 : near_m - window_m;
  double best_m = start, best = std::numeric_limits<double>::max();
  for (int i = 0; i <= static_cast<int>(2.0 * window_m / kStep_m); ++i) {
    const double w = start + i * kStep_m;
    const glm::dvec3 d = position(w) - position_m;
    if (glm::dot(d, d) < best) {
      best = glm::dot(d, d);
      best_m = w;
    }
  }
  return wrapped(best_m);
}

}  // namespace host
