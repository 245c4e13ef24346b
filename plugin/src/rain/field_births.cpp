// Which drops a cell holds, and until when: born with their cell, unless a volume kept them off, and asked
// again when what was foreseen is no longer right.
#include <algorithm>
#include <cmath>

#include "rain/bounce.h"
#include "rain/field_state.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr size_t kBornAtOnce = 64;  // so many lines of the cache are on their way together, and find room
constexpr uint32_t kEndless = 1u << 30;   // ticks' units ahead: 2.4 h, longer than any drop stays in view
constexpr double kLongestEnd_s = 8000.0;  // ends beyond are none

}  // namespace

dvec3 Field::State::cellMiddle(const CellKey& key) const {
  return frames.origin(key.kind) + (dvec3(key.x, key.y, key.z) + 0.5) * border.cell_m(key.kind);
}

bool Field::State::lookAround(const CellKey& key, bool past) {
  if (shelter.empty()) return false;
  return shelter.lookAround(cellMiddle(key), dvec3(0.5 * border.cell_m(key.kind)), frames.path(key.kind),
                            time_s(), past);
}

// But for its end. Field by field into its place: what is put together elsewhere and copied in larger pieces
// has to wait until the pieces it was put together from have left the processor.
inline void Field::State::writeComing(uint32_t kind, uint32_t i, RainDrop& drop) const {
  drop.cell_x = coming.of.x[i];
  drop.cell_y = coming.of.y[i];
  drop.cell_z = coming.of.z[i];
  drop.fraction_xy = coming.of.fraction_xy[i];
  drop.fraction_z_class = coming.of.fraction_z[i] | kind << 16;
  drop.diameter_m = coming.diameter_m[i];
  drop.id = coming.of.id[i];
}

// Many cells of a class at once: all that may be born in them is found first, then their sizes, and meanwhile
// the room for them comes to the cache.
void Field::State::fillEnteredCells() {
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    if (followed.test(kind)) least_chance[kind] = chanceAt(rate.most_m3(kind), kind);
  }
  uint32_t kind = kNone;
  for (const uint32_t cell : border.entered()) {
    if (cells[cell].key.kind != kind || coming.of.count >= kBornAtOnce) bear(kind);
    if (coming.cells.empty()) drops.fetchRoom(2 * kBornAtOnce);
    kind = cells[cell].key.kind;
    findComing(cell);
  }
  bear(kind);
}

// A cell of the border is a block of the standing lattice's.
void Field::State::findComing(uint32_t cell) {
  const CellKey& key = cells[cell].key;
  const int32_t side = 1 << border.level();
  const size_t first = coming.of.count;
  findCandidates(settings.seed, {key.x * side, key.y * side, key.z * side, border.level(), key.kind},
                 least_chance[key.kind], coming.of);
  if (!rate.steady()) keepThoseOfTheirTime(key.kind, first);
  coming.cells.push_back({cell, static_cast<uint32_t>(coming.of.count)});
}

void Field::State::keepThoseOfTheirTime(uint32_t kind, size_t first) {
  size_t kept = first;
  for (size_t i = first; i < coming.of.count; ++i) {
    const InTheAir& then = whenFallen(kind, static_cast<uint32_t>(i));
    if (coming.of.chance[i] <= chanceAt(then.density_m3[kind], kind)) continue;
    coming.of.move(kept++, i);
    coming.then.push_back(&then);
  }
  coming.of.count = kept;
}

// What rain there is where a drop is was decided when it fell through the ceiling.
const InTheAir& Field::State::whenFallen(uint32_t kind, uint32_t i) const {
  const ClassLattice& lattice = lattices[kind];
  const double z =
      frames.origin(kind).z + (coming.of.z[i] + coming.of.fraction_z[i] * 0x1p-16) * lattice.cell_m;
  const double fallen_ticks = (ceiling_m - z) / lattice.drops.speed_mps * static_cast<double>(kTickHz),
               delay = std::max(set_in.test(kind) ? 1.0 : 0.0, fallen_ticks);
  return rate.ago(static_cast<uint32_t>(std::min(delay, 1e6)));
}

void Field::State::findDiameters(uint32_t kind) {
  coming.diameter_m.resize(coming.of.count);
  if (rate.steady()) {
    diametersOf_m(rate.now(), kind, std::span(coming.of.size).first(coming.of.count), coming.diameter_m);
    return;
  }
  for (size_t i = 0; i < coming.of.count; ++i)
    coming.diameter_m[i] = diameterOf_m(*coming.then[i], kind, coming.of.size[i]);
}

// Those of a cell that no volume keeps from being born, and until when they live.
void Field::State::findLiving(uint32_t kind, uint32_t first, uint32_t end, bool near_volume) {
  coming.living.clear();
  coming.ends.clear();
  for (uint32_t i = first; i < end; ++i) {
    RainDrop drop;
    writeComing(kind, i, drop);
    const dvec3 place = placeOf(drop);
    const Passage passage = near_volume ? shelter.passage(place, frames.path(kind), time_s()) : Passage{};
    const double falls_s = fallsFor(drop, place, passage.enters_s);
    if (passage.came_through || falls_s <= 0.0) {
      if (near_volume) ++sheltered;
      continue;
    }
    coming.living.push_back(i);
    coming.ends.push_back(endOf(falls_s));
  }
}

