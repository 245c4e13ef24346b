// Other cars on the route: each at its own even speed, ahead of us in our lane or towards us in the other
// one.
#pragma once

#include <vector>

#include "drive/driver.h"
#include "drive/route.h"

namespace host {

struct TrafficCar {
  double way_m = 0.0;      // along the route, at the first picture
  double speed_mps = 0.0;  // along the route; negative: towards us, in the other lane
};

// Where a car is so many seconds after the first picture; before it stands there. No driving: the way is told
// by the time alone, so that any picture can be asked for.
CarState trafficAt(const Route& route, const TrafficCar& car, double time_s);

}  // namespace host
