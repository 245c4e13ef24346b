// A value over something that grows (time, way): linear between given points, held before the first and after
// the last.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace host {

struct CurvePoint {
  double at = 0.0;
  double value = 0.0;
};

class Curve {
 public:
  Curve() = default;
  Curve(double constant) : points_{{0.0, constant}} {}  // NOLINT: a number is a curve
  // Points ascend in `at`.
  explicit Curve(std::vector<CurvePoint> points) : points_(std::move(points)) {}

  double at(double x) const {
    const auto after = std::ranges::upper_bound(points_, x, {}, &CurvePoint::at);
    if (after == points_.begin()) return points_.empty() ? 0.0 : after->value;
    const CurvePoint& a = *std::prev(after);
    if (after == points_.end()) return a.value;
    return std::lerp(a.value, after->value, (x - a.at) / (after->at - a.at));
  }
  const std::vector<CurvePoint>& points() const { return points_; }

 private:
  std::vector<CurvePoint> points_;
};

}  // namespace host
