// What is driven: the shipped scenarios as they are, in a storm from the side and from ahead, braking at 1 g,
// and in snow, sleet and hail.
#pragma once

#include <cctype>
#include <ostream>
#include <span>
#include <string>
#include <vector>

namespace oracle {

struct Variant {
  std::string scenario;
  std::vector<std::string> changes{};  // as --set
  std::string camera = "cockpit";
  std::string
      brake_for{};      // shelter of the road on entering which the car brakes at 1 g to a stop; empty: none
  std::string falls{};  // snow, sleet or hail; empty: the scenario's rain
  bool sheltered = true;
};

// Instead of the scenario's rain; rates are of water.
inline const std::vector<std::string> kSnow{"weather.rain_mm_h=0", "weather.snow_mm_h=1.5",
                                            "weather.temperature_c=-4"};
inline const std::vector<std::string> kSleet{"weather.rain_mm_h=3", "weather.snow_mm_h=2",
                                             "weather.temperature_c=1"};
inline const std::vector<std::string> kHail{"weather.rain_mm_h=10", "weather.hail_mm_h=60",
                                            "weather.temperature_c=9"};

// One of each kind: of place, wind, eye, braking and of what falls.
inline const Variant kKinds[] = {
    {.scenario = "tunnel"},
    {.scenario = "canopy", .changes = {"weather.wind_y_mps=40"}},
    {.scenario = "tunnel", .changes = {"weather.wind_x_mps=-40"}},
    {.scenario = "tunnel", .changes = {"drive.speed_kmh=80"}, .brake_for = "tunnel_0"},
    {.scenario = "canopy",
     .changes = {"drive.speed_kmh=50", "drive.stops=[[1,0]]", "weather.wind_y_mps=40"},
     .camera = "outside",
     .brake_for = "canopy"},
    {.scenario = "canopy",
     .changes = {"weather.wind_x_mps=30", "weather.wind_y_mps=-27"},
     .camera = "outside"},
    {.scenario = "tunnel",
     .changes = {"weather.wind_y_mps=15", "plugin.wind.gust_share=0.5", "plugin.wind.gust_time_s=5"}},
    {.scenario = "canopy",
     .changes = {"weather.wind_y_mps=-20", "plugin.wind.gust_share=0.4", "plugin.wind.gust_time_s=5",
                 "plugin.wind.roughness_m=0.1"},
     .camera = "outside"},
    {.scenario = "canopy", .falls = "snow"},
    {.scenario = "tunnel", .changes = {"weather.wind_y_mps=10"}, .falls = "sleet"},
    {.scenario = "canopy", .camera = "outside", .falls = "hail"},
};
inline const Variant kOthers[] = {
    {.scenario = "canopy"},
    {.scenario = "tunnel", .changes = {"weather.wind_y_mps=40"}},
    {.scenario = "canopy", .changes = {"drive.speed_kmh=50", "drive.stops=[[1,0]]"}, .brake_for = "canopy"},
    {.scenario = "tunnel", .camera = "outside"},
    {.scenario = "canopy", .camera = "outside"},
    {.scenario = "canopy", .changes = {"weather.wind_x_mps=-40"}},
    {.scenario = "tunnel",
     .changes = {"drive.speed_kmh=80", "weather.wind_x_mps=-40"},
     .brake_for = "tunnel_0"},
    {.scenario = "tunnel", .camera = "outside", .falls = "snow"},
    {.scenario = "tunnel", .changes = {"drive.speed_kmh=80"}, .brake_for = "tunnel_0", .falls = "hail"},
};

// Only the seconds about the shelter: in, through or to a short stop, and out. The field is full from the
// start, and a second gives the car a past.
inline Variant briefly(Variant v) {
  std::vector<std::string> about{"prewarm_s=1"};
  if (v.scenario == "tunnel") {
    about.insert(about.end(), {"drive.start_m=515", "drive.speed_kmh=80", "seconds=11"});
  } else {
    about.insert(about.end(), {"drive.start_m=1015", "drive.speed_kmh=[[1015,40],[1030,25]]",
                               "drive.stops=[[1054,1]]", "seconds=14"});
  }
  if (!v.brake_for.empty()) about.emplace_back("seconds=5");
  v.changes.insert(v.changes.begin(), about.begin(), about.end());
  return v;
}
inline std::vector<Variant> briefly(std::span<const Variant> variants) {
  std::vector<Variant> all;
  for (const Variant& v : variants) all.push_back(briefly(v));
  return all;
}

inline std::string nameOf(const Variant& v) {
  std::string name = v.scenario + "_" + v.camera;
  for (const std::string& c : v.changes) {
    if (c.starts_with("weather.")) name += c.substr(7);
    if (c.starts_with("plugin.wind.gust_share")) name += "_gusts";
  }
  if (!v.falls.empty()) name += "_" + v.falls;
  if (!v.brake_for.empty()) name += "_1g";
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : c == '-' ? 'm' : '_';
  return name;
}

inline void PrintTo(const Variant& v, std::ostream* out) { *out << nameOf(v); }  // for GoogleTest

}  // namespace oracle
