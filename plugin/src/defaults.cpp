#include "defaults.h"

#include "glass/airflow.h"
#include "tick.h"

namespace rg {
namespace {

void identity(double m[16]) {
  for (int i = 0; i < 16; ++i) m[i] = i % 5 == 0 ? 1.0 : 0.0;
}

}  // namespace

template <>
rg_create_info defaults() {
  rg_create_info out{};
  out.max_drops = 131072;
  out.seed = 1;
  return out;
}

template <>
rg_vehicle defaults() {
  rg_vehicle out{};
  out.pose.orientation[3] = 1.0;
  return out;
}

template <>
rg_weather defaults() {
  rg_weather out{};
  out.temperature_c = 12.0;
  out.humidity = 0.9;
  out.visibility_m = 40000.0;
  out.ground_height_m = kNoGround_m;
  return out;
}

template <>
rg_view defaults() {
  rg_view out{};
  out.id = 1;
  identity(out.eye_from_world);
  identity(out.projection);
  out.exposure_s = 1.0 / 60.0;
  return out;
}

template <>
rg_volume_info defaults() {
  rg_volume_info out{};
  out.active = 1;
  return out;
}

template <>
rg_pane_info defaults() {
  rg_pane_info out{};
  out.active = 1;
  out.glass = RG_GLASS_UNCOATED;
  out.texel_m = 3e-3;
  out.max_drops = 20000;
  out.film_enabled = 1;
  return out;
}

template <>
rg_wiper_info defaults() {
  rg_wiper_info out{};
  out.axis[2] = 1.0;
  out.rest_direction[0] = 1.0;
  out.arm_m = 0.5;
  out.blade_m = 0.6;
  out.residual_film_m = 1e-7;
  out.lift_m = 2e-3;
  return out;
}

template <>
rg_wash_info defaults() {
  rg_wash_info out{};
  out.duration_s = 1.0;
  out.volume_m3 = 2e-5;
  out.direction[0] = 1.0;
  out.fan_rad = 0.2;
  return out;
}

template <>
rg_airflow defaults() {
  rg_airflow out{};
  const glass::AirflowShape shape;
  out.stagnation = shape.stagnation;
  out.outward = shape.outward;
  out.lee = shape.lee;
  out.drag_friction = shape.drag_friction;
  return out;
}

template <>
rg_target defaults() {
  rg_target out{};
  out.samples = 1;
  out.exposure = 1.0;
  return out;
}

template <>
rg_lighting defaults() {
  rg_lighting out{};
  for (int i = 0; i < 3; ++i) {
    out.sky_radiance[i] = 1.0f;
    out.ground_radiance[i] = 0.2f;
  }
  return out;
}

template <>
rg_capture_info defaults() {
  rg_capture_info out{};
  out.max_faces = 1;
  return out;
}

}  // namespace rg
