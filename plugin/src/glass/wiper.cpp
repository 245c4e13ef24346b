#include "glass/wiper.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace rg::glass {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double wrapped(double angle_rad) { return angle_rad - kTurn * std::round(angle_rad / kTurn); }

}  // namespace

Wiper::Wiper(const WiperInfo& info, const PaneMap& map, int slot)
    : info_(info),
      slot_(slot),
      side_(glm::cross(info.axis, info.rest_direction)),
      texel_m_(map.grid().texel_m),
      texel_angles_(static_cast<size_t>(map.texelCount()), {1e9f, -1e9f}),
      segment_angles_(shared::kBladeSegments, {1e9, -1e9}) {
  struct Entry {
    double angle;
    shared::SweptTexel swept;
  };
  std::vector<Entry> entries;
  for (int i = 0; i < map.texelCount(); ++i) {
    if (!map.inside(i)) continue;
    // A drop in the texel may be met though its middle is not.
    const Crossings around = crossings(glm::dvec3(map.texel(i).position_m), texel_m_);
    for (int k = 0; k < around.count; ++k) {
      auto& [least, most] = texel_angles_[static_cast<size_t>(i)];
      least = std::min(least, static_cast<float>(around.angle_rad[k]));
      most = std::max(most, static_cast<float>(around.angle_rad[k]));
    }
    const Crossings c = crossingsAt(glm::dvec3(map.texel(i).position_m));
    for (int k = 0; k < c.count; ++k) {
      const double angle = c.angle_rad[k];
      entries.push_back({angle, {i, slot * shared::kBladeSegments + c.segment[k]}});
      auto& [low, high] = segment_angles_[static_cast<size_t>(c.segment[k])];
      low = std::min(low, angle);
      high = std::max(high, angle);
    }
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.angle != b.angle ? a.angle < b.angle : a.swept.texel < b.swept.texel;
  });
  auto swept = std::make_shared<std::vector<shared::SweptTexel>>();
  for (const Entry& entry : entries) {
    swept->push_back(entry.swept);
    angles_.push_back(entry.angle);
  }
  swept_ = std::move(swept);
}

// The blade's points at angle t are P(s) = a e(t) + s e(t + b), |s| <= L/2, so |P|^2 = a^2 + 2 a s cos b +
// s^2: a place at distance r is met where s = -a cos b +- sqrt(r^2 - a^2 sin^2 b), at the angle its own
// direction has more than the point's at t = 0.
Crossings Wiper::crossingsAt(const glm::dvec3& vehicle_m) const { return crossings(vehicle_m, 0.0); }

Crossings Wiper::crossings(const glm::dvec3& vehicle_m, double beyond_end_m) const {
  const glm::dvec3 d = vehicle_m - info_.pivot_m;
  const double x = glm::dot(d, info_.rest_direction), y = glm::dot(d, side_);
  const double cos_b = std::cos(info_.blade_angle_rad), sin_b = std::sin(info_.blade_angle_rad);
  const double under = x * x + y * y - info_.arm_m * info_.arm_m * sin_b * sin_b;
  Crossings out;
  if (under < 0.0) return out;
  const double root = std::sqrt(under);
  for (const double sign : {1.0, -1.0}) {
    const double s = -info_.arm_m * cos_b + sign * root;
    if (std::abs(s) > 0.5 * info_.blade_m + beyond_end_m || (sign < 0.0 && root == 0.0)) continue;
    out.angle_rad[out.count] = wrapped(std::atan2(y, x) - std::atan2(s * sin_b, info_.arm_m + s * cos_b));
    const double along = (s / info_.blade_m + 0.5) * shared::kBladeSegments;
    out.segment[out.count] = std::clamp(static_cast<int>(along), 0, shared::kBladeSegments - 1);
    ++out.count;
  }
  return out;
}

std::pair<int, int> Wiper::range(const Sweep& sweep) const {
  const auto index = [this](auto it) { return static_cast<int>(it - angles_.begin()); };
  if (sweep.now_rad > sweep.before_rad) {
    return {index(std::upper_bound(angles_.begin(), angles_.end(), sweep.before_rad)),
            index(std::upper_bound(angles_.begin(), angles_.end(), sweep.now_rad))};
  }
  return {index(std::lower_bound(angles_.begin(), angles_.end(), sweep.now_rad)),
          index(std::lower_bound(angles_.begin(), angles_.end(), sweep.before_rad))};
}

bool Wiper::mayCross(int texel, const Sweep& sweep) const {
  const auto [least, most] = texel_angles_[static_cast<size_t>(texel)];
  // A texel is 3 mm and the nearest blade 0.05 m from its pivot: inside it angles differ by less than 0.1
  // rad.
  constexpr float kInTexel_rad = 0.1f;
  const auto low = static_cast<float>(std::min(sweep.before_rad, sweep.now_rad)) - kInTexel_rad;
  const auto high = static_cast<float>(std::max(sweep.before_rad, sweep.now_rad)) + kInTexel_rad;
  return least <= high && most >= low;
}

std::vector<std::vector<int>> Wiper::aheadOf(double extreme_rad, double direction) const {
  constexpr size_t kEnough = 8;                          // texels for a piece's water
  const double near_rad = 2.5 * texel_m_ / info_.arm_m;  // a ridge is some millimetres wide
  std::vector<std::vector<int>> out(shared::kBladeSegments);
  const auto [first, last] = range({extreme_rad, extreme_rad + direction * 4.0 * near_rad});
  for (int n = 0; n < last - first; ++n) {
    const int i = direction > 0.0 ? first + n : last - 1 - n;
    const shared::SweptTexel& entry = (*swept_)[static_cast<size_t>(i)];
    std::vector<int>& list = out[static_cast<size_t>(entry.segment - slot_ * shared::kBladeSegments)];
    const bool near = std::abs(angles_[static_cast<size_t>(i)] - extreme_rad) <= near_rad;
    if (list.size() < kEnough && (near || list.empty())) list.push_back(entry.texel);
  }
  return out;
}

bool Wiper::offGlass(int segment, double angle_rad) const {
  const auto [low, high] = segment_angles_[static_cast<size_t>(segment)];
  const double margin = 1.5 * texel_m_ / info_.arm_m;
  return angle_rad < low - margin || angle_rad > high + margin;
}

}  // namespace rg::glass
