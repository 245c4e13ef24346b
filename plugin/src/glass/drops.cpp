#include "glass/drops.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>
#include <utility>

#include "glass/bead_shape.h"
#include "glass/drop_shape.h"
#include "glass/random.h"
#include "shared/glass_beads.glsl"
#include "tick.h"

namespace rg::glass {
namespace {

constexpr int64_t kLeastDrop_pl = 50;  // a hemisphere of 0.03 mm: dries in a blink
constexpr int kAgeStride = 16;         // ticks from one look at what a drop loses to the next
constexpr size_t kFragments = 8;       // of a drop that shatters (unsourced)
// A thinner lamella breaks up before it can draw together (unsourced).
constexpr double kThinnestLamella_m = 20e-6;

// The lamella is 2/3 D We^(-1/2) thick.
bool shatters(const Impact& impact) {
  return 2.0 / 3.0 * impact.diameter_m < kThinnestLamella_m * std::sqrt(weber(impact));
}

// How fast a drop sinks into a film that it stands on: as a small wave of the film levels by surface tension,
// gamma h^3 k^4 / (3 mu) (Orchard 1962, Appl. Sci. Res. A 11), one as long as four of the drop's radii (by
// eye; weight, which makes wide ones faster by a third to a half, is left out).
double levelling_hz(double film_m, double base_radius_m) {
  const double k_per_m = std::numbers::pi / (2.0 * base_radius_m), kh_per_m = k_per_m * k_per_m * film_m;
  return kGamma_n_m / (3.0 * kMu_pa_s) * film_m * kh_per_m * kh_per_m;
}

}  // namespace

double reachTowards_m(const Drop& drop, glm::dvec2 way_m) {
  const double radius_m = static_cast<double>(drop.base_radius_m), e = static_cast<double>(drop.elongation);
  const double length2_m2 = glm::dot(way_m, way_m);
  if (drop.elongation == 1.0f || length2_m2 == 0.0) return radius_m;
  const double along_m = glm::dot(way_m, glm::dvec2(drop.heading));
  const double along = along_m * along_m / length2_m2;
  return radius_m / std::sqrt(along / e + (1.0 - along) * e);
}

double widthAcross_m(const Drop& drop, glm::dvec2 along) {
  const double cosine = glm::dot(along, glm::dvec2(drop.heading)), e = static_cast<double>(drop.elongation);
  const double along2 = std::min(1.0, cosine * cosine);
  return 2.0 * static_cast<double>(drop.base_radius_m) * std::sqrt(along2 / e + (1.0 - along2) * e);
}

float heightOf_m(const Drop& drop) {
  return static_cast<float>(capHeightFrom(static_cast<double>(drop.height_m), cubicMetres(drop.volume_pl),
                                          static_cast<double>(drop.base_radius_m),
                                          static_cast<double>(drop.elongation)));
}

Drops::Drops(const PaneMap& map, const Surface& surface, uint32_t capacity)
    : map_(map),
      surface_(surface),
      cell_count_(glm::ceil(glm::dvec2(map.grid().size) * map.grid().texel_m / kCell_m)),
      shape_advancing_(capShape(surface.advancing_rad)),
      shape_receding_(capShape(surface.receding_rad)),
      shape_mean_(capShape(meanAngle(surface))),
      least_bead_m3_(largestBead_m3(map.leastTexel_m2())),
      most_bead_m3_(largestBead_m3(map.mostTexel_m2())),
      hold_per_m_(retention_n(1.0, std::cos(surface.receding_rad), std::cos(surface.advancing_rad))),
      advancing_mps_(lineSpeed_mps(surface.advancing_rad)),
      receding_mps_(lineSpeed_mps(surface.receding_rad)),
      tan_half_advancing_(std::tan(0.5 * surface.advancing_rad)),
      tan_half_receding_(std::tan(0.5 * surface.receding_rad)) {
  slots_.capacity_ = capacity;
  slots_.items.reserve(capacity);
  nears_.reserve(capacity);
  holds_.reserve(capacity);
  slots_.free.reserve(capacity);
  cells_.assign(static_cast<size_t>(cell_count_.x * cell_count_.y), {});
  block_count_ = (cell_count_ + (kBlock - 1)) / kBlock;
  widest_m_.assign(static_cast<size_t>(block_count_.x * block_count_.y), 0.0f);
  for (int y = 0; y < cell_count_.y; ++y) {
    for (int x = 0; x < cell_count_.x; ++x) block_of_.push_back(y / kBlock * block_count_.x + x / kBlock);
  }
}

void Drops::clear() {
  slots_.items.clear();
  nears_.clear();
  holds_.clear();
  slots_.free.clear();
  for (SlotSet* set : {&moving_, &uneasy_, &braced_}) set->clear();
  changed_.clear();
  std::fill(cells_.begin(), cells_.end(), Cell{});
  std::fill(widest_m_.begin(), widest_m_.end(), 0.0f);
  live_ = 0;
  largest_radius_m_ = 0.0f;
}

int64_t Drops::volume_pl() const {
  int64_t sum = 0;
  for (const Drop& drop : slots_.items) sum += drop.volume_pl;
  return sum;
}

void Drops::change(int slot, Pose pose) {
  Pose& now = slots_.items[static_cast<size_t>(slot)].pose;
  const auto of = [this](Pose which) {
    return which == Pose::moving ? &moving_ : which == Pose::uneasy ? &uneasy_ : &braced_;
  };
  if (now != Pose::gone) of(now)->put(slot, false);
  if (pose != Pose::gone) of(pose)->put(slot, true);
  now = pose;
}

void Drops::link(int slot) {
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  drop.cell = cellOf(drop.place_m);
  Cell& cell = cells_[static_cast<size_t>(drop.cell)];
  nears_[static_cast<size_t>(slot)].place_m = glm::vec2(drop.place_m);
  nears_[static_cast<size_t>(slot)].next = cell.first;
  cell.first = slot;
  noteWidth(slot);
  tellWidth(slot, nears_[static_cast<size_t>(slot)].half_m);
}

void Drops::unlink(int slot) {
  Cell& cell = cells_[static_cast<size_t>(slots_.items[static_cast<size_t>(slot)].cell)];
  int32_t* at = &cell.first;
  while (*at != slot) at = &nears_[static_cast<size_t>(*at)].next;
  *at = nears_[static_cast<size_t>(slot)].next;
  if (cell.first < 0) cell.widest_m = 0.0f;
}

void Drops::moveTo(int slot, glm::dvec2 place_m) {
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const bool stays = cellOf(place_m) == drop.cell;
  if (!stays) unlink(slot);
  drop.place_m = place_m;
  if (stays)
    nears_[static_cast<size_t>(slot)].place_m = glm::vec2(place_m);
  else
    link(slot);
}

// A drop of another volume than before: what rests has to be looked at.
void Drops::settle(int slot) {
  if (slots_.items[static_cast<size_t>(slot)].pose == Pose::braced) become(slot, Pose::uneasy);
  fitAngle(slot);
}

// A contact line moves where the angle would leave the range between receding and advancing; otherwise it is
// pinned.
void Drops::fitAngle(int slot) {
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const double volume_m3 = cubicMetres(drop.volume_pl);
  const double radius_m = static_cast<double>(drop.base_radius_m);
  const double shape = volume_m3 / (radius_m * radius_m * radius_m);
  const bool advances = !(shape <= shape_advancing_), recedes = shape < shape_receding_;
  if (advances || recedes) {
    drop.base_radius_m =
        static_cast<float>(std::cbrt(volume_m3 / (advances ? shape_advancing_ : shape_receding_)));
    noteWidth(slot);
  }
  drop.height_m = heightOf_m(drop);
}

int Drops::add(const DropWorld& world, glm::dvec2 place_m, int64_t volume_pl, double base_radius_m,
               uint32_t seed, bool as_told) {
  const int texel = world.map.texelAt(place_m);
  if (texel < 0 || volume_pl <= 0) return -1;
  int slot;
  if (!slots_.free.empty()) {
    slot = slots_.free.back();
    slots_.free.pop_back();
  } else if (slots_.items.size() < slots_.capacity_) {
    slot = static_cast<int>(slots_.items.size());
    slots_.items.emplace_back();
    nears_.emplace_back();
    holds_.emplace_back();
  } else {
    return -1;
  }
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const uint32_t life = drop.life + 1;
  drop = {};
  drop.life = life;
  drop.volume_pl = volume_pl;
  drop.place_m = place_m;
  drop.base_radius_m = static_cast<float>(base_radius_m);
  drop.seed = seed;
  drop.texel = texel;
  const double turn =
      6.283185307179586 * static_cast<double>(shared::unitFloat(shared::pcg(seed ^ 0x51ed270bu)));
  drop.heading = glm::vec2(glm::dvec2(std::cos(turn), std::sin(turn)));
  become(slot, Pose::uneasy);
  link(slot);
  if (as_told) {
    drop.height_m = heightOf_m(drop);
  } else {
    fitAngle(slot);
  }
  ++live_;
  drop.changed = true;
  changed_.push_back(slot);
  return slot;
}

int64_t Drops::remove(int slot) {
  unlink(slot);
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  become(slot, Pose::gone);
  slots_.free.push_back(slot);
  --live_;
  return std::exchange(drop.volume_pl, 0);
}

int64_t Drops::removeHidden() {
  int64_t sum_pl = 0;
  for (size_t slot = 0; slot < slots_.items.size(); ++slot) {
    const Drop& drop = slots_.items[slot];
    if (drop.volume_pl > 0 && !map_.shown(drop.texel)) sum_pl += remove(static_cast<int>(slot));
  }
  return sum_pl;
}

int64_t Drops::cut(int slot, int64_t keep_pl) {
  if (keep_pl < kLeastDrop_pl) return remove(slot);
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const int64_t taken_pl = drop.volume_pl - keep_pl;
  drop.volume_pl = keep_pl;
  settle(slot);
  return taken_pl;
}

// When slots run short larger and larger sizes lie as beads, the limit rising from 0 at half full to 2 mm at
// full.
bool Drops::impact(const DropWorld& world, const Impact& impact, double rewetting_hz) {
  int64_t volume_pl = passed(LeakyKernel::impact, impact.volume_pl);
  const double used =
      slots_.capacity_ == 0 ? 1.0 : static_cast<double>(live_) / static_cast<double>(slots_.capacity_);
  const double least_diameter_m = 4e-3 * std::max(0.0, used - 0.5);
  const double chance = static_cast<double>(shared::unitFloat(impact.hash));
  const bool short_of_slots = impact.diameter_m < least_diameter_m, no_beads = !world.film.attached();
  const double texel_m = world.map.grid().texel_m;
  const double wide_m = std::min(lamellaRadius_m(impact), (Footprint::kFarthest - 0.5) * texel_m);
  const auto becomesFilm = [&] {
    world.film.spread(impact.place_m, ForceField::metresAt(world.map, impact.place_m), wide_m + 0.5 * texel_m,
                      volume_pl);
    return true;
  };
  if (slots_.capacity_ == 0 || chance >= dryShare(world.film.thickness_m(impact.texel)) ||
      (short_of_slots && no_beads))
    return becomesFilm();
  const int under = covering(world, impact.place_m);
  const bool larger = under >= 0 && slots_.items[static_cast<size_t>(under)].volume_pl > volume_pl;
  if (!larger && staysFilm(world, impact, wide_m, rewetting_hz)) {
    for (const int slot : under_) volume_pl += remove(slot);
    return becomesFilm();
  }
  if (under >= 0) {
    Drop& drop = slots_.items[static_cast<size_t>(under)];
    drop.volume_pl += volume_pl;
    settle(under);
    if (!drop.changed) changed_.push_back(under);
    drop.changed = true;
    return false;
  }
  if (lieAsBead(world, impact.place_m, volume_pl)) return false;
  if (short_of_slots || (shatters(impact) && !no_beads)) {
    shatter(world, impact, volume_pl);
    return false;
  }
  // A falling drop spreads until its edge has some angle between both: the more so, the rougher it met the
  // glass.
  const double angle =
      surface_.receding_rad + (surface_.advancing_rad - surface_.receding_rad) * (0.35 + 0.6 * chance);
  const double radius_m = std::cbrt(cubicMetres(volume_pl) / capShape(angle));
  const int slot = add(world, impact.place_m, volume_pl, radius_m, impact.hash);
  if (slot >= 0)
    takeUnder(world, slot);
  else
    shatter(world, impact, volume_pl);
  return false;
}

// A lamella washes along what drops lie there that are no larger than its own (under_). It draws back into a
// drop as fast as a line recedes that nothing else moves; where another runs over it before that all of it
// stays film, as long as that is as thick as to wet the glass.
bool Drops::staysFilm(const DropWorld& world, const Impact& impact, double wide_m, double rewetting_hz) {
  if (!world.film.attached()) return false;
  const double own_m3 = cubicMetres(impact.volume_pl);
  const double back_s = (wide_m - std::cbrt(own_m3 / shape_receding_)) / receding_mps_;
  const double chance = static_cast<double>(shared::unitFloat(shared::pcg(impact.hash ^ 0x68bc21ebu)));
  if (chance >= -std::expm1(-rewetting_hz * back_s)) return false;
  under_.clear();
  double all_m3 = own_m3;
  const glm::dvec2 metres = ForceField::metresAt(world.map, impact.place_m), reach = wide_m / metres;
  forEachIn(impact.place_m - reach, impact.place_m + reach, [&](int slot, glm::vec2 place_m, float) {
    const glm::dvec2 away_m = (glm::dvec2(place_m) - impact.place_m) * metres;
    const int64_t volume_pl = slots_.items[static_cast<size_t>(slot)].volume_pl;
    if (volume_pl > impact.volume_pl || glm::dot(away_m, away_m) > wide_m * wide_m) return;
    under_.push_back(slot);
    all_m3 += cubicMetres(volume_pl);
  });
  const double film_m = world.film.thickness_m(impact.texel);
  return film_m + all_m3 / (std::numbers::pi * wide_m * wide_m) > surface_.wetting_m;
}

double Drops::largestBead_m3(double texel_m2) const {
  const double radius_m = std::sqrt(static_cast<double>(shared::kCrowded) * texel_m2 / std::numbers::pi);
  return std::min(shape_mean_ * radius_m * radius_m * radius_m, mostBead_m3(surface_));
}

// A volume that a texel holds as a lone bead does not become a drop, where there is a film to hold it.
bool Drops::lieAsBead(const DropWorld& world, glm::dvec2 place_m, int64_t volume_pl) {
  const int texel = world.map.texelAt(place_m);
  if (texel < 0 || !world.film.attached()) return false;
  const double volume_m3 = cubicMetres(volume_pl);
  if (volume_m3 > most_bead_m3_) return false;
  if (volume_m3 > least_bead_m3_ &&
      volume_m3 > largestBead_m3(static_cast<double>(world.map.texel(texel).area_m2)))
    return false;
  world.film.addBeads(texel, volume_pl, 1);
  return true;
}

// Fragments lie anywhere in the lamella's circle, of all sizes: their shares of the volume fall as intervals
// of a Poisson process do.
void Drops::shatter(const DropWorld& world, const Impact& impact, int64_t volume_pl) {
  const double reach_m = lamellaRadius_m(impact);
  const glm::dvec2 metres = ForceField::metresAt(world.map, impact.place_m);
  std::array<double, kFragments> upTo{};
  double sum = 0.0;
  uint32_t h = impact.hash;
  for (double& share : upTo) {
    h = shared::pcg(h + 1u);
    share = sum -= std::log(static_cast<double>(shared::openUnitFloat(h)));
  }
  int64_t left_pl = volume_pl;
  for (size_t i = 0; i < kFragments; ++i) {
    const auto rest_pl = static_cast<int64_t>(static_cast<double>(volume_pl) * (1.0 - upTo[i] / sum));
    const int64_t fragment_pl = left_pl - std::min(rest_pl, left_pl);  // of the last: all, its rest is 0
    left_pl -= fragment_pl;
    h = shared::pcg(h + 1u);
    const double way_m = reach_m * std::sqrt(static_cast<double>(shared::unitFloat(h)));
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(shared::unitFloat(shared::pcg(h)));
    glm::dvec2 place = impact.place_m + way_m / metres * glm::dvec2(std::cos(turn), std::sin(turn));
    if (world.map.texelAt(place) < 0) place = impact.place_m;
    if (fragment_pl <= 0 || lieAsBead(world, place, fragment_pl)) continue;
    const double radius_m = std::cbrt(cubicMetres(fragment_pl) / shape_mean_);
    if (add(world, place, fragment_pl, radius_m, h) < 0)
      world.film.spread(place, metres, radius_m + 0.5 * world.map.grid().texel_m, fragment_pl);
  }
}

// A drop takes the beads that lie where it comes to lie.
void Drops::takeUnder(const DropWorld& world, int slot) {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  if (!world.film.watered(drop.texel)) return;
  const double radius_m = static_cast<double>(drop.base_radius_m);
  const double share =
      std::numbers::pi * radius_m * radius_m / static_cast<double>(world.map.texel(drop.texel).area_m2);
  world.film.take(drop.texel, share, static_cast<uint32_t>(slot), drop.life);
}

void Drops::give(const DropWorld& world, const Taker& taker, int64_t volume_pl) {
  if (volume_pl <= 0) return;
  volume_pl = passed(LeakyKernel::collect, volume_pl);
  if (taker.slot < slots_.items.size()) {
    Drop& drop = slots_.items[taker.slot];
    if (drop.volume_pl > 0 && drop.life == taker.life) {
      drop.volume_pl += volume_pl;
      settle(static_cast<int>(taker.slot));
      return;
    }
  }
  world.film.add(taker.texel, volume_pl);
}

void Drops::age(const DropWorld& world) {
  const auto phase = static_cast<size_t>(world.tick % kAgeStride + kAgeStride) % kAgeStride;
  for (size_t word = phase; word * SlotSet::kInWord < slots_.items.size(); word += kAgeStride) {
    forEachSlot(word, moving_.word(word) | uneasy_.word(word) | braced_.word(word),
                [&](int slot) { age(world, slot); });
  }
}

void Drops::age(const DropWorld& world, int slot) {
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  if (sinks(world, slot)) {
    const glm::dvec2 place = drop.place_m;
    const double radius_m = 1.5 * static_cast<double>(drop.base_radius_m) + world.map.grid().texel_m;
    world.film.spread(place, ForceField::metresAt(world.map, place), radius_m, remove(slot));
  } else if (world.humidity < 1.0) {
    dry(world, slot);
  }
}

// Where a tile is wet in parts its drops stand on film or on glass, as they happen to.
bool Drops::sinks(const DropWorld& world, int slot) const {
  if (!filmLetsGo(world)) return false;
  const Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const uint32_t own = drop.seed ^ shared::pcg(static_cast<uint32_t>(slot));
  const auto chance = [own](uint32_t of) {
    return static_cast<double>(shared::unitFloat(shared::pcg(own + of)));
  };
  const double film_m = world.film.thickness_m(drop.texel);
  if (chance(0x9e3779b9u) < dryShare(film_m)) return false;
  const double where_wet_m = std::max(film_m, surface_.wetting_m);
  const double expected =
      levelling_hz(where_wet_m, static_cast<double>(drop.base_radius_m)) * kAgeStride * kTickSeconds;
  return chance(static_cast<uint32_t>(world.tick)) < -std::expm1(-expected);
}

// A braced drop that dries stays so: its weight goes with its volume, what holds it with its width, V^(1/3),
// so that the pull falls faster than the hold. As it has become noticeably smaller its shape is looked at
// anew.
void Drops::dry(const DropWorld& world, int slot) {
  constexpr float kNoticed = 0.97f;
  Drop& drop = slots_.items[static_cast<size_t>(slot)];
  const double radius_m = static_cast<double>(drop.base_radius_m);
  const double theta = static_cast<double>(capAngle(drop.height_m, drop.base_radius_m));
  const double rate_kg_s = evaporation_kg_s(radius_m, theta, world.humidity, world.saturated_kg_m3) *
                           ventilation(world.forces.airSpeed_mps(world.map, drop.place_m), 2.0 * radius_m);
  const double lost = rate_kg_s / kRho_kg_m3 * kAgeStride * kTickSeconds * kPicolitresPerM3;
  // Whole picolitres; the rest by chance, so that the mean is right.
  const double chance = static_cast<double>(
      shared::unitFloat(shared::pcg(drop.seed ^ shared::pcg(static_cast<uint32_t>(world.tick)))));
  int64_t lost_pl = std::min(static_cast<int64_t>(lost + chance), drop.volume_pl);
  if (drop.volume_pl - lost_pl < kLeastDrop_pl) lost_pl = drop.volume_pl;
  if (lost_pl == 0) return;
  if (lost_pl == drop.volume_pl) {
    world.ledger.evaporated_pl += passed(LeakyKernel::evaporation, remove(slot));
    return;
  }
  world.ledger.evaporated_pl += passed(LeakyKernel::evaporation, lost_pl);
  drop.volume_pl -= lost_pl;
  if (drop.pose == Pose::braced && static_cast<float>(drop.volume_pl) < kNoticed * drop.braced_pl)
    become(slot, Pose::uneasy);
  fitAngle(slot);
}

uint64_t Drops::hash(uint64_t start) const {
  uint64_t h = start;
  const auto mix = [&h](uint64_t value) { h = (h ^ value) * 0x100000001b3ull + (h >> 29); };
  for (const Drop& drop : slots_.items) {
    mix(static_cast<uint64_t>(drop.volume_pl));
    if (drop.volume_pl == 0) continue;
    mix(std::bit_cast<uint64_t>(drop.place_m.x));
    mix(std::bit_cast<uint64_t>(drop.place_m.y));
    mix(std::bit_cast<uint32_t>(drop.velocity_mps.x) |
        static_cast<uint64_t>(std::bit_cast<uint32_t>(drop.velocity_mps.y)) << 32);
    mix(std::bit_cast<uint32_t>(drop.base_radius_m) | static_cast<uint64_t>(drop.seed) << 32);
    mix(std::bit_cast<uint32_t>(drop.elongation) | static_cast<uint64_t>(std::bit_cast<uint32_t>(drop.corner))
                                                       << 32);
  }
  return h;
}

}  // namespace rg::glass
