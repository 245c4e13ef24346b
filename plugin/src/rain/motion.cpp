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
}

bool WindPath::advance(double time_s, const dvec3& wind_mps) {
  carried_m_ += 0.5 * (wind_mps_ + wind_mps) * (time_s - time_s_);
  wind_mps_ = wind_mps;
  time_s_ = time_s;
  const Piece& last = pieces_[0];
  const dvec3 off = carried_m_ - (last.carried_m + last.wind_mps * (time_s - last.from_s));
  if (glm::length(off) < kDeparture_m) return false;
  pieces_.add({time_s, carried_m_, wind_mps});
  return true;
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
