#include "rain/bounce.h"

#include <algorithm>
#include <cmath>

#include "gravity.h"
#include "rain/hail_law.h"
#include "rain/standing.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr double kTouching_m =
    0.05;                          // bodies are where they were foreseen to within 1 cm, and turn meanwhile
constexpr double kClear_m = 1e-3;  // off the surface, so that rounding does not put the stone in it
constexpr int kChords = 12;        // that a flight's arc is followed by

int axisOf(double velocity_mps) {
  const double step = static_cast<double>(shared::kRainBounceStep_mps);
  return static_cast<int>(std::lround(std::clamp(velocity_mps / step, -512.0, 511.0)));
}

uint32_t packed(const dvec3& velocity_mps) {
  uint32_t id = 0;
  for (int axis = 0; axis < 3; ++axis)
    id |= static_cast<uint32_t>(axisOf(velocity_mps[axis]) + 512) << (10 * axis);
  return id;
}

dvec3 placeAt(const Flight& flight, double after_s) {
  return flight.place_m + flight.velocity_mps * after_s -
         dvec3(0, 0, 0.5 * kGravity_mps2 * after_s * after_s);
}

// Until the stone's middle is `height_m` above the world's zero again, falling.
double timeDownTo(double height_m, const Flight& flight) {
  const double up_mps = flight.velocity_mps.z, above_m = flight.place_m.z - height_m;
  const double under_root = up_mps * up_mps + 2.0 * kGravity_mps2 * above_m;
  return under_root > 0.0 ? (up_mps + std::sqrt(under_root)) / kGravity_mps2 : 0.0;
}

double timeToVolume(const Flight& flight, Shelter& shelter, double begin_s) {
  const double step_s = flight.lasts_s / kChords;
  ClassPath chord;
  chord.count = 1;
  for (int i = 0; i < kChords; ++i) {
    const dvec3 from = placeAt(flight, i * step_s);
    chord.pieces[0] = {0.0, step_s, dvec3(0.0), (placeAt(flight, (i + 1) * step_s) - from) / step_s};
    const double then_s = begin_s + i * step_s;
    if (!shelter.lookAround(from, dvec3(kTouching_m), chord, then_s, false)) continue;
    const double enters_s = shelter.willEnter(from, chord, then_s);
    if (enters_s <= step_s) return i * step_s + enters_s;
  }
  return flight.lasts_s;
}

}  // namespace

Flight flightAfter(const Impact& impact, double ground_m, Shelter& shelter, double now_s) {
  const double radius_m = 0.5 * impact.diameter_m, on_ground_m = ground_m + radius_m;
  Surface hit{dvec3(0, 0, 1), dvec3(0.0), impact.place_m.z - on_ground_m};
  const bool on_volume = shelter.surfaceAt(impact.place_m, impact.ago_s, kTouching_m, hit);
  Flight flight;
  if (!on_volume && std::abs(hit.outside_m) > kTouching_m) return flight;
  const double off_m = (on_volume ? radius_m : 0.0) + kClear_m - hit.outside_m;
  flight.place_m = impact.place_m + hit.normal * off_m;
  const dvec3 leaves =
      hit.velocity_mps + bouncedVelocity(impact.velocity_mps - hit.velocity_mps, hit.normal, impact.id);
  flight.velocity_mps = dvec3(shared::rainBounceVelocity(packed(leaves)));
  flight.lasts_s = std::min(timeDownTo(on_ground_m, flight), kLongestFlight_s);
  if (flight.lasts_s > 0.0) flight.lasts_s = timeToVolume(flight, shelter, now_s - impact.ago_s);
  return flight;
}

shared::RainDrop recordOf(const Flight& flight, double diameter_m, const dvec3& origin_m, uint32_t from,
                          uint32_t end) {
  constexpr double kFarthest = 2e9;
  const dvec3 cell = glm::floor((flight.place_m - origin_m) / classLattices()[kBouncedClass].cell_m);
  shared::RainDrop drop{};
  if (!(std::max({std::abs(cell.x), std::abs(cell.y), std::abs(cell.z)}) < kFarthest)) return drop;
  drop.cell_x = static_cast<int32_t>(cell.x);
  drop.cell_y = static_cast<int32_t>(cell.y);
  drop.cell_z = static_cast<int32_t>(cell.z);
  drop.fraction_xy = from;
  drop.fraction_z_class = 0x8000u | kBouncedClass << 16;
  drop.diameter_m = static_cast<float>(diameter_m);
  drop.end = end;
  drop.id = packed(flight.velocity_mps);
  return drop;
}

}  // namespace rg::rain
