// How drops move: held by the contact line, pulled by gravity and wind, slowed by their own friction, leaving
// water behind.
#include <algorithm>

#include "glass/drops.h"
#include "glass/random.h"
#include "tick.h"

namespace rg::glass {
namespace {

constexpr int kRestStride = 4;  // as in drops.cpp: drops at rest are looked at every fourth tick
constexpr double kBoundaryLayer_m =
    10e-3;  // thickness of the air's boundary layer on the glass (unsourced); profile: one-seventh power
constexpr double kFastest_mps =
    1.0;  // nothing faster than 0.7 m/s was seen sliding (Li et al. 2023); wind may add
constexpr double kMeander = 0.5;  // tangent of the largest turn that uneven glass gives a path (unsourced)
constexpr int kMostAside = 2;     // texels

// Drag of the wind on a cap: C_D 1 on its outline seen from the side, wind at its height. physics.md 3,
// "depinning by wind".
struct Drag {
  double outline_m2, profile;  // of the free air's speed at the cap's height
  Drag(const Drop& drop, double width_m) {
    const double height_m = static_cast<double>(drop.height_m);
    outline_m2 = 2.0 / 3.0 * height_m * width_m;
    profile = std::pow(std::min(1.0, height_m / kBoundaryLayer_m), 1.0 / 7.0);
  }
  glm::dvec2 at_n(glm::dvec2 air_mps) const {
    const double free_mps = glm::length(air_mps);
    return 0.5 * kRhoAir_kg_m3 * outline_m2 * (free_mps * profile) * free_mps * air_mps /
           std::max(1e-9, free_mps);
  }
};

}  // namespace

void Drops::move(const DropWorld& world) {
  const auto phase = static_cast<int>((world.tick % kRestStride + kRestStride) % kRestStride);
  const int count = static_cast<int>(slots_.items.size());
  for (int slot = 0; slot < count; ++slot) {
    const Drop& drop = slots_.items[static_cast<size_t>(slot)];
    if (drop.volume_pl == 0) continue;
    if (drop.moving || (slot % kRestStride == phase && mayMove(world, drop))) slide(world, slot);
  }
}

// Not where even the greatest forces of its tile together are too weak: most drops, most of the time.
bool Drops::mayMove(const DropWorld& world, const Drop& drop) {
  if (!drop.braced) return true;
  const ForceField::Most& most = world.forces.mostAbout(world.map, drop.place_m);
  const double acceleration = static_cast<double>(most.acceleration_mps2),
               air = static_cast<double>(most.air_mps);
  constexpr double kRounding = 0.999;  // of floats
  return static_cast<double>(drop.acceleration_s2_m) * acceleration +
             static_cast<double>(drop.air2_s2_m2) * air * air >
         kRounding;
}

void Drops::slide(const DropWorld& world, int slot) {
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const Push push = world.forces.at(world.map, drop.place_m);
  const double width_m =
      2.0 * static_cast<double>(drop.base_radius_m) / std::sqrt(static_cast<double>(drop.elongation));
  const double mass_kg = kRho_kg_m3 * cubicMetres(drop.volume_pl);
  const Drag drag(drop, width_m);
  const glm::dvec2 force_n = mass_kg * push.acceleration_mps2 + drag.at_n(push.air_mps);
  const double force = glm::length(force_n);
  const double hold_n = hold_per_m_ * width_m;
  if (!drop.moving && force <= hold_n) {
    drop.braced = true;
    drop.acceleration_s2_m = static_cast<float>(mass_kg / hold_n);
    drop.air2_s2_m2 = static_cast<float>(glm::length(drag.at_n({1.0, 0.0})) / hold_n);
    return;
  }
  drop.braced = false;

  const glm::dvec2 toward = force > 0.0 ? force_n / force : glm::dvec2(0.0);
  // Uneven glass: a turn of the path that depends on the place alone.
  const double turn = kMeander * static_cast<double>(shared::unevenness(world.glass.level(drop.texel)));
  const glm::dvec2 path = (toward + turn * glm::dvec2(-toward.y, toward.x)) / std::sqrt(1.0 + turn * turn);
  const double friction_kg_s = surface_.friction * width_m * kMu_pa_s;
  const double aim_mps = std::min(std::max(0.0, force - hold_n) / friction_kg_s, kFastest_mps);
  const double ease = 1.0 - std::exp(-kTickSeconds * friction_kg_s / mass_kg);
  glm::dvec2 velocity(drop.velocity_mps);
  velocity += (aim_mps * path - velocity) * ease;
  const double speed = glm::length(velocity);
  drop.moving = speed > 1e-3 || force > hold_n;
  if (!drop.moving) velocity = glm::dvec2(0.0);
  drop.velocity_mps = glm::vec2(velocity);
  if (speed < 1e-5) return;

  const glm::dvec2 from_m = drop.place_m;
  moveTo(slot, from_m + velocity / push.metres * kTickSeconds);
  drop.heading = glm::vec2(velocity / speed);
  // Round at rest, twice as long as wide at 0.3 m/s: between the corner and the pearls of Le Grand, Daerr &
  // Limat 2005 (value by eye).
  const double longer = 1.0 + std::min(1.5, speed / 0.3);
  drop.elongation += static_cast<float>((longer - static_cast<double>(drop.elongation)) * ease);
  const int texel = world.map.texelAt(drop.place_m);
  if (overEdge(world, slot, texel)) return;
  if (texel != drop.texel) {
    takeOnTheWay(world, slot, from_m, width_m);
    drop.texel = texel;
  }
  if (!drop.changed) changed_.push_back(slot);
  drop.changed = true;
  leaveTrail(world, drop, speed * kTickSeconds, speed, push.metres);
}

// A fast drop passes more than a texel in a tick.
void Drops::takeOnTheWay(const DropWorld& world, int slot, glm::dvec2 from_m, double width_m) {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const glm::dvec2 way_m = drop.place_m - from_m;
  const double steps = std::ceil(glm::length(way_m) / world.map.grid().texel_m);
  int last = drop.texel;
  for (double step = 1.0; step <= steps; ++step) {
    const glm::dvec2 place_m = from_m + way_m * (step / steps);
    const int texel = world.map.texelAt(place_m);
    if (texel >= 0 && texel != last) takeAcross(world, slot, place_m, width_m);
    last = texel;
  }
}

// What lies across its way at a place: as far to both sides as it is wide.
void Drops::takeAcross(const DropWorld& world, int slot, glm::dvec2 place_m, double width_m) {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const double texel_m = world.map.grid().texel_m;
  const glm::dvec2 side(-drop.heading.y, drop.heading.x);
  const int reach = std::min(static_cast<int>(0.5 * width_m / texel_m + 0.5), kMostAside);
  for (int k = -reach; k <= reach; ++k) {
    const int texel = world.map.texelAt(place_m + k * texel_m * side);
    if (texel < 0 || !world.film.watered(texel)) continue;
    const double share = std::min(1.0, 0.5 * width_m / texel_m + 0.5 - std::abs(k));
    world.film.take(texel, k == 0 ? std::min(1.0, width_m / texel_m) : share, static_cast<uint32_t>(slot),
                    drop.life);
  }
}

// Over the upper edge it is blown off, over any other it drains.
bool Drops::overEdge(const DropWorld& world, int slot, int texel) {
  if (texel >= 0) return false;
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const bool upward = glm::dot(glm::dvec2(drop.heading), world.map.up()) > 0.5;
  (upward ? world.ledger.blown_pl : world.ledger.drained_pl) += remove(slot);
  return true;
}

// A film behind the tail, thicker the faster (Landau & Levich 1942: speed^(2/3)), and pearls.
void Drops::leaveTrail(const DropWorld& world, Drop& drop, double way_m, double speed_mps,
                       glm::dvec2 metres) {
  const double width_m = 2.0 * static_cast<double>(drop.base_radius_m);
  const double film_m = surface_.trail_film_m * std::pow(speed_mps / 0.1, 2.0 / 3.0);
  const int64_t film_pl = std::min(picolitres(film_m * 0.5 * width_m * way_m), drop.volume_pl / 50);
  if (film_pl > 0 && world.film.attached()) {
    drop.volume_pl -= film_pl;
    world.film.add(drop.texel, passed(LeakyKernel::trail, film_pl));
  }
  drop.since_pearl_m += static_cast<float>(way_m);
  leavePearl(world, drop, metres);
  settle(drop);
}

// Tails pinch off droplets of a tenth to a fifth of the width, every few of their own sizes (Podgorski,
// Flesselles & Limat 2001; sizes by eye).
void Drops::leavePearl(const DropWorld& world, Drop& drop, glm::dvec2 metres) {
  const uint32_t h = shared::pcg(drop.seed ^ shared::pcg(static_cast<uint32_t>(drop.texel)));
  const double radius_m =
      static_cast<double>(drop.base_radius_m) * (0.08 + 0.16 * static_cast<double>(shared::unitFloat(h)));
  if (static_cast<double>(drop.since_pearl_m) <
      radius_m * (4.0 + 10.0 * static_cast<double>(shared::unitFloat(shared::pcg(h)))))
    return;
  drop.since_pearl_m = 0.0f;
  const double mean_rad = 0.5 * (surface_.advancing_rad + surface_.receding_rad);
  const int64_t pearl_pl = picolitres(capShape(mean_rad) * radius_m * radius_m * radius_m);
  if (pearl_pl > drop.volume_pl / 20 || pearl_pl < 200) return;
  const double back_m =
      static_cast<double>(drop.base_radius_m) * std::sqrt(static_cast<double>(drop.elongation)) +
      1.5 * radius_m;
  const glm::dvec2 heading(drop.heading);
  const double aside = (static_cast<double>(shared::unitFloat(shared::pcg(h + 1u))) - 0.5) *
                       static_cast<double>(drop.base_radius_m);
  const glm::dvec2 place =
      drop.place_m + (-back_m * heading + aside * glm::dvec2(-heading.y, heading.x)) / metres;
  if (world.map.texelAt(place) < 0) return;
  const int64_t left_pl = passed(LeakyKernel::trail, pearl_pl);
  // Storage does not move: slots are reserved up to the capacity.
  const bool lies = lieAsBead(world, place, left_pl) ||
                    (10 * live_ <= 9 * slots_.capacity_ && add(world, place, left_pl, radius_m, h) >= 0);
  if (lies) drop.volume_pl -= pearl_pl;
}

}  // namespace rg::glass
