// What the instruments before the driver show, and how that turns their needles and digits.
#pragma once

#include <vector>

#include "scene/views.h"

namespace host {

// Of a car that shifts by itself: turning over when it stands, then as the gear has it that goes with the
// speed.
double engineSpeed_rpm(double speed_mps);

// From where it points to 0, about its node's +Y. It stops at either end of its scale.
float needleAngle_rad(const NeedleMeaning& needle, double value);

// From its empty side, about its node's +Y. Whole numbers, without noughts before them.
float digitAngle_rad(const DigitMeaning& digit, double value);

// Turns all needles and digits that the car has in `poses`.
void poseInstruments(const Scene& scene, const CarView& car, double speed_mps, std::vector<Pose>& poses);

}  // namespace host
