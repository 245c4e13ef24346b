// A car with a windscreen and a wiper, in heavy rain, below a small roof: little, but with something of
// everything.
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "plugin_library.h"

namespace rg::test {

inline constexpr uint32_t kCar = 1, kPane = 1, kWiper = 1, kRoof = 1, kView = 1;

// Where a host's world has its origin, and what its depth buffer holds.
struct Habits {
  double origin_m = 0.0;  // the scene lies there, along x and y
  bool reversed = false;  // infinite, clip space from 0 to 1; else OpenGL's own
  static constexpr double kNear_m = 0.1, kFar_m = 500.0;

  std::array<double, 2> depthRow() const {  // clip z = [0] * eye z + [1], clip w = -eye z
    if (reversed) return {0.0, kNear_m};
    return {-(kFar_m + kNear_m) / (kFar_m - kNear_m), -2.0 * kFar_m * kNear_m / (kFar_m - kNear_m)};
  }
  float storedDepth(double distance_m) const {
    const double ndc = -depthRow()[0] + depthRow()[1] / distance_m;
    return static_cast<float>(reversed ? ndc : 0.5 * ndc + 0.5);
  }
  float farthest() const { return reversed ? 0.0f : 1.0f; }
};

// A view along world +x from `eye`, 90 degrees across.
inline rg_view viewAlongX(const rg_api& api, const std::array<double, 3>& eye_m, int size_px,
                          const Habits& habits) {
  rg_view view;
  api.default_view(&view);
  const std::array<double, 16> eye{0, 0, -1, 0, -1, 0, 0, 0, 0, 1, 0, 0, eye_m[1], -eye_m[2], eye_m[0], 1};
  const auto [z, w] = habits.depthRow();
  const std::array<double, 16> projection{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, z, -1, 0, 0, w, 0};
  std::memcpy(view.eye_from_world, eye.data(), sizeof view.eye_from_world);
  std::memcpy(view.projection, projection.data(), sizeof view.projection);
  view.clip_zero_to_one = view.reversed_depth = habits.reversed ? 1 : 0;
  view.viewport_px[2] = view.viewport_px[3] = size_px;
  view.vehicle = kCar;
  return view;
}

class SmallScene {
 public:
  explicit SmallScene(const rg_api& table, uint32_t max_drops = 20000, const Habits& of_host = {})
      : api(table), habits(of_host) {
    rg_create_info info;
    api.default_create_info(&info);
    info.max_drops = max_drops;
    if (api.create(&info, &instance) != RG_OK) throw std::runtime_error(api.last_error(nullptr));
    expect(setRoof());
    expect(setPane());
    expect(setWiper());
  }
  ~SmallScene() { api.destroy(instance); }
  SmallScene(const SmallScene&) = delete;
  SmallScene& operator=(const SmallScene&) = delete;

  rg_result setRoof() const {
    std::array<double, 24> corners{20, -5, 4, 30, -5, 4, 20, 5, 4, 30, 5, 4,
                                   20, -5, 0, 30, -5, 0, 20, 5, 0, 30, 5, 0};
    for (size_t i = 0; i < corners.size(); ++i) corners[i] += i % 3 < 2 ? habits.origin_m : 0.0;
    rg_volume_info volume;
    api.default_volume_info(&volume);
    volume.vertices_m = corners.data();
    volume.vertex_count = 8;
    return api.set_volume(instance, kRoof, &volume);
  }

  // 0.4 x 0.4 m, upright, 1 m ahead of the car's origin; its outer side looks ahead.
  rg_result setPane(uint32_t max_drops = 20000) const {
    return setUprightPane(kPane, nullptr, {-0.2f, 0.2f}, 1.4f, max_drops);
  }

  // From y to y, from 1 m up to `top_m`, 1 m ahead.
  rg_result setUprightPane(uint32_t id, const char* name, std::array<float, 2> y_m, float top_m,
                           uint32_t max_drops = 20000, double mirror = 0.0) const {
    const auto [right, left] = y_m;
    const std::array<float, 12> positions{1, left, 1, 1, right, 1, 1, right, top_m, 1, left, top_m};
    const std::array<float, 8> uvs{0, 0, 1, 0, 1, 1, 0, 1};
    const std::array<uint32_t, 6> indices{0, 2, 1, 0, 3, 2};
    rg_pane_info pane;
    api.default_pane_info(&pane);
    pane.name = name;
    pane.vehicle = kCar;
    pane.positions_m = positions.data();
    pane.uvs = uvs.data();
    pane.indices = indices.data();
    pane.vertex_count = 4;
    pane.index_count = 6;
    pane.texel_m = 10e-3;
    pane.max_drops = max_drops;
    pane.mirror = mirror;
    return api.set_pane(instance, id, &pane);
  }

