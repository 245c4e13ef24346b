#include "glass/blades.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "glass/run_on.h"
#include "tick.h"

namespace rg::glass {
namespace {
constexpr double kMostTurn = 2.0;
constexpr double kAbout = 1.1;  // texels: so near to any place there are three or four texels' middles
}  // namespace

void Blades::set(uint32_t id, const WiperInfo& info, const PaneMap& map, FilmLink& film) {
  const bool sound = info.arm_m >= 0.01 && info.arm_m < 5.0 && info.blade_m > 0.0 && info.blade_m < 5.0 &&
                     std::isfinite(info.blade_angle_rad) && info.residual_film_m >= 0.0 &&
                     info.residual_film_m <= 1e-4 && std::abs(info.blade_turn) <= kMostTurn &&
                     info.wear >= 0.0 && info.wear <= 1.0 && info.lift_m > 0.0 &&
                     std::abs(glm::length(info.axis) - 1.0) < 1e-3 &&
                     std::abs(glm::length(info.rest_direction) - 1.0) < 1e-3 &&
                     std::abs(glm::dot(info.axis, info.rest_direction)) < 1e-2;
  if (!sound)
    throw std::invalid_argument(
        "wiper " + std::to_string(id) +
        ": arm, blade, axis, rest direction, turn, wear, lift or residual film out of range");
  remove(id, film);
  int slot = 0;
  while (std::any_of(blades_.begin(), blades_.end(),
                     [slot](const auto& b) { return b.second.wiper->slot() == slot; }))
    ++slot;
  if (slot >= shared::kMaxGlassWipers)
    throw std::invalid_argument("wiper " + std::to_string(id) + ": a pane has at most 8 wipers");
  Blade& blade = blades_[id];
  blade.wiper = std::make_unique<Wiper>(info, map, slot, id);
}

void Blades::remove(uint32_t id, FilmLink& film) {
  const auto it = blades_.find(id);
  if (it == blades_.end()) return;
  layDown(film, it->second, nullptr);
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
  // Where it turns round within the tick it is shown standing.
  blade.speed_radps =
      stroke.extreme_rad == stroke.to_rad ? (stroke.to_rad - stroke.from_rad) / kTickSeconds : 0.0;
  move(world, drops, blade, stroke.extreme_rad);
  move(world, drops, blade, stroke.to_rad);
  blade.fastest_radps = std::max(blade.fastest_radps, std::abs(blade.speed_radps));
  if (stroke.from_rad == stroke.to_rad && stroke.extreme_rad == stroke.to_rad) {
    turn(world, blade);  // it stopped
  } else {
    leaveOffGlass(world.film, blade);
  }
}

std::vector<MovingBlade> Blades::moving() const {
  std::vector<MovingBlade> out;
  for (const auto& [id, blade] : blades_) {
    if (blade.direction == 0.0) continue;
    out.push_back({blade.wiper->info(), blade.angle_rad, blade.speed_radps, blade.direction,
                   blade.wiper->slot() * shared::kBladeSegments});
  }
  return out;
}

// Told with each blade: what it is, so that a state of other wipers is known as such.
void Blades::write(saved::Writer& a) const {
  const auto count = static_cast<uint32_t>(blades_.size());
  a(count);
  for (const auto& [id, blade] : blades_) {
    const uint64_t what = blade.wiper->fingerprint();
    a(id, what, blade);
  }
}

void Blades::read(saved::Reader& a) {
  uint32_t count = 0;
  a(count);
  a.require(count == blades_.size(), "it has other wipers; set them as they were, in the same order");
  for (auto& [known_id, known] : blades_) {
    uint32_t id = 0;
    uint64_t what = 0;
    Blade blade;
    a(id, what, blade);
    if (id != known_id || what != known.wiper->fingerprint())
      a.refuse("wiper " + std::to_string(known_id) +
               " is another; set wipers as they were, in the same order");
    if (!a.commits()) continue;
    blade.wiper = std::move(known.wiper);
    known = std::move(blade);
  }
}

std::shared_ptr<const std::vector<shared::SweptTexel>> Blades::sweptBy(int first_piece) const {
  for (const auto& [id, blade] : blades_) {
    if (blade.wiper->slot() * shared::kBladeSegments == first_piece) return blade.wiper->swept();
  }
  return nullptr;
}

// One way without reversal.
void Blades::move(const DropWorld& world, Drops& drops, Blade& blade, double to_rad) {
  const Sweep sweep{blade.angle_rad, to_rad};
  if (sweep.before_rad == sweep.now_rad) return;
  const double direction = to_rad > blade.angle_rad ? 1.0 : -1.0;
  if (blade.direction != 0.0 && direction != blade.direction) turn(world, blade);
  if (blade.direction == 0.0) blade.began_rad = blade.angle_rad;
  blade.direction = direction;
  blade.angle_rad = to_rad;
  const Wiper& wiper = *blade.wiper;
  world.film.sweep(wiper.swept(), wiper.ranges(sweep), wiper.slot() * shared::kBladeSegments,
                   direction < 0.0);
  findMet(drops, wiper, sweep);
  for (size_t word = 0; word < met_.words(); ++word)
    forEachSlot(word, met_.word(word), [&](int slot) { meet(world, drops, wiper, sweep, slot); });
}

// Drops that the blade may cross, which is to be told by the place of each: few of all that there are.
void Blades::findMet(const Drops& drops, const Wiper& wiper, const Sweep& sweep) {
  const SweptStrip strip = wiper.stripOf(sweep);
  met_.clear();
  for (const TileInPlane& tile : wiper.tiles()) {
    if (!tile.isNear(strip, static_cast<double>(drops.widest_m()))) continue;
    drops.forEachIn(tile.low_m, tile.high_m, [&](int slot, glm::vec2 place_m, float half_m) {
      if (tile.mayCross(strip, glm::dvec2(place_m), static_cast<double>(half_m))) met_.put(slot, true);
    });
  }
}

// A drop is met as the blade's line, longer by the drop's radius, passes its middle. What stands above the
// blade's lift stays behind as a smaller drop. The rest becomes film over the drop's base, or the next texel
// the blade comes to, for the sweeps of this step and the next to take: so a blade that passes over a part of
// it takes that part. What it has passed already is in its ridge.
void Blades::meet(const DropWorld& world, Drops& drops, const Wiper& wiper, const Sweep& sweep, int slot) {
  const Drop& drop = drops.all()[static_cast<size_t>(slot)];
  const glm::dvec2 middle_m = drop.place_m;
  const auto place = world.map.vehicleFromGrid(middle_m);
  if (!place) return;
  const double radius_m = static_cast<double>(drop.base_radius_m);
  const Crossings c = wiper.crossingsAt(*place, radius_m);
  int k = 0;
  while (k < c.count && !sweep.covers(c.angle_rad[k])) ++k;
  if (k == c.count) return;
  const glm::dvec2 metres = world.forces.at(world.map, middle_m).metres;
  const Footprint base = world.film.within(middle_m, metres, radius_m);
  const bool small = base.count < 2;  // than a texel
  if (small && std::abs(c.along_m[k]) > 0.5 * wiper.info().blade_m) return;

  const double e = static_cast<double>(drop.elongation);
  const double above_m3 =
      e * capVolumeAbove(static_cast<double>(drop.height_m), radius_m / std::sqrt(e), wiper.info().lift_m);
  const int64_t taken_pl = drops.cut(slot, std::min(picolitres(above_m3), drop.volume_pl));
  const auto ahead_rad = [&](int texel) { return wiper.ahead_rad(texel, sweep, c.angle_rad[k]); };
  int64_t carried_pl = taken_pl;
  const auto give = [&](int texel, int64_t volume_pl) {
    world.film.add(texel, volume_pl);
    carried_pl -= volume_pl;
  };
  if (world.film.attached() && small) {
    const Footprint about = world.film.within(middle_m, metres, kAbout * world.map.grid().texel_m);
    int next = -1;
    double least_rad = 1e9;
    for (size_t i = 0; i < about.count; ++i) {
      const double rad = ahead_rad(about.texels[i]).value_or(-1.0);
      if (rad <= 0.0 || rad >= least_rad) continue;
      least_rad = rad;
      next = about.texels[i];
    }
    if (next >= 0) give(next, taken_pl);
  } else if (world.film.attached()) {
    for (size_t i = 0; i < base.count; ++i) {
      if (ahead_rad(base.texels[i]).value_or(1.0) > 0.0) give(base.texels[i], base.share(i, taken_pl));
    }
  }
  if (carried_pl > 0) world.film.addToRidge(wiper.slot() * shared::kBladeSegments + c.segment[k], carried_pl);
}

// The blade turns round or stops where it is.
void Blades::turn(const DropWorld& world, Blade& blade) {
  layDown(world.film, blade, &world.surface);
  blade.began_rad = blade.angle_rad;
  blade.fastest_radps = 0.0;
}

// The ridge stays where the blade is, or, after a way of the blade over such a surface, runs on over the
// pane's edge.
void Blades::layDown(FilmLink& film, Blade& blade, const Surface* surface) {
  if (blade.direction == 0.0) return;
  const Wiper& wiper = *blade.wiper;
  const auto ahead = wiper.aheadOf(blade.angle_rad, blade.direction);
  const double half_rad = 0.5 * std::abs(blade.angle_rad - blade.began_rad);
  const double piece_m = wiper.info().blade_m / shared::kBladeSegments;
  for (int segment = 0; segment < shared::kBladeSegments; ++segment) {
    int32_t over_edge_pl = kNeverRunsOn;
    if (surface != nullptr && half_rad > 0.0) {
      const PieceStroke stroke{half_rad * wiper.turnsAt_m(segment, blade.angle_rad),
                               blade.fastest_radps / half_rad};
      const double edge_m = wiper.toEdge_rad(segment, blade.angle_rad, blade.direction) *
                            wiper.turnsAt_m(segment, blade.angle_rad);
      over_edge_pl = leastToRunOn_pl(edge_m, piece_m, stroke, *surface);
    }
    film.leave(wiper.slot() * shared::kBladeSegments + segment, ahead[static_cast<size_t>(segment)],
               over_edge_pl, wiper.edgeTexel(segment, blade.direction));
  }
  blade.direction = 0.0;
}

// Pieces of the blade that have passed the pane's edge throw their water off.
void Blades::leaveOffGlass(FilmLink& film, const Blade& blade) {
  for (int segment = 0; segment < shared::kBladeSegments; ++segment) {
    if (blade.wiper->offGlass(segment, blade.angle_rad))
      film.leave(blade.wiper->slot() * shared::kBladeSegments + segment, {}, kNeverRunsOn,
                 blade.wiper->edgeTexel(segment, blade.direction));
  }
}

}  // namespace rg::glass
