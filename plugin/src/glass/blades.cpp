#include "glass/blades.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rg::glass {

void Blades::set(uint32_t id, const WiperInfo& info, const PaneMap& map, FilmLink& film) {
  const bool sound = info.arm_m >= 0.01 && info.arm_m < 5.0 && info.blade_m > 0.0 && info.blade_m < 5.0 &&
                     std::isfinite(info.blade_angle_rad) && info.residual_film_m >= 0.0 &&
                     info.residual_film_m <= 1e-4 && std::abs(glm::length(info.axis) - 1.0) < 1e-3 &&
                     std::abs(glm::length(info.rest_direction) - 1.0) < 1e-3 &&
                     std::abs(glm::dot(info.axis, info.rest_direction)) < 1e-2;
  if (!sound)
    throw std::invalid_argument("wiper " + std::to_string(id) +
                                ": arm, blade, axis, rest direction or residual film out of range");
  remove(id, film);
  int slot = 0;
  while (std::any_of(blades_.begin(), blades_.end(),
                     [slot](const auto& b) { return b.second.wiper->slot() == slot; }))
    ++slot;
  if (slot >= shared::kMaxGlassWipers)
    throw std::invalid_argument("wiper " + std::to_string(id) + ": a pane has at most 8 wipers");
  Blade& blade = blades_[id];
  blade.wiper = std::make_unique<Wiper>(info, map, slot);
}

void Blades::remove(uint32_t id, FilmLink& film) {
  const auto it = blades_.find(id);
  if (it == blades_.end()) return;
  turn(film, it->second);
  blades_.erase(it);
}

void Blades::clear() {
  for (auto& [id, blade] : blades_) blade.direction = 0.0;
}

void Blades::stroke(const DropWorld& world, Drops& drops, const WiperStroke& stroke) {
  const auto it = blades_.find(stroke.wiper);
  if (it == blades_.end()) return;
  Blade& blade = it->second;
  blade.angle_rad = stroke.from_rad;
  move(world, drops, blade, stroke.extreme_rad);
  move(world, drops, blade, stroke.to_rad);
  if (stroke.from_rad == stroke.to_rad && stroke.extreme_rad == stroke.to_rad) {
    turn(world.film, blade);  // it stopped
  } else {
    leaveOffGlass(world.film, blade);
  }
}

// One way without reversal.
void Blades::move(const DropWorld& world, Drops& drops, Blade& blade, double to_rad) {
  const Sweep sweep{blade.angle_rad, to_rad};
  if (sweep.before_rad == sweep.now_rad) return;
  const double direction = to_rad > blade.angle_rad ? 1.0 : -1.0;
  if (blade.direction != 0.0 && direction != blade.direction) turn(world.film, blade);
  blade.direction = direction;
  blade.angle_rad = to_rad;
  const Wiper& wiper = *blade.wiper;
  const auto [first, last] = wiper.range(sweep);
  const double texel_area_m2 = world.map.grid().texel_m * world.map.grid().texel_m;
  world.film.sweep({wiper.swept(), first, last - first,
                    static_cast<int>(picolitres(wiper.info().residual_film_m * texel_area_m2))});
  const std::vector<Drop>& all = drops.all();
  for (size_t slot = 0; slot < all.size(); ++slot) {
    const Drop& drop = all[slot];
    if (drop.volume_pl == 0 || !wiper.mayCross(drop.texel, sweep)) continue;
    const auto place = world.map.vehicleFromGrid(drop.place_m);
    if (!place) continue;
    const Crossings c = wiper.crossingsAt(*place);
    for (int k = 0; k < c.count; ++k) {
      if (!sweep.covers(c.angle_rad[k])) continue;
      const int segment = wiper.slot() * shared::kBladeSegments + c.segment[k];
      world.film.addToRidge(segment, drops.remove(static_cast<int>(slot)));
      break;
    }
  }
}

// The blade turns round or stops where it is: its ridge stays there.
void Blades::turn(FilmLink& film, Blade& blade) {
  if (blade.direction == 0.0) return;
  const auto ahead = blade.wiper->aheadOf(blade.angle_rad, blade.direction);
  for (int segment = 0; segment < shared::kBladeSegments; ++segment) {
    film.leave(blade.wiper->slot() * shared::kBladeSegments + segment, ahead[static_cast<size_t>(segment)]);
  }
  blade.direction = 0.0;
}

// Pieces of the blade that have passed the pane's edge throw their water off.
void Blades::leaveOffGlass(FilmLink& film, const Blade& blade) {
  for (int segment = 0; segment < shared::kBladeSegments; ++segment) {
    if (blade.wiper->offGlass(segment, blade.angle_rad))
      film.leave(blade.wiper->slot() * shared::kBladeSegments + segment, {});
  }
}

}  // namespace rg::glass
