#include "defaults.h"

#include "glass/airflow.h"
#include "tick.h"

namespace rg {
namespace {

// False for null: a function that can return no code does nothing then.
template <typename T>
bool clear(T* out) {
  if (out == nullptr) return false;
  *out = T{};
  out->struct_size = sizeof(T);
  return true;
}

void identity(double m[16]) {
  for (int i = 0; i < 16; ++i) m[i] = i % 5 == 0 ? 1.0 : 0.0;
}

}  // namespace

void defaultCreateInfo(rg_create_info* out) {
  if (!clear(out)) return;
  out->max_drops = 131072;
  out->seed = 1;
}

void defaultGlInfo(rg_gl_info* out) { clear(out); }

void defaultVehicle(rg_vehicle* out) {
  if (!clear(out)) return;
  out->pose.orientation[3] = 1.0;
}

void defaultWeather(rg_weather* out) {
  if (!clear(out)) return;
  out->temperature_c = 12.0;
  out->humidity = 0.9;
  out->visibility_m = 40000.0;
  out->ground_height_m = kNoGround_m;
}

void defaultView(rg_view* out) {
  if (!clear(out)) return;
  out->id = 1;
  identity(out->eye_from_world);
  identity(out->projection);
  out->exposure_s = 1.0 / 60.0;
}

void defaultSample(rg_sample* out) {
  if (!clear(out)) return;
  out->vehicle_stride = sizeof(rg_vehicle);
  out->view_stride = sizeof(rg_view);
}

void defaultVolumeInfo(rg_volume_info* out) {
  if (!clear(out)) return;
  out->active = 1;
}

void defaultPaneInfo(rg_pane_info* out) {
  if (!clear(out)) return;
  out->active = 1;
  out->glass = RG_GLASS_UNCOATED;
  out->texel_m = 3e-3;
  out->max_drops = 20000;
  out->film_enabled = 1;
}

void defaultWiperInfo(rg_wiper_info* out) {
  if (!clear(out)) return;
  out->axis[2] = 1.0;
  out->rest_direction[0] = 1.0;
  out->arm_m = 0.5;
  out->blade_m = 0.6;
  out->residual_film_m = 1e-7;
  out->lift_m = 2e-3;
}

void defaultWashInfo(rg_wash_info* out) {
  if (!clear(out)) return;
  out->duration_s = 1.0;
  out->volume_m3 = 2e-5;
  out->direction[0] = 1.0;
  out->fan_rad = 0.2;
}

void defaultAirflow(rg_airflow* out) {
  if (!clear(out)) return;
  const glass::AirflowShape shape;
  out->stagnation = shape.stagnation;
  out->outward = shape.outward;
  out->lee = shape.lee;
  out->drag_friction = shape.drag_friction;
}

void defaultTarget(rg_target* out) {
  if (!clear(out)) return;
  out->samples = 1;
  out->exposure = 1.0;
}

void defaultLighting(rg_lighting* out) {
  if (!clear(out)) return;
  for (int i = 0; i < 3; ++i) {
    out->sky_radiance[i] = 1.0f;
    out->ground_radiance[i] = 0.2f;
  }
}

void defaultDraw(rg_draw* out) { clear(out); }

void defaultCaptureInfo(rg_capture_info* out) {
  if (!clear(out)) return;
  out->max_faces = 1;
}

void defaultRainPattern(rg_rain_pattern* out) { clear(out); }

}  // namespace rg
