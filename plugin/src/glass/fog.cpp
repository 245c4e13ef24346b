#include "glass/fog.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "glass/pane_map.h"
#include "glass/water.h"

namespace rg::glass {
namespace {

// EN 673 (2011), annex: radiation and still air at a window's inner side, W/(m^2 K).
constexpr double kRadiation = 4.4, kStillAir = 3.6;
// Heat that a square metre of a windscreen holds: 5 mm of glass of 2500 kg/m^3, 840 J/(kg K) (usual
// handbook values).
constexpr double kGlassHeat_J_m2K = 5e-3 * 2500.0 * 840.0;
constexpr double kVaporisation_J_kg = 2.47e6;  // at 10 deg C
// Chilton & Colburn (1934): heat and vapour go the same way, h_m = h / (rho c_p Le^(2/3)); of vapour in air
// Le = 0.85.
constexpr double kVapourByHeat_m3K_J = 1.0 / (1.2 * 1006.0 * 0.897);
// A plane wall jet's velocity falls as 3.5 / sqrt(way / slot) (Rajaratnam 1976, Turbulent Jets; from memory),
// and its warmth with it. Slots of 10 mm that blow 5 m/s (unsourced).
constexpr double kJetWhole_m = 3.5 * 3.5 * 10e-3, kJet_mps = 5.0;
constexpr double kMost_kg_m2 = 0.06;  // what is more runs down (unsourced)
// Droplets of some 10 um that meet dirty glass at some 30 degrees hold 1.4 g/m^2 of what they cover; nine
// tenths when they have grown together (both unsourced; bare hydrophobic glass keeps near half, Beysens &
// Knobler 1986).
constexpr double kHeldByCover_kg_m2 = 1.4e-3, kMostCovered = 0.9;
constexpr double kPicolitre_kg = 1e-12;

// Jürges (1924), as McAdams (1954) gives it: heat from a wall to air that blows past, W/(m^2 K).
double blownHeat(double air_mps) {
  return air_mps < 5.0 ? 5.6 + 4.0 * air_mps : 7.2 * std::pow(air_mps, 0.78);
}

double jetShare(const FogAir& air, double height_m) {
  return air.demister * std::min(1.0, std::sqrt(kJetWhole_m / std::max(height_m, kJetWhole_m)));
}

double kelvin(double celsius) { return celsius + 273.15; }

}  // namespace

double fogCovered(double mass_kg_m2) {
  return kMostCovered * (1.0 - std::exp(-mass_kg_m2 / kHeldByCover_kg_m2));
}

Fog::Fog(const PaneMap& map) : cells_(static_cast<size_t>(kCells.x * kCells.y)) {
  std::vector<double> height(cells_.size(), 0.0);
  double lowest = std::numeric_limits<double>::max();
  const glm::ivec2 size = map.grid().size;
  for (int i = 0; i < map.texelCount(); ++i) {
    if (!map.inside(i)) continue;
    const glm::ivec2 at(i % size.x, i / size.x);
    const size_t k = index(at * kCells / size);
    const double up_m = map.glassFromGrid(map.middleOf(i)).y,
                 area_m2 = static_cast<double>(map.texel(i).area_m2);
    cells_[k].area_m2 += area_m2;
    height[k] += up_m * area_m2;
    lowest = std::min(lowest, up_m);
  }
  for (size_t k = 0; k < cells_.size(); ++k) {
    if (cells_[k].area_m2 > 0.0) cells_[k].height_m = height[k] / cells_[k].area_m2 - lowest;
  }
  for (size_t k = 0; k < cells_.size(); ++k) {
    const glm::ivec2 here(static_cast<int>(k) % kCells.x, static_cast<int>(k) / kCells.x);
    int least = std::numeric_limits<int>::max();
    for (size_t other = 0; other < cells_.size(); ++other) {
      const glm::ivec2 away =
          glm::ivec2(static_cast<int>(other) % kCells.x, static_cast<int>(other) / kCells.x) - here;
      const int distance = away.x * away.x + away.y * away.y;
      if (cells_[other].area_m2 <= 0.0 || distance >= least) continue;
      least = distance;
      cells_[k].nearest = other;
    }
  }
}

void Fog::reset() {
  for (Cell& cell : cells_) {
    cell.water_pl = 0;
    cell.rest_pl = 0.0;
  }
  stats_ = {};
  begun_ = false;
}

void Fog::step(const FogAir& air, double seconds) {
  if (!begun_) {
    const double out = blownHeat(air.outside_mps) + kRadiation, in = kRadiation + kStillAir;
    for (Cell& cell : cells_) cell.glass_c = (out * air.outside_c + in * air.cabin_c) / (out + in);
    begun_ = true;
  }
  for (Cell& cell : cells_) {
    if (cell.area_m2 > 0.0) stepCell(cell, air, seconds);
  }
}

void Fog::stepCell(Cell& cell, const FogAir& air, double seconds) {
  const double jet = jetShare(air, cell.height_m);
  const double convection = kStillAir + 4.0 * kJet_mps * jet;
  const double cabin_vapour = air.cabin_humidity * saturatedVapour_kg_m3(air.cabin_c);
  const double jet_vapour = air.outside_humidity * saturatedVapour_kg_m3(air.outside_c) *
                            kelvin(air.outside_c) / kelvin(air.demister_c);
  const double air_c = std::lerp(air.cabin_c, air.demister_c, jet);
  const double vapour = std::lerp(cabin_vapour, jet_vapour, jet);

  const double wanted_kg_m2s =
      convection * kVapourByHeat_m3K_J * (vapour - saturatedVapour_kg_m3(cell.glass_c));
  const double wanted_pl = wanted_kg_m2s * seconds * cell.area_m2 / kPicolitre_kg + cell.rest_pl;
  const double least_pl = -static_cast<double>(cell.water_pl);
  const double change_pl = wanted_pl > least_pl ? std::trunc(wanted_pl) : least_pl;
  cell.rest_pl = wanted_pl > least_pl ? wanted_pl - change_pl : 0.0;
  const auto change = static_cast<int64_t>(change_pl);
  cell.water_pl += change;
  (change > 0 ? stats_.condensed_pl : stats_.evaporated_pl) += std::abs(change);
  const auto most = static_cast<int64_t>(kMost_kg_m2 * cell.area_m2 / kPicolitre_kg);
  const int64_t drained = std::max<int64_t>(cell.water_pl - most, 0);
  cell.water_pl -= drained;
  stats_.drained_pl += drained;
  stats_.on_glass_pl += change - drained;

  const double latent_W_m2 = change_pl * kPicolitre_kg / (cell.area_m2 * seconds) * kVaporisation_J_kg;
  const double heat_W_m2 = (blownHeat(air.outside_mps) + kRadiation) * (air.outside_c - cell.glass_c) +
                           kRadiation * (air.cabin_c - cell.glass_c) + convection * (air_c - cell.glass_c) +
                           latent_W_m2;
  cell.glass_c += heat_W_m2 * seconds / kGlassHeat_J_m2K;
}

void Fog::visit(auto& a, auto& cells, auto& stats, auto& begun) {
  constexpr int64_t kMost_pl = INT64_C(1) << 60;
  a(begun);
  a.within(stats.condensed_pl, 0, kMost_pl), a.within(stats.on_glass_pl, 0, kMost_pl);
  a.within(stats.evaporated_pl, 0, kMost_pl), a.within(stats.drained_pl, 0, kMost_pl);
  for (auto& cell : cells) {
    a.within(cell.glass_c, -200.0, 200.0);
    a.within(cell.water_pl, 0, kMost_pl >> 10);
    a.within(cell.rest_pl, -1.0, 1.0);
  }
}

void Fog::write(saved::Writer& a) const { visit(a, cells_, stats_, begun_); }

void Fog::read(saved::Reader& a) {
  std::vector<Cell> cells = cells_;
  FogStats stats;
  bool begun = false;
  visit(a, cells, stats, begun);
  int64_t sum_pl = 0;
  for (const Cell& cell : cells) sum_pl += cell.water_pl;
  a.require(stats.on_glass_pl == sum_pl &&
                stats.condensed_pl == stats.on_glass_pl + stats.evaporated_pl + stats.drained_pl,
            "the fog's ledger does not close");
  if (!a.commits()) return;
  cells_ = std::move(cells);
  stats_ = stats;
  begun_ = begun;
}

double Fog::massAt_kg_m2(glm::ivec2 cell) const {
  const Cell& glass = cells_[cells_[index(cell)].nearest];
  return static_cast<double>(glass.water_pl) * kPicolitre_kg / glass.area_m2;
}

std::vector<float> Fog::covered() const {
  std::vector<float> shares;
  for (int y = 0; y < kCells.y; ++y) {
    for (int x = 0; x < kCells.x; ++x) shares.push_back(static_cast<float>(fogCovered(massAt_kg_m2({x, y}))));
  }
  return shares;
}

}  // namespace rg::glass
