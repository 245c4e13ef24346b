#include "glass/craters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "glass/water.h"
#include "tick.h"

namespace rg::glass {
namespace {

constexpr double kCell_m = 10e-3;       // one crater to a cell: as wide as that of a large drop
constexpr double kLeastWidth = 1.0;     // texels; the film's picture cannot show smaller ones
constexpr double kLeastFilm_m = 10e-6;  // a thinner one hardly bends a view, and stands still (unsourced)
constexpr float kSeenSlope = 2.8e-4f;   // one minute of arc, see physics.md 6

// Waves travel with dq/dh of a film's flow q (physics.md 4).
glm::dvec2 waveVelocity_mps(const Push& push, const glm::dvec2& shear_pa, double film_m) {
  return (push.acceleration_mps2 * (kRho_kg_m3 * film_m) + shear_pa) * (film_m / kMu_pa_s);
}

// How much of one is to be seen: what it displaces, but for a factor.
float displaced_m3(const shared::CraterRecord& crater, double age_s) {
  const auto age = static_cast<float>(age_s);
  const float width_m = shared::craterWidth_m(crater, age);
  return crater.film_m * shared::craterDepthLeft(crater, age) * width_m * width_m;
}

bool isSeen(const shared::CraterRecord& crater, double age_s) {
  const auto age = static_cast<float>(age_s);
  return crater.film_m * shared::craterDepthLeft(crater, age) >
         kSeenSlope * shared::craterWidth_m(crater, age);
}

}  // namespace

void Craters::Crater::visit(auto& a, auto& crater) {
  constexpr int64_t kMostTicks = INT64_C(1) << 40;
  auto& r = crater.record;
  a.within(crater.tick, -kMostTicks, kMostTicks);
  a.within(r.position_m, 0.0, 100.0);
  a(r.velocity_mps);
  a.within(r.width_m, 0.0, 1.0), a.within(r.film_m, 0.0, 1.0);
  a.within(r.filling_hz, 0.0, 1e9), a.within(r.levelling_m4_s, 0.0, 1e9);
}

void Craters::write(saved::Writer& a) const { a.list(craters_, craters_.size()); }

void Craters::read(saved::Reader& a) {
  std::vector<Crater> craters;
  a.list(craters, of_cell_.size());
  if (!a.commits()) return;
  clear();
  craters_ = std::move(craters);
  findCells();
}

Craters::Craters(const PaneMap& map)
    : map_(map), cell_count_(glm::ceil(glm::dvec2(map.grid().size) * map.grid().texel_m / kCell_m)) {
  clear();
}

void Craters::clear() {
  craters_.clear();
  findCells();
}

void Craters::findCells() {
  of_cell_.assign(static_cast<size_t>(cell_count_.x * cell_count_.y), -1);
  for (size_t i = 0; i < craters_.size(); ++i) of_cell_[cellOf(craters_[i])] = static_cast<int32_t>(i);
}

size_t Craters::cellOf(const Crater& crater) const {
  const glm::dvec2 place_m(crater.record.position_m);
  const glm::ivec2 cell = glm::clamp(glm::ivec2(place_m / kCell_m), glm::ivec2(0), cell_count_ - 1);
  return static_cast<size_t>(cell.y * cell_count_.x + cell.x);
}

double Craters::ageOf_s(const Crater& crater, int64_t tick) {
  return static_cast<double>(tick - crater.tick) * kTickSeconds;
}

void Craters::add(const Impact& impact, double film_m, const ForceField& forces, int64_t tick) {
  // The shape crosses the film's level at sqrt(2) of its width.
  const double width_m = lamellaRadius_m(impact) / std::numbers::sqrt2;
  if (film_m < kLeastFilm_m || width_m < kLeastWidth * map_.grid().texel_m) return;
  const Push push = forces.at(map_, impact.place_m);
  Crater crater;
  crater.tick = tick;
  crater.record.position_m = glm::vec2(impact.place_m);
  const glm::dvec2 waves_mps = waveVelocity_mps(push, forces.shear_pa(push.air_mps), film_m);
  crater.record.velocity_mps = glm::vec2(waves_mps / push.metres);
  crater.record.filling_hz = static_cast<float>(glm::length(waves_mps) / width_m);
  crater.record.width_m = static_cast<float>(width_m);
  crater.record.film_m = static_cast<float>(film_m);
  crater.record.levelling_m4_s = shared::craterLevelling_m4_s(crater.record.film_m);
  if (!isSeen(crater.record, 0.0)) return;
  int32_t& known = of_cell_[cellOf(crater)];
  if (known >= 0) {
    Crater& before = craters_[static_cast<size_t>(known)];
    if (displaced_m3(crater.record, 0.0) > displaced_m3(before.record, ageOf_s(before, tick)))
      before = crater;
    return;
  }
  known = static_cast<int32_t>(craters_.size());
  craters_.push_back(crater);
}

void Craters::forget(int64_t tick) {
  const auto isGone = [tick](const Crater& crater) { return !isSeen(crater.record, ageOf_s(crater, tick)); };
  if (std::erase_if(craters_, isGone) > 0) findCells();
}

std::vector<shared::CraterRecord> Craters::at(int64_t tick) const {
  std::vector<shared::CraterRecord> out;
  out.reserve(craters_.size());
  for (const Crater& crater : craters_) {
    const double age_s = ageOf_s(crater, tick);
    if (!isSeen(crater.record, age_s)) continue;
    out.push_back(crater.record);
    out.back().age_s = static_cast<float>(age_s);
  }
  return out;
}

}  // namespace rg::glass
