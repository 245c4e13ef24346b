// The host's samples, and what lies between them: at which moments ticks fall, and the inputs of each.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "gusts.h"
#include "saved/inputs.h"
#include "tick.h"

namespace rg {

// A value at a time: a wiper's angle in rad, a window's opening in m.
struct Knot {
  int64_t time_ns = 0;
  double value = 0.0;
  static void visit(auto& a, auto& knot) {
    a.within(knot.time_ns, -kLatestTime_ns, kLatestTime_ns);
    a.within(knot.value, -10.0, 10.0);
  }
};

// A sample as the plugin keeps it. Vehicles and views are in the order of their ids.
struct Sample {
  int64_t time_ns = 0;
  WeatherState weather;
  std::vector<VehicleState> vehicles;
  std::vector<ViewState> views;
  std::vector<std::pair<uint32_t, Knot>> wiper_knots, opening_knots;  // the timeline keeps them apart

  static void visit(auto& a, auto& sample) {
    constexpr size_t kMostBodies = 1u << 20, kMostViews = 64;
    a.within(sample.time_ns, -kLatestTime_ns, kLatestTime_ns);
    a(sample.weather);
    a.list(sample.vehicles, kMostBodies);
    a.list(sample.views, kMostViews);
  }
};

// Inputs between samples are linear (poses: position linear, orientation slerp); beyond the last one bodies
// go on with their velocities. A tick's inputs depend on the samples around it alone, so they do not depend
// on how time is cut into updates, as long as the sample at or after a tick is there when the tick runs.
class Timeline {
 public:
  // Takes a sample later than all before. Vehicles and views it does not list stay as they were (a moving
  // vehicle comes to rest).
  void add(const Sample& sample);
  bool empty() const { return samples_.empty(); }
  const Sample& first() const { return samples_.front(); }
  const Sample& last() const { return samples_.back(); }

  // What the samples' wind swings by, from the next tick asked for on.
  void setGusts(const Gusts& gusts) { gusts_ = gusts; }

  // Whether rain and snow are shared out anew by temperature and humidity, from the next tick asked for on.
  void setByTemperature(bool by_temperature) { by_temperature_ = by_temperature; }

  // Inputs of the tick with this index; spans stay valid until the next call. Needs a sample.
  const Tick& tick(int64_t index);

  // A vehicle at any moment from shortly before the last tick on, for drawing between ticks.
  std::optional<VehicleState> vehicleAt(uint32_t id, int64_t time_ns) const;
  // A wiper's angle, held before the first knot and after the last; none when it never had a knot.
  std::optional<double> wiperAngleAt(uint32_t wiper, int64_t time_ns) const;
  // How far a window has slid, held after the last knot; none before the first.
  std::optional<double> openingAt(uint32_t pane, int64_t time_ns) const;

  // Forgets what no tick from `index` on and no picture less than a second old can ask for.
  void prune(int64_t index);
  void removeVehicle(uint32_t id);
  void removeWiper(uint32_t id);
  void removeOpening(uint32_t pane);
  void clear();
  // All positions become p - shift.
  void rebase(const glm::dvec3& shift_m);

  // The samples; what the gusts and the temperature do to them is told anew.
  void write(saved::Writer& a) const;
  void read(saved::Reader& a);

 private:
  std::pair<const Sample*, const Sample*> around(int64_t time_ns) const;

  Gusts gusts_;
  bool by_temperature_ = false;
  std::vector<Sample> samples_;  // ascending
  using Knots = std::map<uint32_t, std::vector<Knot>>;
  static void addKnots(const std::vector<std::pair<uint32_t, Knot>>& added, Knots& to);
  static void pruneKnots(int64_t oldest_ns, Knots& knots);
  static void writeKnots(saved::Writer& a, const Knots& knots);
  static Knots readKnots(saved::Reader& a);

  Knots wiper_knots_, opening_knots_;
  Tick tick_;
  std::vector<VehicleState> vehicles_;
  std::vector<ViewState> views_;
  std::vector<WiperMotion> wipers_;
};

// A body's pose `seconds` later, at constant linear and angular velocity.
Pose extrapolated(const Pose& pose, double seconds);

}  // namespace rg
