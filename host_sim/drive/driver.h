// Who drives: a scenario's driver on the route, or a person at the keys. Advances by the host's fixed ticks.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "drive/curve.h"
#include "drive/route.h"

namespace host {

// Where the car is and how it moves. World frame; origin on the ground under the rear axle.
struct CarState {
  glm::dvec3 position_m{0.0};
  glm::dquat orientation{1.0, 0.0, 0.0, 0.0};  // worldFromVehicle
  glm::dvec3 velocity_mps{0.0};
  glm::dvec3 angular_velocity_radps{0.0};
  double speed_mps = 0.0;
  double acceleration_mps2 = 0.0;  // along the way
  double steering_rad = 0.0;       // of the road wheels, positive to the left
  double way_m = 0.0;              // along the route
  double driven_m = 0.0;
};

struct Stop {
  double at_m = 0.0;
  double seconds = 0.0;
};

struct DrivePlan {
  double start_m = 0.0;
  Curve speed_mps{0.0};  // over the way: what the driver wants, bends permitting
  std::vector<Stop> stops;
};

// What a person at the wheel does. Each -1 .. 1.
struct Controls {
  double throttle = 0.0;
  double brake = 0.0;
  double steer = 0.0;  // positive to the left
};

class Driver {
 public:
  Driver(const Route& route, const DrivePlan& plan);

  void tick();                          // as the plan says
  void tick(const Controls& controls);  // as a person says
  // The same inputs from now on, wherever the car is: hands the wheel over.
  void takeOver() { by_hand_ = true; }
  void giveBack();
  bool byHand() const { return by_hand_; }

  const CarState& state() const { return state_; }
  // The car `seconds` after the last tick, for pictures between ticks.
  CarState at(double seconds) const;

  // What a saved run holds of it; see saved_fields.h.
  template <class Fields>
  void visit(Fields& f) {
    f("next_stop", next_stop_, 0, plan_.stops.size());
    f("waiting_s", waiting_s_), f("heading_rad", heading_rad_), f("pitch_rad", pitch_rad_);
    f("roll_rad", roll_rad_), f("by_hand", by_hand_);
    f("position_m", state_.position_m), f("orientation", state_.orientation);
    f("velocity_mps", state_.velocity_mps), f("angular_velocity_radps", state_.angular_velocity_radps);
    f("speed_mps", state_.speed_mps), f("acceleration_mps2", state_.acceleration_mps2);
    f("steering_rad", state_.steering_rad), f("way_m", state_.way_m), f("driven_m", state_.driven_m);
  }

 private:
  double wantedSpeed(double way_m) const;
  void planSpeeds();
  void settle(const CarState& before);

  const Route& route_;
  DrivePlan plan_;
  std::vector<double> limits_mps_;  // by metre of way: bends, braking for what comes, stops
  size_t next_stop_ = 0;
  double waiting_s_ = 0.0;
  double heading_rad_ = 0.0;
  double pitch_rad_ = 0.0, roll_rad_ = 0.0;  // of the body on its springs
  bool by_hand_ = false;
  CarState state_;
};

}  // namespace host
