#include "rain/motion.h"

#include <algorithm>
#include <cmath>

namespace rg::rain {

using glm::dvec3;

void WindPath::start(double time_s, const dvec3& carried_m, const dvec3& wind_mps) {
  time_s_ = time_s;
  carried_m_ = carried_m;
  wind_mps_ = wind_mps;
  pieces_.clear();
  pieces_.add({time_s, carried_m, wind_mps});
  past_.count = 0;
}

bool WindPath::advance(double time_s, const dvec3& wind_mps) {
  carried_m_ += 0.5 * (wind_mps_ + wind_mps) * (time_s - time_s_);
  wind_mps_ = wind_mps;
  time_s_ = time_s;
  const Piece& last = pieces_[0];
  const dvec3 off = carried_m_ - (last.carried_m + last.wind_mps * (time_s - last.from_s));
  if (glm::length(off) < kDeparture_m) return false;
  pieces_.add({time_s, carried_m_, wind_mps});
  straighten();
  return true;
}

// Whether the starts of the pieces between `first` and `to` lie by the chord from `to`'s start to the given
// end.
bool WindPath::isStraight(double until_s, const dvec3& until_m, uint32_t first, uint32_t to) const {
  constexpr double kMore_per_s = 4.0;  // of kDeparture_m
  const double leave_m = kDeparture_m * (1.0 + kMore_per_s * (time_s_ - until_s));
  const Piece& begin = pieces_[to];
  const dvec3 chord_mps = (until_m - begin.carried_m) / (until_s - begin.from_s);
  for (uint32_t age = first; age < to; ++age) {
    const dvec3 on_chord = begin.carried_m + chord_mps * (pieces_[age].from_s - begin.from_s);
    if (glm::distance(on_chord, pieces_[age].carried_m) > leave_m) return false;
  }
  return true;
}

// Once a piece: it looks at all that were.
void WindPath::straighten() {
  past_.count = 0;
  double until_s = time_s_;
  dvec3 until_m = carried_m_;
  for (uint32_t first = 1; first < pieces_.size() && past_.count + 1 < Past::kMost;) {
    uint32_t to = first;
    while (to + 1 < pieces_.size() && isStraight(until_s, until_m, first, to + 1)) ++to;
    const Piece& begin = pieces_[to];
    past_.stretches[past_.count++] = {begin.from_s, begin.carried_m,
                                      (until_m - begin.carried_m) / (until_s - begin.from_s)};
    until_s = begin.from_s;
    until_m = begin.carried_m;
    first = to + 1;
  }
}

void WindPath::trace(Past& past) const {
  const Piece& last = pieces_[0];
  const double span_s = time_s_ - last.from_s;
  past.count = 0;
  past.stretches[past.count++] = {last.from_s, last.carried_m,
                                  span_s > 0.0 ? (carried_m_ - last.carried_m) / span_s : last.wind_mps};
  for (uint32_t i = 0; i < past_.count; ++i) past.stretches[past.count++] = past_.stretches[i];
}

Pose movedOn(const Pose& pose, double seconds) {
  Pose moved = pose;
  moved.position_m += pose.velocity_mps * seconds;
  const double rate = glm::length(pose.angular_velocity_radps);
  if (rate > 1e-9)
    moved.orientation =
        glm::normalize(glm::angleAxis(rate * seconds, pose.angular_velocity_radps / rate) * pose.orientation);
  return moved;
}

dvec3 intoBody(const Pose& pose, const dvec3& world_m) {
  return glm::conjugate(pose.orientation) * (world_m - pose.position_m);
}

dvec3 outOfBody(const Pose& pose, const dvec3& body_m) { return pose.position_m + pose.orientation * body_m; }

void BodyPath::start(double time_s, const Pose& pose) {
  pose_ = pose;
  pieces_.clear();
  // It is taken to have come as it goes, so that its lee is dry from the start.
  pieces_.add({time_s - kBehind_s, movedOn(pose, -kBehind_s)});
  pieces_.add({time_s, pose});
}

bool BodyPath::advance(double time_s, const Pose& pose, double radius_m, bool jumped) {
  pose_ = pose;
  const Piece& last = pieces_[0];
  const Pose expected = movedOn(last.pose, time_s - last.from_s);
  const double turned =
      2.0 * std::acos(std::min(1.0, std::abs(glm::dot(expected.orientation, pose.orientation))));
  const double off = glm::distance(expected.position_m, pose.position_m) + turned * radius_m;
  if (!jumped && off < kDeparture_m && time_s - last.from_s < kRenewed_s) return false;
  pieces_.add({time_s, pose});
  return true;
}

void BodyPath::shift(const dvec3& shift_m) {
  pose_.position_m -= shift_m;
  for (uint32_t i = 0; i < pieces_.size(); ++i) pieces_[i].pose.position_m -= shift_m;
}

}  // namespace rg::rain
