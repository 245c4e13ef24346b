// The host's world in motion: car, wipers, weather and eye at fixed ticks, told to the plugin. No drawing
// here.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drive/driver.h"
#include "drive/rain_sensor.h"
#include "drive/route.h"
#include "drive/wiper_control.h"
#include "rain_plugin.h"
#include "render/renderer.h"
#include "scenario.h"
#include "scene/views.h"

namespace host {

// An eye in the world.
struct Eye {
  View view;
  glm::dvec3 position_m{0.0};
  glm::dvec3 velocity_mps{0.0};
  bool inside = false;
  bool cut = false;
};

// A camera moved by a person.
struct FreeCamera {
  glm::dvec3 position_m{0.0};
  double yaw_rad = 0.0, pitch_rad = 0.0;
};

struct Weather {
  double rain_mm_h = 0.0, snow_mm_h = 0.0, hail_mm_h = 0.0;
  glm::dvec3 wind_mps{0.0};
  double temperature_c = 12.0, humidity = 0.9, visibility_m = 20000.0;
};

// What a person changed in the window; the scenario's own value where there is none.
struct Overrides {
  std::optional<double> rain_mm_h, snow_mm_h, hail_mm_h;
  std::optional<glm::dvec3> wind_mps;
  std::optional<WiperMode> wipers;
  std::optional<double> wiper_pause_s;
  std::optional<Controls> controls;
};

// What `camera` of a scenario may be: the host's own, then the car's.
std::vector<std::string> cameraNames(const CarView& car);

class Simulation {
 public:
  // Throws InputError when the scenario's camera is none of cameraNames().
  Simulation(const Scenario& scenario, const CarView& car, const RoadView& road, RainPlugin& plugin,
             glm::ivec2 size_px);

  // Luminance the eye adapts to, for a place; asked ten times a simulated second.
  std::function<double(glm::dvec3)> adapting_luminance;
  Overrides overrides;
  std::string camera;
  FreeCamera free_camera;

  // Runs the host's ticks up to a moment, told to the plugin at its next update. The first call also runs the
  // scenario's prewarm.
  void advance(int64_t time_ns);
  // As the scenario's clock says, from 0 at the first picture; the plugin's clock is ahead of it by the
  // prewarm.
  int64_t pluginTime(int64_t time_ns) const { return time_ns + prewarm_ns_; }

  CarState carAt(int64_t time_ns) const;
  std::vector<CarState> trafficAt(int64_t time_ns) const;  // the scenario's, one by one
  Eye eyeAt(int64_t time_ns) const;
  rg_view pluginViewAt(int64_t time_ns) const;
  Weather weather() const;
  double wiperShare() const { return motor_.share(); }
  double wetness() const { return 1.0 - std::exp(-water_on_road_mm_ / 0.15); }
  double adaptedLuminance() const { return std::exp(log_luminance_); }
  WiperMode wiperMode() const { return wiper_mode_; }
  // The washer sprays every wiped pane, and the wipers go three times.
  void wash();
  void resize(glm::ivec2 size_px) { size_px_ = size_px; }
  Driver& driver() { return driver_; }
  std::vector<std::string> cameras() const { return cameraNames(car_); }
  double timeS() const;

  // What a saved run holds of it, between two of the plugin's updates.
  template <class Fields>
  void visit(Fields& f) {
    f.part("driver", driver_), f.part("motor", motor_), f.part("sensor", sensor_);
    f("prewarm_ns", prewarm_ns_, int64_t{0}, int64_t{3'600'000'000'000});
    f("tick", tick_, int64_t{-1}, int64_t{1} << 32), f("demister", demister_, 0.0, 1.0);
    f("water_on_road_mm", water_on_road_mm_, 0.0, 10.0);
    f("log_luminance", log_luminance_, -100.0, 100.0);
    f("day_log_luminance", day_log_luminance_, -100.0, 100.0);
    f("adapted", adapted_), f("camera", camera_before_);
  }
  // After its fields have been read: who has the wheel now keeps it.
  void resume();

 private:
  void tick();
  void tickWipers();
  void tickDemister();
  void tell();
  Eye eyeOf(const CarState& car) const;
  rg_view viewOf(const CarState& car) const;

  const Scenario& scenario_;
  const CarView& car_;
  RainPlugin& plugin_;
  glm::ivec2 size_px_;
  Route route_;
  Driver driver_;
  WiperMotor motor_;
  WiperMode wiper_mode_ = WiperMode::off;
  RainSensor sensor_;
  int64_t prewarm_ns_ = 0;
  int64_t tick_ = -1;  // of the plugin's clock; -1: not begun
  double demister_ = 0.0;
  std::vector<std::pair<uint32_t, const Curve*>> windows_;  // panes that slide
  std::vector<rg_wiper_knot> knots_;
  double water_on_road_mm_ = 0.0;
  double log_luminance_ = 0.0,
         day_log_luminance_ = 0.0;  // natural logarithms of 1000 cd/m^2; the brightest met so far
  bool adapted_ = false;
  std::string camera_before_;
  bool cut_ = true;
};

}  // namespace host
