// What is driven: the shipped scenarios as they are, in a storm from the side and from ahead, and braking at
// 1 g.
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
      brake_for{};  // shelter of the road on entering which the car brakes at 1 g to a stop; empty: none
  bool sheltered = true;
};

inline const Variant kVariants[] = {
    {.scenario = "tunnel"},
    {.scenario = "canopy"},
    {.scenario = "tunnel", .changes = {"weather.wind_y_mps=40"}},
    {.scenario = "canopy", .changes = {"weather.wind_y_mps=40"}},
    {.scenario = "tunnel", .changes = {"drive.speed_kmh=80"}, .brake_for = "tunnel_0"},
    {.scenario = "canopy", .changes = {"drive.speed_kmh=50", "drive.stops=[[1,0]]"}, .brake_for = "canopy"},
    {.scenario = "tunnel", .camera = "outside"},
    {.scenario = "canopy", .camera = "outside"},
    {.scenario = "tunnel", .changes = {"weather.wind_x_mps=-40"}},
    {.scenario = "canopy", .changes = {"weather.wind_x_mps=-40"}},
    {.scenario = "canopy",
     .changes = {"weather.wind_x_mps=30", "weather.wind_y_mps=-27"},
     .camera = "outside"},
    {.scenario = "tunnel",
     .changes = {"drive.speed_kmh=80", "weather.wind_x_mps=-40"},
     .brake_for = "tunnel_0"},
    {.scenario = "canopy",
     .changes = {"drive.speed_kmh=50", "drive.stops=[[1,0]]", "weather.wind_y_mps=40"},
     .camera = "outside",
     .brake_for = "canopy"},
    {.scenario = "tunnel",
     .changes = {"weather.wind_y_mps=15", "plugin.wind.gust_share=0.5", "plugin.wind.gust_time_s=5"}},
    {.scenario = "canopy",
     .changes = {"weather.wind_y_mps=-20", "plugin.wind.gust_share=0.4", "plugin.wind.gust_time_s=5",
                 "plugin.wind.roughness_m=0.1"},
     .camera = "outside"},
};
// One of each kind, for tests that take long.
inline const auto kFewVariants = std::span(kVariants).first<6>();

inline std::string nameOf(const Variant& v) {
  std::string name = v.scenario + "_" + v.camera;
  for (const std::string& c : v.changes) {
    if (c.starts_with("weather.")) name += c.substr(7);
    if (c.starts_with("plugin.wind.gust_share")) name += "_gusts";
  }
  if (!v.brake_for.empty()) name += "_1g";
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : c == '-' ? 'm' : '_';
  return name;
}

inline void PrintTo(const Variant& v, std::ostream* out) { *out << nameOf(v); }  // for GoogleTest

}  // namespace oracle
