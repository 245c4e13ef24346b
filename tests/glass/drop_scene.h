// Drops on a pane by themselves, for tests of their laws and shapes.
#pragma once

#include "scene.h"

namespace rg::test {

// Drops alone, without GL: what they give to a film is booked as drained.
struct DropScene {
  DropScene(double slope_rad, glass::Glass glass, uint32_t max_drops = 5000)
      : mesh(windscreen(0.6, 0.4, slope_rad)) {
    glass::PaneInfo info = paneInfo(mesh);
    info.glass = glass;
    info.max_drops = max_drops;
    info.unevenness = 0.0;  // the laws are those of even glass
    sim = std::make_unique<glass::PaneSim>(info, 1, 7);
  }
  void run(const glass::PaneTick& weather, double seconds) {
    const auto ticks = std::llround(seconds / kTickSeconds);
    for (int64_t i = 0; i < ticks; ++i) {
      glass::PaneTick tick = weather;
      tick.index = ++index;
      sim->submit(tick);
    }
  }
  void place(double u_m, double v_m, double radius_m, double angle_rad) {
    const glass::PlacedDrop drop{u_m, v_m, radius_m, angle_rad};
    sim->placeDrops({&drop, 1});
  }
  Mesh mesh;
  std::unique_ptr<glass::PaneSim> sim;
  int64_t index = 0;
};

}  // namespace rg::test
