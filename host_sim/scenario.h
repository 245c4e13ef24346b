// What is driven: a TOML file, with changes from the command line, checked and turned into curves.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "drive/curve.h"
#include "drive/driver.h"
#include "drive/traffic.h"
#include "drive/wiper_control.h"
#include "scene/meaning.h"

namespace host {

// The user's input is wrong; what() is one line that names it. main() ends with exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct WiperSwitch {
  double at_s = 0.0;
  WiperMode mode = WiperMode::off;
};

struct Scenario {
  std::string name;
  std::string title;
  double seconds = 60.0;
  double prewarm_s =
      0.0;  // rain and water on the glass that long before the first picture, standing at the start
  uint64_t seed = 1;
  std::filesystem::path car, road;  // empty: none
  DrivePlan plan;
  std::vector<TrafficCar> traffic;
  Curve rain_mm_h{0.0}, snow_mm_h{0.0}, hail_mm_h{0.0};  // as water
  Curve wind_x_mps{0.0}, wind_y_mps{0.0};
  Curve temperature_c{12.0}, humidity{0.9};
  Curve visibility_m{20000.0};
  double sun_elevation_deg = 35.0;
  double sun_azimuth_deg = 140.0;
  std::vector<WiperSwitch> wipers;
  double wiper_pause_s = kIntermittentPause_s;
  std::vector<double> washes;                          // seconds
  std::vector<std::pair<double, double>> demister;     // from second on: share of its full flow
  std::vector<std::pair<std::string, Curve>> windows;  // how far they have slid open, m, by their pane
  std::string camera = "cockpit";                      // see cameraNames() in simulation.h
  // Luminance that is white in a picture of fixed exposure without tone curve, as a camera takes it; none:
  // the driver's eye adapts.
  std::optional<double> white_cd_m2;
  std::optional<GlassSurface> glass;  // of all panes, instead of what the car's model says
  bool headlights = true;
  bool shelter = true;  // false: the plugin is told of no volume, and it rains through roofs
  std::vector<std::pair<std::string, double>> parameters;  // the plugin's, by name
};

// NAME (scenarios/NAME.toml below `root`) or FILE; `changes` are "path.to.key=value" with TOML values (bare
// words are taken as strings).
Scenario loadScenario(const std::string& name_or_file, const std::vector<std::string>& changes,
                      const std::filesystem::path& root);

WiperMode wiperModeAt(const Scenario& scenario, double time_s);

}  // namespace host