void Field::State::bear(uint32_t kind) {
  if (coming.cells.empty()) return;
  findDiameters(kind);
  const Drops::End none{now() + kEndless, false};
  uint32_t first = 0;
  for (const auto& [index, end] : coming.cells) {
    if (first == end) continue;
    Cell& cell = cells[index];
    cell.near_volume = lookAround(cell.key, true);
    const bool may_end = cell.near_volume || isStone(kind);
    if (may_end) findLiving(kind, first, end, cell.near_volume);
    const auto wanted = static_cast<uint32_t>(may_end ? coming.living.size() : end - first);
    born += drops.add(wanted, kind, index, cell.bunch, now(), [&](uint32_t i, RainDrop& drop, float& chance) {
      const uint32_t which = may_end ? coming.living[i] : first + i;
      writeComing(kind, which, drop);
      chance = static_cast<float>(coming.of.chance[which]);
      return may_end ? coming.ends[i] : none;
    });
    first = end;
  }
  coming.of.count = 0;
  coming.then.clear();
  coming.cells.clear();
}

// The least chance of a drop that exists where the law has so many.
double Field::State::chanceAt(double density_m3, uint32_t kind) const {
  return std::exp(-keep * density_m3 * lattices[kind].cell_m3);
}

dvec3 Field::State::placeOf(const RainDrop& drop) const {
  const uint32_t kind = shared::rainClassOf(drop);
  const dvec3 fraction(drop.fraction_xy & 0xffffu, drop.fraction_xy >> 16, drop.fraction_z_class & 0xffffu);
  return frames.origin(kind) +
         (dvec3(drop.cell_x, drop.cell_y, drop.cell_z) + (fraction + 0.5) * 0x1p-16) * lattices[kind].cell_m;
}

// Until it comes into a volume; a stone also: onto the ground, as that is told now.
double Field::State::fallsFor(const RainDrop& drop, const dvec3& place, double enters_s) const {
  const uint32_t kind = shared::rainClassOf(drop);
  if (!isStone(kind)) return enters_s;
  const double above_m = place.z - 0.5 * static_cast<double>(drop.diameter_m) - ground_m;
  return std::min(enters_s, above_m / lattices[kind].drops.speed_mps);
}

// Rounded down, so that the drop does not outlive its entry.
Drops::End Field::State::endOf(double after_s) const {
  const bool comes = after_s < kLongestEnd_s;
  return {now() + (comes ? static_cast<uint32_t>(after_s * kTickHz * kEndUnits) : kEndless), comes};
}

// A stone that came down flies on as a drop of its own.
void Field::State::bounce(const RainDrop& stone) {
  const uint32_t kind = shared::rainClassOf(stone);
  const double ago_s = static_cast<double>(now() - stone.end) * kTickSeconds / kEndUnits;
  const dvec3 velocity = frames.velocity(kind);
  const Impact impact{placeOf(stone) - velocity * ago_s, velocity, static_cast<double>(stone.diameter_m),
                      ago_s, stone.id};
  const Flight flight = flightAfter(impact, ground_m, shelter, time_s());
  if (flight.lasts_s <= ago_s) return;
  const uint32_t end = stone.end + static_cast<uint32_t>(flight.lasts_s * kTickHz * kEndUnits);
  const RainDrop drop = recordOf(flight, impact.diameter_m, frames.origin(kBouncedClass), stone.end, end);
  if (drop.diameter_m == 0.0f || static_cast<int32_t>(end - now()) <= 0) return;
  bool is_fresh = false;
  if (bounced_cell == kNone) bounced_cell = cells.acquire({0, 0, 0, kBouncedClass}, is_fresh);
  constexpr float kAlways = 2.0f;  // as chance: it is there, however much is thinned
  const uint32_t added = drops.add(1, kBouncedClass, bounced_cell, cells[bounced_cell].bunch, now(),
                                   [&](uint32_t, RainDrop& record, float& chance) {
                                     record = drop;
                                     chance = kAlways;
                                     return Drops::End{end, true};
                                   });
  born += added;
  bounced += added;
}

// What has been foreseen is no longer right: drops that may meet a volume, or were to meet one, are asked
// again where they end, also in cells that were not near a volume before. Where they came from has not
// changed: drops that never were stay so.
void Field::State::retest() {
  for (uint32_t index = 0; index < cells.poolSize(); ++index) {
    if (cells[index].views > 0 && cells[index].bunch != kNone && index != bounced_cell) retestCell(index);
  }
}

void Field::State::retestCell(uint32_t index) {
  Cell& cell = cells[index];
  const bool near_volume = lookAround(cell.key, false);
  if (!near_volume && !cell.near_volume) return;
  cell.near_volume = near_volume;
  drops.forEach(cell.bunch, [&](uint32_t slot) {
    const dvec3 place = placeOf(drops[slot]);
    const double enters_s =
        near_volume ? shelter.willEnter(place, frames.path(cell.key.kind), time_s()) : kNever_s;
    const double falls_s = fallsFor(drops[slot], place, enters_s);
    const Drops::End end = endOf(falls_s);
    if (falls_s <= 0.0) {
      drops.remove(slot, cell.bunch);
      ++died;
    } else if (end.comes != drops.ends(slot) || (end.comes && end.at != drops[slot].end)) {
      drops.setEnd(slot, end, now());
    }
  });
}

}  // namespace rg::rain
