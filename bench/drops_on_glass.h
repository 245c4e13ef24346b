// A raked windscreen with drops, one in twenty of them so large that it slides.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "glass/pane.h"
#include "shared/hash.glsl"

namespace bench {

inline constexpr double kWidth_m = 1.5, kHeight_m = 0.8, kSlope_rad = std::numbers::pi / 6.0;
inline constexpr uint32_t kOneInSlides = 20;

// In cells of a grid, off their middles, so that hardly two touch.
inline std::vector<rg::glass::PlacedDrop> dropsOnGlass(int number) {
  const auto unit = [](uint32_t i, uint32_t what) {
    return static_cast<double>(rg::shared::unitFloat(rg::shared::pcg(i + rg::shared::pcg(what))));
  };
  const double cell_m = std::sqrt(kWidth_m * kHeight_m / number) * 0.98;
  const int columns = static_cast<int>(kWidth_m / cell_m);
  std::vector<rg::glass::PlacedDrop> placed;
  for (int i = 0; i < number; ++i) {
    const auto n = static_cast<uint32_t>(i);
    const bool slides = n % kOneInSlides == 0;
    rg::glass::PlacedDrop drop;
    const int column = i % columns, row = i / columns;
    drop.u_m = (column + 0.35 + 0.3 * unit(n, 1)) * cell_m - 0.5 * columns * cell_m;
    drop.v_m = (row + 0.35 + 0.3 * unit(n, 2)) * cell_m - 0.49 * kHeight_m;
    drop.base_radius_m = slides ? 3.0e-3 + 0.5e-3 * unit(n, 3) : 0.4e-3 + 0.6e-3 * unit(n, 4);
    drop.contact_angle_rad = slides ? 0.9 : 0.6;
    placed.push_back(drop);
  }
  return placed;
}

// Marshall & Palmer's drops of 0.5 .. 6 mm, scaled to bring the rate (physics.md 1).
inline void setRain(rg::glass::PaneTick& tick, double rate_mm_h) {
  constexpr int kClasses = 32;
  constexpr double kStep_mm = 5.5 / kClasses;
  const double slope_per_mm = 4.1 * std::pow(rate_mm_h, -0.21);
  double brought_mps = 0.0;
  tick.class_count = kClasses;
  for (int i = 0; i < kClasses; ++i) {
    const double d_mm = 0.5 + (i + 0.5) * kStep_mm;
    rg::glass::SizeClass& size = tick.classes[static_cast<size_t>(i)];
    size.diameter_m = 1e-3 * d_mm;
    size.number_per_m3 = 8000.0 * std::exp(-slope_per_mm * d_mm) * kStep_mm;
    size.fall_speed_mps = 9.65 - 10.3 * std::exp(-0.6 * d_mm);
    brought_mps +=
        size.number_per_m3 * size.fall_speed_mps * std::numbers::pi / 6.0 * std::pow(size.diameter_m, 3.0);
  }
  for (int i = 0; i < kClasses; ++i)
    tick.classes[static_cast<size_t>(i)].number_per_m3 *= rate_mm_h / 3.6e6 / brought_mps;
}

// Room for twice as many. Refers to static data.
inline rg::glass::PaneInfo windscreenInfo(int drops) {
  static const glm::vec3 across(0.0f, -kWidth_m, 0.0f);
  static const glm::vec3 up(-kHeight_m * std::cos(kSlope_rad), 0.0f, kHeight_m * std::sin(kSlope_rad));
  static const std::array<glm::vec3, 4> corners{glm::vec3(0.0f), across, across + up, up};
  static const std::array<glm::vec2, 4> uvs{glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}};
  static const std::array<uint32_t, 6> indices{0, 2, 1, 0, 3, 2};
  rg::glass::PaneInfo info;
  info.name = "windscreen";
  info.positions_m = corners;
  info.uvs = uvs;
  info.indices = indices;
  info.max_drops = static_cast<uint32_t>(2 * drops);
  return info;
}

}  // namespace bench