  // A jet onto the pane, of half a second and 5 mL.
  rg_wash_info jet() const {
    rg_wash_info info;
    api.default_wash_info(&info);
    info.pane = kPane;
    info.duration_s = 0.5;
    info.volume_m3 = 5e-6;
    const std::array<double, 3> nozzle{1.3, 0.0, 1.0}, toward{-0.3, 0.0, 0.2};
    const double length = std::hypot(toward[0], toward[2]);
    for (size_t i = 0; i < 3; ++i) {
      info.nozzle_m[i] = nozzle[i];
      info.direction[i] = toward[i] / length;
    }
    return info;
  }

  rg_result setWiper(uint32_t id = kWiper, uint32_t on = kPane, double pivot_y_m = 0.2) const {
    rg_wiper_info wiper;
    api.default_wiper_info(&wiper);
    wiper.pane = on;
    const std::array<double, 3> pivot{1.0, pivot_y_m, 1.0}, axis{1, 0, 0}, rest{0, -1, 0};
    std::memcpy(wiper.pivot_m, pivot.data(), sizeof wiper.pivot_m);
    std::memcpy(wiper.axis, axis.data(), sizeof wiper.axis);
    std::memcpy(wiper.rest_direction, rest.data(), sizeof wiper.rest_direction);
    wiper.arm_m = 0.2;
    wiper.blade_m = 0.2;
    return api.set_wiper(instance, id, &wiper);
  }

  // One sixtieth of a second.
  rg_result step() {
    time_ns = ++steps * INT64_C(1'000'000'000) / 60;
    const double x = habits.origin_m + 10.0 * static_cast<double>(time_ns) * 1e-9;
    rg_weather weather;
    api.default_weather(&weather);
    weather.rain_mm_h = rain_mm_h;
    weather.snow_mm_h = snow_mm_h;
    weather.hail_mm_h = hail_mm_h;
    weather.temperature_c = temperature_c;
    weather.wind_mps[1] = crosswind_mps;
    weather.ground_height_m = 0.0;
    rg_vehicle car;
    api.default_vehicle(&car);
    car.id = kCar;
    car.pose.position_m[0] = x;
    car.pose.position_m[1] = habits.origin_m;
    car.pose.velocity_mps[0] = 10.0;
    view = viewAlongX(api, {x, habits.origin_m, 1.2}, kSize_px, habits);
    view.id = kView;
    const rg_wiper_knot knot{time_ns, kWiper, 0, -0.7 - 0.7 * std::sin(static_cast<double>(steps) * 0.2)};
    rg_sample sample;
    api.default_sample(&sample);
    sample.time_ns = time_ns;
    sample.weather = &weather;
    sample.vehicles = &car;
    sample.vehicle_count = 1;
    sample.views = &view;
    sample.view_count = 1;
    sample.wiper_knots = &knot;
    sample.wiper_knot_count = 1;
    return api.update(instance, time_ns, &sample, 1, sizeof sample);
  }

  rg_result attach(rg_gl_get_proc_fn get_proc, uint32_t host_resets_state = 0) const {
    rg_gl_info info;
    api.default_gl_info(&info);
    info.get_proc = get_proc;
    info.host_resets_state = host_resets_state;
    return api.attach_gl(instance, &info);
  }

  rg_target target(uint32_t framebuffer) const {
    rg_target t;
    api.default_target(&t);
    t.framebuffer = framebuffer;
    t.width_px = t.height_px = kSize_px;
    return t;
  }

  // `function` is one of the table's draw functions.
  rg_result draw(rg_result (*function)(rg_instance*, rg_draw*), const rg_target& into,
                 uint32_t* touched = nullptr) const {
    rg_draw d;
    api.default_draw(&d);
    d.time_ns = time_ns;
    d.view = &view;
    d.target = &into;
    const rg_result result = function(instance, &d);
    if (touched != nullptr) *touched = d.touched;
    return result;
  }

  void expect(rg_result result) const {
    if (result < 0) throw std::runtime_error(api.last_error(instance));
  }

  static constexpr int kSize_px = 64;
  const rg_api& api;
  const Habits habits;
  double rain_mm_h = 100.0, snow_mm_h = 0.0, hail_mm_h = 0.0, temperature_c = 12.0, crosswind_mps = 0.0;
  rg_instance* instance = nullptr;
  rg_view view{};
  int64_t time_ns = 0;
  int64_t steps = 0;
};

}  // namespace rg::test
