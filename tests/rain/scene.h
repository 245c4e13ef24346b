// Small scenes that the field's tests share: a view, a car, and ticks made of them.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "rain/field.h"
#include "tick.h"

namespace rg::rain::test {

using glm::dvec3;

inline constexpr double kKmh = 1.0 / 3.6;

struct Scene {
  int64_t index = 0;
  WeatherState weather;
  std::vector<VehicleState> vehicles;
  std::vector<ViewState> views;
  std::vector<double> heading_rad;  // of the views

  Tick tick() const {
    Tick t;
    t.index = index;
    t.time_ns = tickTimeNs(index);
    t.weather = weather;
    t.vehicles = vehicles;
    t.views = views;
    return t;
  }
};

// 60 deg horizontally, 16:9, looking level along `heading_rad` (0 = +x).
inline void look(ViewState& view, const dvec3& eye, double heading_rad, double pitch_rad = 0.0) {
  const dvec3 ahead(std::cos(heading_rad) * std::cos(pitch_rad), std::sin(heading_rad) * std::cos(pitch_rad),
                    std::sin(pitch_rad));
  const glm::dmat4 turned = glm::lookAt(dvec3(0.0), ahead, dvec3(0, 0, 1));
  view.eyeFromWorld = turned * glm::translate(glm::dmat4(1.0), -eye);
}

inline ViewState viewAt(const dvec3& eye, double heading_rad = 0.0) {
  ViewState view;
  view.id = 1;
  view.clipFromEye =
      glm::perspective(2.0 * std::atan(std::tan(glm::radians(30.0)) * 9.0 / 16.0), 16.0 / 9.0, 0.1, 1000.0);
  look(view, eye, heading_rad);
  return view;
}

inline Scene sceneWithView(double rain_mm_h, const dvec3& eye = dvec3(0, 0, 1.5)) {
  Scene scene;
  scene.weather.rain_mm_h = rain_mm_h;
  scene.views.push_back(viewAt(eye));
  return scene;
}

inline std::vector<dvec3> boxCorners(const dvec3& low, const dvec3& high) {
  std::vector<dvec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  return corners;
}

inline std::string setBox(Field& field, uint32_t id, const dvec3& low, const dvec3& high,
                          uint32_t vehicle = 0) {
  const auto corners = boxCorners(low, high);
  VolumeInfo info;
  info.name = "box";
  info.vehicle = vehicle;
  info.vertices = corners;
  return field.setVolume(id, info);
}

}  // namespace rg::rain::test
