// Condensation on the inside of a pane: the cabin's vapour settles where the glass is colder than its dew
// point, and the demister's air, from vents along the lower edge, takes it up again. Independent of the water
// outside.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "saved/archive.h"

namespace rg::glass {

class PaneMap;

// The air on both sides of the glass.
struct FogAir {
  double outside_c = 12.0, outside_humidity = 0.9;
  double outside_mps = 0.0;                     // past the glass
  double cabin_c = 20.0, cabin_humidity = 0.0;  // 0: a cabin without vapour, whose glass never fogs
  double demister = 0.0,
         demister_c = 45.0;  // share of its full flow 0 .. 1; what it blows is outside air, heated
};

// In picolitres since the pane was made. condensed = on_glass + evaporated + drained, to the last one.
struct FogStats {
  int64_t condensed_pl = 0, on_glass_pl = 0, evaporated_pl = 0, drained_pl = 0;
};

// Cells of the pane's grid. Cheap enough to be stepped on the CPU: a few hundred, ten times a second.
class Fog {
 public:
  static constexpr glm::ivec2 kCells{32, 16};

  explicit Fog(const PaneMap& map);
  // Takes vapour and heat a step further. Before the first the glass is as warm as the air without demister
  // has made it.
  void step(const FogAir& air, double seconds);
  void reset();

  bool empty() const { return stats_.on_glass_pl == 0; }
  FogStats stats() const { return stats_; }
  void write(saved::Writer& a) const;
  void read(saved::Reader& a);
  // Water by area, in the order of rows of the grid; cells without glass as their nearest ones.
  double massAt_kg_m2(glm::ivec2 cell) const;
  double glassAt_c(glm::ivec2 cell) const { return cells_[index(cell)].glass_c; }
  // Way up the glass from the vents to a cell's middle.
  double heightAt_m(glm::ivec2 cell) const { return cells_[index(cell)].height_m; }
  double areaAt_m2(glm::ivec2 cell) const { return cells_[index(cell)].area_m2; }
  // Share of each cell that droplets cover, for the picture.
  std::vector<float> covered() const;

 private:
  struct Cell {
    double area_m2 = 0.0;  // 0: off the pane
    double height_m = 0.0;
    double glass_c = 0.0;
    int64_t water_pl = 0;
    double rest_pl = 0.0;  // of a picolitre, not yet condensed or evaporated
    size_t nearest = 0;    // cell with glass
  };
  static void visit(auto& a, auto& cells, auto& stats, auto& begun);
  static size_t index(glm::ivec2 cell) { return static_cast<size_t>(cell.y * kCells.x + cell.x); }
  void stepCell(Cell& cell, const FogAir& air, double seconds);

  std::vector<Cell> cells_;
  FogStats stats_;
  bool begun_ = false;
};

// Share of the glass that condensed droplets cover.
double fogCovered(double mass_kg_m2);

}  // namespace rg::glass
