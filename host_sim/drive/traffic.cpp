#include "drive/traffic.h"

#include <algorithm>
#include <cmath>

namespace host {
namespace {

constexpr double kLanesApart_m = 3.5;  // the route is the middle of the driven lane of a two-lane road

}  // namespace

CarState trafficAt(const Route& route, const TrafficCar& car, double time_s) {
  const double way_m = car.way_m + car.speed_mps * std::max(time_s, 0.0);
  const bool oncoming = car.speed_mps < 0.0;
  const glm::dvec3 along = route.direction(way_m);
  const glm::dvec3 forward = oncoming ? -along : along;
  const glm::dvec3 left = glm::normalize(glm::dvec3(-along.y, along.x, 0.0));
  CarState state;
  state.position_m = route.position(way_m) + (oncoming ? kLanesApart_m : 0.0) * left;
  state.orientation = glm::angleAxis(std::atan2(forward.y, forward.x), glm::dvec3(0.0, 0.0, 1.0)) *
                      glm::angleAxis(-std::asin(std::clamp(forward.z, -1.0, 1.0)), glm::dvec3(0.0, 1.0, 0.0));
  state.way_m = way_m;
  if (time_s <= 0.0) return state;
  state.speed_mps = std::abs(car.speed_mps);
  state.velocity_mps = car.speed_mps * along;
  state.angular_velocity_radps = {0.0, 0.0, car.speed_mps * route.curvature_per_m(way_m)};
  state.driven_m = state.speed_mps * time_s;
  return state;
}

}  // namespace host
