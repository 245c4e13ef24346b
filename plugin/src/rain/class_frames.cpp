#include "rain/class_frames.h"

#include <algorithm>
#include <cmath>

#include "rain/standing.h"

namespace rg::rain {

using glm::dvec3;

namespace {

constexpr double kStraight_m = 1e-4;  // so far a way may leave a line: a tenth of what ends are good to

// Beside the wind's.
dvec3 ownVelocity(uint32_t kind) {
  const FallClass& c = classLattices()[kind].drops;
  return {c.drift_mps.x, c.drift_mps.y, -c.speed_mps};
}

}  // namespace

// What carries the lattice must stay a number: one NaN would stop the rain for good.
dvec3 usableWind(const Tick& tick) {
  const dvec3& wind = tick.weather.wind_mps;
  const bool usable = std::isfinite(wind.x) && std::isfinite(wind.y) && std::isfinite(wind.z);
  return usable ? glm::clamp(wind, dvec3(-kStrongestWind_mps), dvec3(kStrongestWind_mps)) : dvec3(0.0);
}

void ClassFrames::start(const dvec3& origin_m, const dvec3& wind_mps) {
  time_s_ = 0.0;
  origin_m_ = origin_m;
  moved_m_.fill(dvec3(0.0));
  wind_.start(0.0, dvec3(0.0), wind_mps);
  moveClasses();
}

void ClassFrames::jump(double time_s) {
  const dvec3 wind = wind_.wind_mps();
  const dvec3 carried = wind_.carried_m() + wind * (time_s - time_s_);
  time_s_ = time_s;
  wind_.start(time_s, carried, wind);
  moveClasses();
}

void ClassFrames::resume(const dvec3& wind_mps) {
  wind_.start(time_s_, wind_.carried_m(), wind_mps);
  moveClasses();
}

bool ClassFrames::advance(double time_s, const dvec3& wind_mps) {
  time_s_ = time_s;
  const bool turned = wind_.advance(time_s, wind_mps);
  moveClasses();
  return turned;
}

bool ClassFrames::setProfile(const WindProfile& profile) {
  if (profile.drop_share == profile_.drop_share) return false;
  for (uint32_t kind = 0; kind < kClasses; ++kind)
    moved_m_[kind] += (profile_.drop_share[kind] - profile.drop_share[kind]) * wind_.carried_m();
  profile_ = profile;
  moveClasses();
  return true;
}

void ClassFrames::shift(const dvec3& shift_m) {
  origin_m_ -= shift_m;
  moveClasses();
}

// Once, whenever anything about them is another: they are asked for drop by drop.
void ClassFrames::moveClasses() {
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    const dvec3 own = ownVelocity(kind);
    velocities_mps_[kind] = profile_.drop_share[kind] * wind_.wind_mps() + own;
    origins_m_[kind] =
        origin_m_ + moved_m_[kind] + profile_.drop_share[kind] * wind_.carried_m() + own * time_s_;
  }
  past_.count = 0;
  for (ClassPath& path : paths_) path.count = 0;
}

const ClassPath& ClassFrames::path(uint32_t kind) {
  ClassPath& path = paths_[kind];
  if (past_.count == 0) wind_.trace(past_);
  if (path.count == 0) findPath(kind, path);
  return path;
}

void ClassFrames::findPath(uint32_t kind, ClassPath& path) const {
  const double share = profile_.drop_share[kind];
  const double longest_s = Shelter::kPath_m / std::max(glm::length(velocity(kind)), 0.1);
  path.pieces[0] = {0.0, longest_s, dvec3(0.0), velocity(kind)};
  path.count = 1;
  path.falls = path.straight = true;
  double until = 0.0;
  dvec3 to_m(0.0);
  for (uint32_t i = 0; i < past_.count && until > -longest_s; ++i) {
    const WindPath::Piece& then = past_.stretches[i];
    const double begin = i + 1 == past_.count ? -longest_s : std::max(then.from_s - time_s_, -longest_s);
    const dvec3 v = share * then.wind_mps + ownVelocity(kind);
    to_m += v * (begin - until);
    path.falls = path.falls && v.z < 0.0;
    path.straight = path.straight && glm::distance(v, velocity(kind)) * longest_s < kStraight_m;
    path.pieces[path.count++] = {begin, until, to_m, v};
    until = begin;
  }
}

}  // namespace rg::rain
