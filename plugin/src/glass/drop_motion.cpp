// How drops move: held by the contact line, pulled by gravity and wind, slowed by their own friction, leaving
// water behind.
#include <algorithm>

#include "glass/drop_shape.h"
#include "glass/drops.h"
#include "glass/random.h"
#include "tick.h"

namespace rg::glass {
namespace {

constexpr int kRestStride = 4;  // drops at rest are looked at every fourth tick: ...
constexpr uint64_t kEveryFourth =
    0x1111111111111111u;  // ... each slot of a word by itself, or a word at once
// Thickness of the air's boundary layer on the glass, by eye: Prandtl's 0.37 x Re^-1/5 is 10.6 mm at 0.4 m
// from its edge and 20 m/s; profile: one-seventh power.
constexpr double kBoundaryLayer_m = 10e-3;
constexpr double kFastest_mps =
    1.0;  // nothing faster than 0.7 m/s was seen sliding (Li et al. 2023); wind may add
constexpr double kMeander = 0.5;  // tangent of the largest turn that uneven glass gives a path (unsourced)
constexpr int kMostAside = 2;     // texels
constexpr float kSmallestPearl = 0.08f;  // of the radius

// In single precision, which is enough for what they tell: they are worked out for each drop that moves.
float power(float base, float exponent) { return std::pow(base, exponent); }
float exponential(double x) { return std::exp(static_cast<float>(x)); }

// Drag of the wind on a cap: C_D 1 on its outline seen along the wind, wind at its height. physics.md 3,
// "depinning by wind".
struct Drag {
  double height_m, share2;  // of the free air's speed at the cap's height, its square
  explicit Drag(const Drop& drop) : height_m(static_cast<double>(drop.height_m)) {
    share2 = static_cast<double>(
        power(static_cast<float>(std::min(1.0, height_m / kBoundaryLayer_m)), 2.0f / 7.0f));
  }
  double perSquare_n(double width_m) const {  // of air of 1 m/s
    return 0.5 * kRhoAir_kg_m3 * capOutline_m2(height_m, 0.5 * width_m) * share2;
  }
};

// Axes have no sign: twice their angle tells them apart, and half of it is one of two directions.
glm::dvec2 twiceTurned(glm::dvec2 v) { return {v.x * v.x - v.y * v.y, 2.0 * v.x * v.y}; }
glm::dvec2 halfTurned(glm::dvec2 v, glm::dvec2 near) {
  const glm::dvec2 half(1.0 + v.x, v.y);
  const glm::dvec2 axis = v.x > -1.0 + 1e-12 ? glm::normalize(half) : glm::dvec2(0.0, 1.0);
  return glm::dot(axis, near) < 0.0 ? -axis : axis;
}

}  // namespace

void Drops::move(const DropWorld& world) {
  over_edges_.clear();
  const auto phase = static_cast<size_t>((world.tick % kRestStride + kRestStride) % kRestStride);
  for (size_t word = 0; word * SlotSet::kInWord < slots_.items.size(); ++word) {
    uint64_t bits = moving_.word(word) | (uneasy_.word(word) & (kEveryFourth << phase));
    if (word % kRestStride == phase) {
      forEachSlot(word, braced_.word(word), [&](int slot) {
        if (mayMove(world, slot)) bits |= uint64_t{1} << (slot % SlotSet::kInWord);
      });
    }
    // What moves lies anywhere in memory: it is asked for before it is waited for.
    forEachSlot(word + 2, moving_.word(word + 2), [&](int slot) { fetch(slot); });
    forEachSlot(word + 1, moving_.word(word + 1), [&](int slot) {
      const int texel = slots_.items[static_cast<size_t>(slot)].texel;
      world.glass.fetch(texel);
      world.film.fetch(texel);
    });
    forEachSlot(word, bits, [&](int slot) { slide(world, slot); });
  }
}

// Share of the glass that a film leaves dry. What is told of a film is its mean over some 5 cm: where that is
// little, a part is wet and the rest dry.
double Drops::dryShare(double film_m) const {
  return std::clamp(2.0 - 2.0 * film_m / surface_.wetting_m, 0.0, 1.0);
}

// Share of the hold that dry glass has on a drop: where a film lies there is no contact line to hold it.
double Drops::heldBy(double film_m) const {
  constexpr double kLeast = 0.02;  // by eye: so much holds even then
  return std::max(dryShare(film_m), kLeast);
}

// Most panes have no film so thick, and no drop there has to be told what it lies on.
double Drops::heldAt(const DropWorld& world, int texel) const {
  return filmLetsGo(world) ? heldBy(world.film.thickness_m(texel)) : 1.0;
}

// Not where even the greatest forces of its tile together are too weak and all of them are what they were
// when it took its shape: most drops, most of the time.
bool Drops::mayMove(const DropWorld& world, int slot) const {
  constexpr float kRounding = 0.999f;
  constexpr float kOther = 0.03f;  // makes one of the mean contact angle 0.014 longer, where glass holds best
  const Hold& hold = holds_[static_cast<size_t>(slot)];
  const ForceField::About& about = world.forces.about(hold.tile);
  const glm::vec2 other =
      hold.acceleration_s2_m * about.acceleration_mps2 + hold.air2_s2_m2 * about.air2_m2_s2 - hold.share;
  float least = kRounding;
  if (filmLetsGo(world)) {
    const int row = world.map.nodeCount().x;  // a tile has its first corner's number
    const auto tile = static_cast<size_t>(hold.tile - hold.tile / row);
    least *= static_cast<float>(heldBy(world.film.mostAbout_m(tile)));
  }
  return hold.acceleration_s2_m * about.most_acceleration_mps2 + hold.air2_s2_m2 * about.most_air2_m2_s2 >
             least ||
         glm::dot(other, other) > kOther * kOther;
}

void Drops::brace(const DropWorld& world, int slot, int tile, double mass_kg, double drag_s2_m2,
                  double dry_hold_n) {
  Hold& hold = holds_[static_cast<size_t>(slot)];
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  hold.acceleration_s2_m = static_cast<float>(mass_kg / dry_hold_n);
  hold.air2_s2_m2 = static_cast<float>(drag_s2_m2);
  hold.tile = tile;
  const ForceField::About& about = world.forces.about(hold.tile);
  hold.share = hold.acceleration_s2_m * about.acceleration_mps2 + hold.air2_s2_m2 * about.air2_m2_s2;
  drop.braced_pl = static_cast<float>(drop.volume_pl);
  become(slot, Pose::braced);
}

void Drops::slide(const DropWorld& world, int slot) {
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const Push push = world.forces.at(world.map, drop.place_m);
  // What holds and what slows it goes by the base's size, not by its outline: k = 24 / pi^3 was measured on
  // drops as long as they come to be at rest, and the speed stays linear in Bo as drops grow long and pointed
  // (Le Grand, Daerr & Limat 2005).
  const double width_m = 2.0 * static_cast<double>(drop.base_radius_m);
  const double mass_kg = kRho_kg_m3 * cubicMetres(drop.volume_pl);
  const Drag drag(drop);
  const double air = glm::length(push.air_mps);
  glm::dvec2 force_n = mass_kg * push.acceleration_mps2;
  if (air > 0.0) force_n += drag.perSquare_n(widthAcross_m(drop, push.air_mps / air)) * air * push.air_mps;
  const double force = glm::length(force_n);
  const double dry_hold_n = hold_per_m_ * width_m;
  const double hold_n = dry_hold_n * heldAt(world, drop.texel);
  const glm::dvec2 toward = force > 0.0 ? force_n / force : glm::dvec2(0.0);
  if (drop.pose != Pose::moving && force <= hold_n) {
    if (reshape(slot, toward, force, 0.0, kRestStride * kTickSeconds)) {
      const double from_its_side_n = drag.perSquare_n(2.0 * static_cast<double>(halfLength_m(drop)));
      brace(world, slot, push.tile, mass_kg, from_its_side_n / dry_hold_n, dry_hold_n);
    } else {
      become(slot, Pose::uneasy);
    }
    return;
  }

  // Uneven glass: a turn of the path that depends on the place alone.
  const double turn = kMeander * static_cast<double>(shared::unevenness(world.glass.level(drop.texel)));
  const glm::dvec2 path = (toward + turn * glm::dvec2(-toward.y, toward.x)) / std::sqrt(1.0 + turn * turn);
  const double friction_kg_s = surface_.friction * width_m * kMu_pa_s;
  const double aim_mps = std::min(std::max(0.0, force - hold_n) / friction_kg_s, kFastest_mps);
  const double ease = 1.0 - static_cast<double>(exponential(-kTickSeconds * friction_kg_s / mass_kg));
  glm::dvec2 velocity(drop.velocity_mps);
  velocity += (aim_mps * path - velocity) * ease;
  const double speed = glm::length(velocity);
  const bool moves = speed > 1e-3 || force > hold_n;
  become(slot, moves ? Pose::moving : Pose::uneasy);
  if (!moves) velocity = glm::dvec2(0.0);
  drop.velocity_mps = glm::vec2(velocity);
  if (speed < 1e-5) return;

  const glm::dvec2 from_m = drop.place_m;
  moveTo(slot, from_m + velocity / push.metres * kTickSeconds);
  const glm::dvec2 ahead = velocity / speed;
  reshape(slot, ahead, force, speed, kTickSeconds);
  const int texel = world.map.texelAt(drop.place_m, drop.texel);
  if (overEdge(world, slot, texel)) return;
  if (texel != drop.texel) {
    takeOnTheWay(world, slot, from_m, ahead, widthAcross_m(drop, ahead));
    drop.texel = texel;
  }
  if (!drop.changed) changed_.push_back(slot);
  drop.changed = true;
  leaveTrail(world, slot, ahead, speed, push.metres);
}

// A base comes to the length and tail that its motion wants as it goes its own radius, or as its contact line
// does by itself. What rests is pinned: it grows longer, but shorter only as far as the line recedes, and
// loses its corner as it does. Two lengths at an angle add up as strains do, each with twice its angle.
// Whether it has come there.
bool Drops::reshape(int slot, glm::dvec2 along, double force_n, double speed_mps, double seconds) {
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const double radius_m = static_cast<double>(drop.base_radius_m);
  const double longer = static_cast<double>(drop.elongation) - 1.0;
  const double at_rest = lengthAtRest(force_n, cubicMetres(drop.volume_pl), radius_m);
  const double tail = tailsEnd(speed_mps, receding_mps_), with_tail = 0.5 * (1.0 + tail);
  const glm::dvec2 heading(drop.heading);
  double wanted = std::max(at_rest, with_tail) - 1.0;
  // A tail that has become the head, as the wind turned, goes by way of a round one.
  const double cornered = tail > 1.0 ? 0.5 * (tail - 1.0) / wanted : 0.0;  // see shared::capOfDrop
  const double corner = std::copysign(cornered, glm::dot(heading, along));
  if (drop.pose != Pose::moving && wanted < longer) {
    const double pinned =
        longestPinned(static_cast<double>(drop.height_m), radius_m, tan_half_receding_, tan_half_advancing_);
    wanted = std::max(wanted, std::min(longer, pinned - 1.0));
    along = heading;
  }
  const glm::dvec2 now = longer * twiceTurned(heading), aim = wanted * twiceTurned(along);
  const double corner_off = corner - static_cast<double>(drop.corner);
  constexpr double kThere = 0.01;
  const auto there = [](glm::dvec2 off) { return glm::dot(off, off) < kThere * kThere; };
  if (there(aim - now) && std::abs(corner_off) < kThere) return true;

  const auto share = [&](bool grows) {
    const double line_mps = grows ? advancing_mps_ : receding_mps_;
    return 1.0 - static_cast<double>(exponential(-seconds * (speed_mps + line_mps) / radius_m));
  };
  const bool grows = wanted > longer,
             sharpens = std::abs(corner) > std::abs(static_cast<double>(drop.corner));
  const double of_length = share(grows), of_corner = grows == sharpens ? of_length : share(sharpens);
  const glm::dvec2 strain = now + (aim - now) * of_length;
  const double length = glm::length(strain);
  drop.elongation = static_cast<float>(1.0 + length);
  if (length > 1e-6) drop.heading = glm::vec2(halfTurned(strain / length, heading));
  drop.corner += static_cast<float>(corner_off * of_corner);
  if (drop.pose != Pose::moving)
    drop.height_m = heightOf_m(drop);  // of others it is worked out once they left their trail
  noteWidth(slot);
  return there(aim - strain) && std::abs(corner_off) * (1.0 - of_corner) < kThere;
}

// A fast drop passes more than a texel in a tick.
void Drops::takeOnTheWay(const DropWorld& world, int slot, glm::dvec2 from_m, glm::dvec2 ahead,
                         double width_m) {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const glm::dvec2 way_m = drop.place_m - from_m;
  const int steps = static_cast<int>(std::ceil(glm::length(way_m) / world.map.grid().texel_m));
  int last = drop.texel;
  for (int step = 1; step <= steps; ++step) {
    const glm::dvec2 place_m = from_m + way_m * (static_cast<double>(step) / steps);
    const int texel = world.map.texelAt(place_m);
    if (texel >= 0 && texel != last) takeAcross(world, slot, place_m, ahead, width_m);
    last = texel;
  }
}

// What lies across its way at a place: as far to both sides as it is wide.
void Drops::takeAcross(const DropWorld& world, int slot, glm::dvec2 place_m, glm::dvec2 ahead,
                       double width_m) {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const double texel_m = world.map.grid().texel_m;
  const glm::dvec2 side(-ahead.y, ahead.x);
  const int reach = std::min(static_cast<int>(std::lround(0.5 * width_m / texel_m)), kMostAside);
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
  const bool upward = glm::dot(glm::dvec2(drop.velocity_mps), world.map.up()) >
                      0.5 * static_cast<double>(glm::length(drop.velocity_mps));
  over_edges_.push_back({drop.texel, drop.volume_pl});
  (upward ? world.ledger.blown_pl : world.ledger.drained_pl) += remove(slot);
  return true;
}

// A film behind the tail, thicker the faster (Landau & Levich 1942: speed^(2/3)), and pearls.
void Drops::leaveTrail(const DropWorld& world, int slot, glm::dvec2 ahead, double speed_mps,
                       glm::dvec2 metres) {
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const double way_m = speed_mps * kTickSeconds;
  const double width_m = 2.0 * static_cast<double>(drop.base_radius_m);
  const double film_m =
      surface_.trail_film_m * static_cast<double>(power(static_cast<float>(speed_mps / 0.1), 2.0f / 3.0f));
  const int64_t film_pl = std::min(picolitres(film_m * 0.5 * width_m * way_m), drop.volume_pl / 50);
  if (film_pl > 0 && world.film.attached()) {
    drop.volume_pl -= film_pl;
    world.film.add(drop.texel, passed(LeakyKernel::trail, film_pl));
  }
  if (speed_mps > kPearling * receding_mps_) {
    drop.since_pearl_m += static_cast<float>(way_m);
    // It takes at least 4 of the smallest to the next.
    if (drop.since_pearl_m >= 4.0f * kSmallestPearl * drop.base_radius_m)
      leavePearl(world, drop, ahead, metres);
  }
  settle(slot);
}

// Tails pinch off droplets of a tenth to a fifth of the width, every few of their own sizes (Podgorski,
// Flesselles & Limat 2001; sizes by eye).
void Drops::leavePearl(const DropWorld& world, Drop& drop, glm::dvec2 ahead, glm::dvec2 metres) {
  const uint32_t h = shared::pcg(drop.seed ^ shared::pcg(static_cast<uint32_t>(drop.texel)));
  const double radius_m =
      static_cast<double>(drop.base_radius_m) *
      (static_cast<double>(kSmallestPearl) + 0.16 * static_cast<double>(shared::unitFloat(h)));
  if (static_cast<double>(drop.since_pearl_m) <
      radius_m * (4.0 + 10.0 * static_cast<double>(shared::unitFloat(shared::pcg(h)))))
    return;
  drop.since_pearl_m = 0.0f;
  const int64_t pearl_pl = picolitres(shape_mean_ * radius_m * radius_m * radius_m);
  if (pearl_pl > drop.volume_pl / 20 || pearl_pl < 200) return;
  const double back_m = static_cast<double>(halfLength_m(drop)) + 1.5 * radius_m;
  const double aside = (static_cast<double>(shared::unitFloat(shared::pcg(h + 1u))) - 0.5) *
                       static_cast<double>(drop.base_radius_m);
  const glm::dvec2 place = drop.place_m + (-back_m * ahead + aside * glm::dvec2(-ahead.y, ahead.x)) / metres;
  if (world.map.texelAt(place) < 0) return;
  const int64_t left_pl = passed(LeakyKernel::trail, pearl_pl);
  // Storage does not move: slots are reserved up to the capacity.
  const bool lies = lieAsBead(world, place, left_pl) ||
                    (10 * live_ <= 9 * slots_.capacity_ && add(world, place, left_pl, radius_m, h) >= 0);
  if (lies) drop.volume_pl -= pearl_pl;
}

}  // namespace rg::glass
