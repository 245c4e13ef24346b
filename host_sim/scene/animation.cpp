// Where an animated node is at a time.
#include <algorithm>

#include "scene/scene.h"

namespace host {

namespace {

glm::vec4 unitOrSame(const glm::vec4& value, bool is_rotation) {
  const float length = glm::length(value);
  return is_rotation && length > 1e-12F ? value / length : value;
}

glm::vec4 slerped(const glm::vec4& a, const glm::vec4& b, float t) {
  const glm::quat from(a.w, a.x, a.y, a.z);
  const glm::quat to(b.w, b.x, b.y, b.z);
  const glm::quat q = glm::slerp(from, to, t);  // takes the short way
  return {q.x, q.y, q.z, q.w};
}

/// Cubic Hermite spline between keys k and k + 1 (glTF 2.0, appendix C.5).
glm::vec4 splined(const AnimationChannel& channel, std::size_t k, float t, float step_s) {
  const glm::vec4& from = channel.values[3 * k + 1];
  const glm::vec4& out_tangent = channel.values[3 * k + 2];
  const glm::vec4& in_tangent = channel.values[3 * k + 3];
  const glm::vec4& to = channel.values[3 * k + 4];
  const float t2 = t * t;
  const float t3 = t2 * t;
  return (2.0F * t3 - 3.0F * t2 + 1.0F) * from + step_s * (t3 - 2.0F * t2 + t) * out_tangent +
         (-2.0F * t3 + 3.0F * t2) * to + step_s * (t3 - t2) * in_tangent;
}

glm::vec4 keyed(const AnimationChannel& channel, std::size_t k) {
  return channel.values[channel.interpolation == Interpolation::CubicSpline ? 3 * k + 1 : k];
}

glm::vec4 between(const AnimationChannel& channel, std::size_t k, float time_s) {
  const float step_s = channel.times_s[k + 1] - channel.times_s[k];
  const float t = (time_s - channel.times_s[k]) / step_s;
  switch (channel.interpolation) {
    case Interpolation::Step:
      return keyed(channel, k);
    case Interpolation::CubicSpline:
      return splined(channel, k, t, step_s);
    case Interpolation::Linear:
      break;
  }
  const bool is_rotation = channel.property == AnimatedProperty::Rotation;
  return is_rotation ? slerped(channel.values[k], channel.values[k + 1], t)
                     : glm::mix(channel.values[k], channel.values[k + 1], t);
}

}  // namespace

glm::vec4 AnimationChannel::at(float time_s) const {
  const bool is_rotation = property == AnimatedProperty::Rotation;
  const auto after = std::upper_bound(times_s.begin(), times_s.end(), time_s);
  if (after == times_s.begin()) return unitOrSame(keyed(*this, 0), is_rotation);
  const auto k = static_cast<std::size_t>(after - times_s.begin()) - 1;
  const bool is_last = after == times_s.end();
  return unitOrSame(is_last ? keyed(*this, k) : between(*this, k, time_s), is_rotation);
}

void animate(const Animation& animation, float time_s, std::vector<Pose>& poses) {
  for (const AnimationChannel& channel : animation.channels) {
    Pose& pose = poses[static_cast<std::size_t>(channel.node)];
    const glm::vec4 value = channel.at(time_s);
    switch (channel.property) {
      case AnimatedProperty::Translation:
        pose.translation_m = glm::vec3(value);
        break;
      case AnimatedProperty::Rotation:
        pose.rotation = glm::quat(value.w, value.x, value.y, value.z);
        break;
      case AnimatedProperty::Scale:
        pose.scale = glm::vec3(value);
        break;
    }
  }
}

}  // namespace host
