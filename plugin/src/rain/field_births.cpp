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

// Many cells at once. All that may be born in them is found first, then their sizes, which have nothing to
// wait for but their own logarithms, and meanwhile the room for them comes to the cache.
void Field::State::fillEnteredCells() {
  for (uint32_t kind = 0; kind < kClasses; ++kind) least_chance[kind] = chanceAt(rate.most_m3(kind), kind);
  for (const uint32_t cell : border.entered()) {
    findComing(cell);
    if (coming.size() >= kBornAtOnce) bear();
  }
  bear();
}

void Field::State::bear() {
  drops.fetchRoom(coming.size());
  for (Coming& c : coming) c.drop.diameter_m = diameterOf_m(*c.then, cells[c.cell].key.kind, c.size);
  uint32_t looked_at = kNone;
  for (const Coming& c : coming) {
    if (c.cell != looked_at) cells[c.cell].near_volume = lookAround(cells[c.cell].key, true);
    looked_at = c.cell;
    if (!birth(c)) break;
  }
  coming.clear();
}

// A cell of the border is a block of the standing lattice's.
void Field::State::findComing(uint32_t cell) {
  const CellKey block = cells[cell].key;
  const int32_t side = 1 << border.level();
  for (int32_t x = block.x * side; x < (block.x + 1) * side; ++x) {
    for (int32_t y = block.y * side; y < (block.y + 1) * side; ++y) {
      const CandidateRow row(settings.seed, x, y);
      for (int32_t z = block.z * side; z < (block.z + 1) * side; ++z)
        findComingOf(cell, {x, y, z, block.kind}, Candidates(row, z, block.kind));
    }
  }
}

void Field::State::findComingOf(uint32_t cell, const CellKey& key, Candidates candidates) {
  while (const Candidate* c = candidates.next(least_chance[key.kind])) {
    const InTheAir& then = rate.steady() ? rate.now() : whenFallen(key, *c);
    if (!rate.steady() && c->chance <= chanceAt(then.density_m3[key.kind], key.kind)) continue;
    // Field by field into its place: what is put together elsewhere and copied in larger pieces has to wait
    // until the pieces it was put together from have left the processor.
    Coming& comes = coming.emplace_back();
    comes.drop.cell_x = key.x;
    comes.drop.cell_y = key.y;
    comes.drop.cell_z = key.z;
    comes.drop.fraction_xy = c->fraction_x | c->fraction_y << 16;
    comes.drop.fraction_z_class = c->fraction_z | key.kind << 16;
    comes.drop.id = c->id;
    comes.cell = cell;
    comes.chance = static_cast<float>(c->chance);
    comes.size = c->size;
    comes.then = &then;
  }
}

// What rain there is where a drop is was decided when it fell through the ceiling.
const InTheAir& Field::State::whenFallen(const CellKey& key, const Candidate& candidate) const {
  const ClassLattice& lattice = lattices[key.kind];
  const double z = frames.origin(key.kind).z + (key.z + candidate.fraction_z * 0x1p-16) * lattice.cell_m;
  const double fallen_ticks = (ceiling_m - z) / lattice.drops.speed_mps * static_cast<double>(kTickHz),
               delay = std::max(set_in.test(key.kind) ? 1.0 : 0.0, fallen_ticks);
  return rate.ago(static_cast<uint32_t>(std::min(delay, 1e6)));
}

// The least chance of a drop that exists where the law has so many.
double Field::State::chanceAt(double density_m3, uint32_t kind) const {
  return std::exp(-keep * density_m3 * lattices[kind].cell_m3);
}

// False when the buffer is full.
bool Field::State::birth(const Coming& comes) {
  Cell& cell = cells[comes.cell];
  const RainDrop& drop = comes.drop;
  Drops::End end{now() + kEndless, false};
  if (cell.near_volume || isStone(cell.key.kind)) {
    const dvec3 place = placeOf(drop);
    const double falls_s = fallsFor(drop, place, cell.near_volume);
    if (falls_s <= 0.0 ||
        (cell.near_volume && shelter.cameThrough(place, frames.path(cell.key.kind), time_s()))) {
      if (cell.near_volume) ++sheltered;
      return true;
    }
    end = endOf(falls_s);
  }
  if (drops.add(drop, end, comes.chance, comes.cell, cell.bunch, now()) == kNone) return false;
  ++born;
  return true;
}

dvec3 Field::State::placeOf(const RainDrop& drop) const {
  const uint32_t kind = shared::rainClassOf(drop);
  const dvec3 fraction(drop.fraction_xy & 0xffffu, drop.fraction_xy >> 16, drop.fraction_z_class & 0xffffu);
  return frames.origin(kind) +
         (dvec3(drop.cell_x, drop.cell_y, drop.cell_z) + (fraction + 0.5) * 0x1p-16) * lattices[kind].cell_m;
}

// Until it comes into a volume; a stone also: onto the ground, as that is told now.
double Field::State::fallsFor(const RainDrop& drop, const dvec3& place, bool near_volume) {
  const uint32_t kind = shared::rainClassOf(drop);
  const double enters_s = near_volume ? shelter.willEnter(place, frames.path(kind), time_s()) : kNever_s;
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
  const uint32_t slot = drops.add(drop, {end, true}, kAlways, bounced_cell, cells[bounced_cell].bunch, now());
  if (slot == kNone) return;
  ++born;
  ++bounced;
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
    const double falls_s = fallsFor(drops[slot], placeOf(drops[slot]), near_volume);
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
