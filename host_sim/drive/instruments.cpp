#include "drive/instruments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace host {
namespace {

// All unsourced: as a small family car with six gears has them.
constexpr std::array<double, 6> kGears_kmh = {8.0, 14.5, 22.0, 30.0, 38.5, 47.0};  // at 1000 rpm
constexpr double kIdle_rpm = 800.0;
constexpr double kShiftTo_rpm = 1500.0;  // where a gear would turn the engine so fast, it is taken
constexpr double kShift_kmh = 2.0;       // what is gained while it is, in a third of a second

double valueOf(Reading reading, double speed_mps) {
  return reading == Reading::Speed_kmh ? 3.6 * speed_mps : engineSpeed_rpm(speed_mps);
}

}  // namespace

double engineSpeed_rpm(double speed_mps) {
  const double speed_kmh = 3.6 * speed_mps;
  double rpm = 1000.0 * speed_kmh / kGears_kmh.front();
  for (const double gear_kmh : kGears_kmh) {
    const double shift_at_kmh = kShiftTo_rpm / 1000.0 * gear_kmh;
    const double taken = std::clamp((speed_kmh - shift_at_kmh) / kShift_kmh, 0.0, 1.0);
    rpm = std::lerp(rpm, 1000.0 * speed_kmh / gear_kmh, taken);
  }
  return std::max(kIdle_rpm, rpm);
}

float needleAngle_rad(const NeedleMeaning& needle, double value) {
  return needle.sweep_rad * static_cast<float>(std::min(std::max(0.0, value) / double{needle.full}, 1.0));
}

float digitAngle_rad(const DigitMeaning& digit, double value) {
  const double whole = std::round(std::max(0.0, value));
  const double from_here = std::floor(whole / std::pow(10.0, digit.place));
  const bool shown = digit.place == 0 || from_here >= 1.0;
  const double side = shown ? 1.0 + std::fmod(from_here, 10.0) : 0.0;
  return static_cast<float>(side * 2.0 * glm::pi<double>() / kDigitSides);
}

void poseInstruments(const Scene& scene, const CarView& car, double speed_mps, std::vector<Pose>& poses) {
  constexpr glm::vec3 kAxis(0.0F, 1.0F, 0.0F);
  for (const NeedleView& n : car.needles) {
    const double value = valueOf(n.scale.shows, speed_mps);
    turnNode(scene, n.node, kAxis, needleAngle_rad(n.scale, value), poses);
  }
  for (const DigitView& d : car.digits) {
    const double value = valueOf(d.drum.shows, speed_mps);
    turnNode(scene, d.node, kAxis, digitAngle_rad(d.drum, value), poses);
  }
}

}  // namespace host
