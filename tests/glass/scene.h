// Panes, weathers and runs that the glass's tests share.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "glass/pane.h"
#include "glass/pane_gl.h"
#include "glass/pane_map.h"
#include "tick.h"
#include "windscreen.h"

namespace rg::test {

inline glass::PaneInfo paneInfo(const Mesh& mesh) {
  glass::PaneInfo info;
  info.name = "windscreen";
  info.positions_m = mesh.positions;
  info.uvs = mesh.uvs;
  info.indices = mesh.indices;
  return info;
}

// Marshall & Palmer drops scaled to deliver the rate (physics.md 1), in `count` classes of 0.5 .. 6 mm.
inline void setRain(glass::PaneTick& tick, double rate_mm_h, int count = 32) {
  tick.class_count = 0;
  if (rate_mm_h <= 0.0) return;
  const double slope_per_mm = 4.1 * std::pow(rate_mm_h, -0.21);
  const double step_mm = 5.5 / count;
  double delivered = 0.0;
  for (int i = 0; i < count; ++i) {
    const double d_mm = 0.5 + (i + 0.5) * step_mm;
    glass::SizeClass& size = tick.classes[tick.class_count++];
    size.diameter_m = d_mm * 1e-3;
    size.number_per_m3 = 8000.0 * std::exp(-slope_per_mm * d_mm) * step_mm;
    size.fall_speed_mps = 9.65 - 10.3 * std::exp(-0.6 * d_mm);
    delivered += size.number_per_m3 * size.fall_speed_mps * kPi / 6.0 * std::pow(size.diameter_m, 3.0);
  }
  const double scale = rate_mm_h / 3.6e6 / delivered;
  for (uint32_t i = 0; i < tick.class_count; ++i) tick.classes[i].number_per_m3 *= scale;
}

// Driving forward at `speed_mps` in still air.
inline glass::PaneTick weather(double rate_mm_h, double speed_mps = 0.0, double humidity = 1.0) {
  glass::PaneTick tick;
  tick.air_mps = {-speed_mps, 0.0, 0.0};
  tick.humidity = humidity;
  tick.wet_share.fill(1.0f);
  setRain(tick, rate_mm_h);
  return tick;
}

// A wiper that reaches over most of windscreen(): pivot below its lower edge, 0 to the right seen from
// outside ... the sweep is 0..pi.
inline glass::WiperInfo wiper(double slope_rad = kPi / 6.0, double height_m = 0.8) {
  glass::WiperInfo info;
  const glm::dvec3 up(-std::cos(slope_rad), 0.0, std::sin(slope_rad));
  info.axis = {std::sin(slope_rad), 0.0, std::cos(slope_rad)};
  info.rest_direction = {0.0, 1.0, 0.0};  // to the left seen from inside
  info.pivot_m = glm::dvec3(1.5, 0.0, 1.2) - up * (0.5 * height_m);
  info.arm_m = 0.4;
  info.blade_m = 0.5;
  return info;
}

// A to and fro with `cycles_per_min`, as a triangle between two angles; strokes know their reversal.
class WiperMotor {
 public:
  WiperMotor(uint32_t id, double from_rad, double to_rad, double cycles_per_min)
      : id_(id), from_(from_rad), to_(to_rad), hz_(cycles_per_min / 60.0) {}
  double angleAt(double time_s) const {
    const double phase = time_s * hz_ - std::floor(time_s * hz_);
    return from_ + (to_ - from_) * (phase < 0.5 ? 2.0 * phase : 2.0 - 2.0 * phase);
  }
  glass::WiperStroke stroke(double before_s, double now_s) const {
    glass::WiperStroke stroke{id_, angleAt(before_s), angleAt(now_s), angleAt(now_s)};
    const double a = before_s * hz_ * 2.0, b = now_s * hz_ * 2.0;  // reversals at whole numbers
    if (std::floor(b) > std::floor(a) && b > std::floor(b))
      stroke.extreme_rad = static_cast<int64_t>(std::floor(b)) % 2 == 1 ? to_ : from_;
    return stroke;
  }

 private:
  uint32_t id_;
  double from_, to_, hz_;
};

// One pane on the GPU, stepped as a host would at 60 pictures a second.
struct Simulation {
  Simulation(const GladGLContext& gl, const glass::PaneInfo& info,
             glass::FilmKernel leaky = glass::FilmKernel::none)
      : sim(std::make_shared<glass::PaneSim>(info, 1, 7)),
        pane(gl, glass::makeFilmPrograms(gl, leaky), sim) {}

  void tick(glass::PaneTick tick, const WiperMotor* motor = nullptr) {
    tick.index = ++index;
    if (motor != nullptr) {
      tick.wiper_count = 1;
      tick.wipers[0] = motor->stroke(static_cast<double>(index - 1) * kTickSeconds,
                                     static_cast<double>(index) * kTickSeconds);
    }
    sim->submit(tick);
  }
  void run(const glass::PaneTick& weather, double seconds, const WiperMotor* motor = nullptr,
           int ticks_a_picture = 2) {
    const auto ticks = static_cast<int64_t>(std::llround(seconds / kTickSeconds));
    for (int64_t i = 0; i < ticks; ++i) {
      tick(weather, motor);
      if (i % ticks_a_picture == 0) pane.step();
    }
  }
  glass::PaneStats stats() {
    pane.finish();
    return sim->stats();
  }
  double thickness_m(const std::vector<int32_t>& film, int texel) const {
    return static_cast<double>(film[static_cast<size_t>(texel)]) * 1e-15 /
           static_cast<double>(sim->map().texel(texel).area_m2);
  }

  std::shared_ptr<glass::PaneSim> sim;
  glass::PaneGl pane;
  int64_t index = 0;
};

inline int64_t sumOf(const glass::PaneStats& s) {
  return s.on_glass_pl + s.drained_pl + s.wiped_pl + s.blown_pl + s.evaporated_pl;
}

}  // namespace rg::test
