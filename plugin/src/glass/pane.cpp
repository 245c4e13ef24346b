#include "glass/pane.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "glass/bead_shape.h"
#include "glass/pane_state.h"
#include "glass/pillar.h"
#include "glass/random.h"
#include "glass/washer.h"
#include "shared/glass_beads.glsl"
#include "tick.h"

namespace rg::glass {
namespace {

constexpr uint32_t kWashStream = 1000;  // beyond the rain's size classes
constexpr uint32_t kRoundSeed = 0;      // the look draws it with a round outline
// Ticks: the longest stall that is caught up with, and what was under way before it.
constexpr size_t kMostWaiting = (kLongestCatchUp_s + 1) * kTickHz;
constexpr size_t kMostStripped = 2048;  // texels in a film step; the rest in the next

Surface surfaceFor(const PaneInfo& info) {
  Surface surface = surfaceOf(info.glass);
  if (info.advancing_rad > 0.0) surface.advancing_rad = info.advancing_rad;
  if (info.receding_rad > 0.0) surface.receding_rad = info.receding_rad;
  const bool sound = surface.receding_rad > 0.0 && surface.receding_rad <= surface.advancing_rad &&
                     surface.advancing_rad < 0.98 * std::numbers::pi;
  if (!sound)
    throw std::invalid_argument("pane '" + info.name +
                                "': contact angles must be 0 < receding <= advancing < 176 degrees");
  return surface;
}

// Still air takes vapour through a layer some millimetres thick (unsourced); moving air thins it.
constexpr double kVapourLayer_m = 5e-3;
double filmEvaporation_mps(double humidity, double saturated_kg_m3, double air_mps) {
  const double still =
      kVapourDiffusivity_m2_s * std::max(0.0, 1.0 - humidity) * saturated_kg_m3 / kVapourLayer_m / kRho_kg_m3;
  return still * ventilation(air_mps, 2.0 * kVapourLayer_m);
}

// Where the look shows a texel's lone bead, and one of them where there are several (the drop is of a mean
// one then, and may begin beside any): there it goes on as a drop.
glm::dvec2 beadPlace(const PaneMap& map, int texel, double radius_m) {
  const shared::SeatedBead bead = shared::seatedBead(static_cast<uint32_t>(texel), glm::vec2(0.0f), 1,
                                                     static_cast<float>(radius_m / map.grid().texel_m));
  const glm::vec2 corner(texel % map.grid().size.x, texel / map.grid().size.x);
  const glm::dvec2 place = glm::dvec2(shared::gridPlace(corner + bead.middle)) * map.grid().texel_m;
  return map.texelAt(place) >= 0 ? place : map.middleOf(texel);
}

}  // namespace

PaneSim::State::State(const PaneInfo& info, uint32_t pane_id, uint64_t pane_seed)
    : name(info.name),
      id(pane_id),
      seed(pane_seed),
      film_enabled(info.film_enabled),
      fingerprint(fingerprintOf(info)),
      surface(surfaceFor(info)),
      map(info),
      mean_normal(meanNormal(map)),
      most_per_m2(mostPer_m2(map)),
      uneven(map, chance(), info.unevenness),
      mesh(info, map),
      slide(info, map),
      film(map, ledger),
      drops(map, surface, info.max_drops),
      craters(map) {}

// One tick, stage by stage.
void PaneSim::State::run(const PaneTick& tick) {
  now = tick;
  ++ticks;
  snapshot.reset();
  if (ticks % kTicksPerFilmStep == 1) slideWindow();
  forces.make(map, tick.acceleration_mps2, tick.air_mps, tick.opening_m * slide.direction());
  if (ticks % kTicksPerFilmStep == 0) useReport();
  catchRain();
  catchRunOff();
  for (uint32_t i = 0; i < tick.washing_count; ++i) wash(tick.washings[i], i);
  const DropWorld shared_world = world();
  drops.move(shared_world);
  for (const GoneDrop& gone : drops.overEdges()) runOff(map.tileOf(gone.texel), gone.volume_pl);
  drops.merge(shared_world);
  for (uint32_t i = 0; i < tick.wiper_count; ++i) blades.stroke(shared_world, drops, tick.wipers[i]);
  drops.age(shared_world);
  if (ticks % kTicksPerFilmStep != 0) return;
  craters.forget(ticks);
  closeFilmStep();
}

// In the first tick of a film step, before all that happens in it. The seal strips what goes behind the sill:
// that water runs off there, as what runs down to the sill does, and counts with it as drained.
void PaneSim::State::slideWindow() {
  if (film.leaving()) return;
  const size_t last = slid;
  slid = slide.goneAt(map, now.opening_m);
  const bool dry = ledger.caught_pl == 0;
  if (film.attached() && !dry) slid = std::min(slid, last + kMostStripped);
  std::vector<int> texels;
  for (size_t i = std::min(last, slid); i < std::max(last, slid); ++i) texels.push_back(slide.texel(map, i));
  if (!texels.empty()) map.show(texels, slid < last);
  if (film.attached()) {
    for (size_t i = slid; i < slid_on_film; ++i) film.slide(slide.texel(map, i), true);
    for (size_t i = slid_on_film; i < slid; ++i) {
      if (i >= last && !dry) film.strip(slide.texel(map, i));
      film.slide(slide.texel(map, i), false);
    }
    slid_on_film = slid;
  }
  if (slid > last) ledger.drained_pl += drops.removeHidden();
}

void PaneSim::State::catchRain() {
  findImpacts(map, now, seed, id, impacts);
  const DropWorld shared_world = world();
  const double rewetting_hz = impacts.empty() ? 0.0 : lamellae_hz(map, now);
  for (const Impact& impact : impacts) {
    ledger.caught_pl += impact.volume_pl;
    const bool in_film = drops.impact(shared_world, impact, rewetting_hz);
    if (in_film) craters.add(impact, film.thickness_m(impact.texel), forces, ticks);
  }
}

void PaneSim::State::catchRunOff() {
  for (const auto& pillar : pillars_on) {
    for (const Trickle& trickle : pillar->arrived(now.moment)) {
      if (!map.shown(trickle.texel)) continue;
      ledger.caught_pl += trickle.volume_pl;
      ledger.run_on_pl += trickle.volume_pl;
      addDrop(map.middleOf(trickle.texel), trickle.texel, trickle.volume_pl);
    }
  }
}

void PaneSim::State::runOff(size_t tile, int64_t volume_pl) const {
  for (const auto& pillar : pillars_off) pillar->give(now.moment, tile, volume_pl, now.run_off);
}

void PaneSim::State::tellOwed() const {
  for (const auto& pillar : pillars_off)
    pillar->owes(waiting.empty() ? Pillar::kNone : waiting.front().tick.moment);
}

// A jet hits the glass and spreads there: its water is film at once.
void PaneSim::State::wash(const Washing& washing, uint32_t number) {
  constexpr int64_t kParcels = 16;
  constexpr double kSpread_m = 6e-3;  // unsourced
  Stream random(seed, id, static_cast<uint64_t>(now.index), kWashStream + number);
  for (int64_t k = 0; k < kParcels; ++k) {
    const int64_t volume_pl = washing.volume_pl * (k + 1) / kParcels - washing.volume_pl * k / kParcels;
    const int texel = washing.jet->texelAt(random.unit());
    if (!map.shown(texel)) continue;
    ledger.caught_pl += volume_pl;
    const glm::dvec2 place = map.middleOf(texel);
    film.spread(place, forces.at(map, place).metres, kSpread_m, volume_pl);
  }
}

// Film that is too thick and beads that are too large become drops, and drops get what they ran over.
void PaneSim::State::useReport() {
  FilmReport report;
  std::vector<Taker> takers;
  if (!film.use(stepUsedBy(ticks), report, takers)) return;
  const DropWorld shared_world = world();
  for (size_t i = 0; i < takers.size(); ++i) {
    if (takers[i].slot == kSeal)
      ledger.drained_pl += report.taken_pl[i];
    else
      drops.give(shared_world, takers[i], report.taken_pl[i]);
  }
  for (size_t i = 0; i < report.tiles.size() && !pillars_off.empty(); ++i)
    runOff(i, int64_t{report.tiles[i].drained_pl} + report.tiles[i].blown_pl);
  for (const ThrownOff& thrown : report.thrown) {
    if (thrown.texel >= 0) runOff(map.tileOf(thrown.texel), thrown.volume_pl);
  }
  for (const shared::FilmTile& tile : report.tiles) {
    if (tile.event_texel < 0 || tile.event_pl <= 0) continue;
    addDrop(beadPlace(map, tile.event_texel, restingRadius_m(tile.event_pl)), tile.event_texel,
            tile.event_pl);
  }
}

// Film where there is no room for another.
void PaneSim::State::addDrop(glm::dvec2 place_m, int texel, int64_t volume_pl) {
  const uint32_t h =
      shared::pcg(static_cast<uint32_t>(texel) ^ shared::pcg(static_cast<uint32_t>(now.index)));
  if (drops.add(world(), place_m, volume_pl, restingRadius_m(volume_pl), h) < 0) film.add(texel, volume_pl);
}

void PaneSim::State::closeFilmStep() {
  shared::FilmStepInfo info{};
  info.columns = map.grid().size.x;
  info.rows = map.grid().size.y;
  info.step = static_cast<uint32_t>(now.index);
  info.pane = chance();
  info.up_x = static_cast<float>(map.up().x);
  info.up_y = static_cast<float>(map.up().y);
  info.pin_m = static_cast<float>(surface.pin_m);
  info.front_m = static_cast<float>(surface.front_m);
  info.rupture_m = static_cast<float>(surface.rupture_m);
  const double room = drops.capacity() == 0
                          ? 0.0
                          : 1.0 - static_cast<double>(drops.count()) / static_cast<double>(drops.capacity());
  info.rupture_chance = drops.capacity() == 0
                            ? 0.0f
                            : static_cast<float>(std::min(1.0, surface.rupture_hz * shared::kDryingSteps *
                                                                   kTicksPerFilmStep * kTickSeconds));
  info.drops_allowed = room > 0.1 ? 1 : 0;
  const double saturated_kg_m3 = saturatedVapour_kg_m3(now.temperature_c),
               air_mps = 0.5 * glm::length(now.air_mps);
  info.evaporation_mps = static_cast<float>(filmEvaporation_mps(now.humidity, saturated_kg_m3, air_mps));
  const double angle = meanAngle(surface);
  setBeadShape(info, surface);
  info.bead_drying_pl_mm = static_cast<float>(
      evaporation_kg_s(1e-3, angle, std::min(now.humidity, 1.0), saturated_kg_m3) / kRho_kg_m3 *
      kPicolitresPerM3 * shared::kDryingSteps * kTicksPerFilmStep * kTickSeconds);
  info.bead_airing = static_cast<float>(ventilation(air_mps, 2e-3) - 1.0);
  shared::setLevelling(info, static_cast<float>(-glm::dot(now.acceleration_mps2, mean_normal)), most_per_m2);
  film.close(ticks / kTicksPerFilmStep, forces.filmDrive(), info);
}

void PaneSim::State::runWaiting() {
  while (!waiting.empty() && ready()) {
    const Waiting next = std::move(waiting.front());
    waiting.pop_front();
    run(next.tick);
    place(next.placed);
  }
  tellOwed();
}

// The oldest of those that wait; what water it was told to bring comes with the next.
void PaneSim::State::leaveOutATick() {
  const Waiting left = std::move(waiting.front());
  waiting.pop_front();
  ++dropped_ticks;
  Waiting& next = waiting.front();
  next.placed.insert(next.placed.begin(), left.placed.begin(), left.placed.end());
  PaneTick& tick = next.tick;
  for (uint32_t i = 0; i < left.tick.washing_count; ++i) {
    const Washing& washing = left.tick.washings[i];
    uint32_t same = 0;
    while (same < tick.washing_count && tick.washings[same].jet != washing.jet) ++same;
    if (same < tick.washing_count)
      tick.washings[same].volume_pl += washing.volume_pl;
    else if (same < kMostWashings)
      tick.washings[tick.washing_count++] = washing;
    else
      tick.washings.back().volume_pl += washing.volume_pl;
  }
}

void PaneSim::State::checkPlaces(std::span<const PlacedDrop> list) const {
  for (const PlacedDrop& drop : list) {
    const bool sound = drop.base_radius_m >= 1e-5 && drop.base_radius_m <= 0.02 &&
                       drop.contact_angle_rad > 0.017 && drop.contact_angle_rad < 2.97;
    if (!sound)
      throw std::invalid_argument("pane '" + name +
                                  "': a placed drop's base radius or contact angle is out of range");
    if (map.texelAt(map.gridFromGlass({drop.u_m, drop.v_m})) < 0) {
      throw std::invalid_argument("pane '" + name + "': a placed drop lies off the pane");
    }
  }
  if (list.size() > drops.capacity() - drops.count())
    throw std::invalid_argument("pane '" + name + "': has no room for so many drops");
}

void PaneSim::State::place(std::span<const PlacedDrop> list) {
  snapshot.reset();
  if (forces.empty()) forces.make(map, now.acceleration_mps2, now.air_mps);
  const DropWorld shared_world = world();
  for (const PlacedDrop& drop : list) {
    const int64_t volume_pl =
        picolitres(capShape(drop.contact_angle_rad) * std::pow(drop.base_radius_m, 3.0));
    if (drops.add(shared_world, map.gridFromGlass({drop.u_m, drop.v_m}), volume_pl, drop.base_radius_m,
                  kRoundSeed, true) >= 0) {
      ledger.caught_pl += volume_pl;
    }
  }
}

PaneSim::PaneSim(const PaneInfo& info, uint32_t id, uint64_t seed)
    : state_(std::make_unique<State>(info, id, seed)) {}
// Its neighbours wait for it no longer.
PaneSim::~PaneSim() {
  state_->waiting.clear();
  state_->tellOwed();
}

const PaneMap& PaneSim::map() const { return state_->map; }
const UnevenGlass& PaneSim::unevenness() const { return state_->uneven; }
const PaneMesh& PaneSim::mesh() const { return state_->mesh; }
const Slide& PaneSim::slide() const { return state_->slide; }
const std::string& PaneSim::name() const { return state_->name; }

void PaneSim::setWiper(uint32_t id, const WiperInfo& info) {
  const std::lock_guard lock(state_->mutex);
  state_->blades.set(id, info, state_->map, state_->film);
}

void PaneSim::setAirflow(Airflow airflow) {
  const std::lock_guard lock(state_->mutex);
  state_->forces.setAirflow(std::move(airflow));
}

void PaneSim::setPillars(std::vector<std::shared_ptr<Pillar>> off, std::vector<std::shared_ptr<Pillar>> on) {
  const std::lock_guard lock(state_->mutex);
  state_->pillars_off = std::move(off);
  state_->pillars_on = std::move(on);
  state_->tellOwed();
}

void PaneSim::removeWiper(uint32_t id) {
  const std::lock_guard lock(state_->mutex);
  state_->blades.remove(id, state_->film);
}

void PaneSim::placeDrops(std::span<const PlacedDrop> drops) {
  const std::lock_guard lock(state_->mutex);
  state_->checkPlaces(drops);
  if (state_->waiting.empty()) {
    state_->place(drops);
  } else {
    std::vector<PlacedDrop>& later = state_->waiting.back().placed;
    later.insert(later.end(), drops.begin(), drops.end());
  }
}

void PaneSim::submit(const PaneTick& tick) {
  const std::lock_guard lock(state_->mutex);
  state_->waiting.push_back({tick, {}});
  state_->runWaiting();
  while (state_->waiting.size() > kMostWaiting) state_->leaveOutATick();
  state_->tellOwed();
}

void PaneSim::reset() {
  const std::lock_guard lock(state_->mutex);
  state_->waiting.clear();
  // Off it too: a neighbour's reset may have come before a last tick of this one, which other threads run.
  for (const auto& pillar : state_->pillars_on) pillar->clear();
  for (const auto& pillar : state_->pillars_off) pillar->clear();
  state_->tellOwed();
  state_->drops.clear();
  state_->craters.clear();
  // Film steps end with the same ticks as on a new pane; the one that this cuts short there never was.
  state_->ticks += state_->ticks % kTicksPerFilmStep;
  state_->film.skipTo(state_->ticks / kTicksPerFilmStep + 1);
  state_->film.clear();
  state_->slid_on_film = 0;
  state_->blades.clear();
  state_->ledger = {};
  state_->forces.clear();
  state_->now = {};
  state_->dropped_ticks = 0;
  state_->snapshot.reset();
}

std::shared_ptr<const PaneSnapshot> PaneSim::snapshot() const {
  const std::lock_guard lock(state_->mutex);
  if (state_->snapshot) return state_->snapshot;
  auto made = std::make_shared<PaneSnapshot>();
  made->tick = state_->now.index;
  made->blades = state_->blades.moving();
  made->advancing_rad = state_->surface.advancing_rad;
  made->bead_contact_rad = meanAngle(state_->surface);
  made->craters = state_->craters.at(state_->ticks);
  made->drops.reserve(state_->drops.count());
  for (const Drop& drop : state_->drops.all()) {
    if (drop.volume_pl == 0) continue;
    shared::GlassDropRecord record{};
    record.position_m = glm::vec2(drop.place_m);
    const glm::vec2 metres = drop.pose == Pose::moving
                                 ? glm::vec2(state_->forces.at(state_->map, drop.place_m).metres)
                                 : glm::vec2(1.0f);
    record.velocity_mps = drop.velocity_mps / metres;
    record.heading = drop.heading;
    record.base_radius_m = drop.base_radius_m;
    record.height_m = drop.height_m;
    record.elongation = drop.elongation;
    record.seed = drop.seed;
    record.corner = drop.corner;
    made->drops.push_back(record);
  }
  return state_->snapshot = std::move(made);
}

PaneStats PaneSim::stats() const {
  const std::lock_guard lock(state_->mutex);
  const Ledger& ledger = state_->ledger;
  PaneStats out;
  out.drops = state_->drops.count();
  out.area_m2 = state_->map.area_m2();
  out.caught_pl = ledger.caught_pl;
  out.run_on_pl = ledger.run_on_pl;
  out.drained_pl = ledger.drained_pl;
  out.wiped_pl = ledger.wiped_pl;
  out.blown_pl = ledger.blown_pl;
  out.evaporated_pl = ledger.evaporated_pl;
  out.film_pl = state_->film.film_pl();
  out.beads_pl = state_->film.beads_pl();
  out.ridge_pl = state_->film.ridge_pl();
  out.travelling_pl = state_->film.travelling_pl();
  out.drops_pl = state_->drops.volume_pl();
  out.on_glass_pl = out.film_pl + out.beads_pl + out.drops_pl + out.ridge_pl + out.travelling_pl;
  out.dropped_ticks = state_->dropped_ticks;
  return out;
}

uint64_t PaneSim::hash() const {
  const std::lock_guard lock(state_->mutex);
  const Ledger& ledger = state_->ledger;
  uint64_t h = state_->drops.hash(0xcbf29ce484222325ull);
  for (const int64_t value : {ledger.caught_pl, ledger.gone_pl(), state_->film.travelling_pl(),
                              state_->film.film_pl(), state_->film.beads_pl()}) {
    h = (h ^ static_cast<uint64_t>(value)) * 0x100000001b3ull + (h >> 29);
  }
  return h;
}

void PaneSim::attachFilm() {
  const std::lock_guard lock(state_->mutex);
  if (!state_->film_enabled || state_->film.attached()) return;
  state_->film.attach();
  // What is behind the sill is none of its glass, from its first step on.
  for (size_t i = 0; i < state_->slid; ++i) state_->film.slide(state_->slide.texel(state_->map, i), false);
  state_->slid_on_film = state_->slid;
}

void PaneSim::detachFilm() {
  const std::lock_guard lock(state_->mutex);
  state_->film.detach();
  state_->runWaiting();
}

std::vector<FilmOrder> PaneSim::fetchOrders() {
  const std::lock_guard lock(state_->mutex);
  return state_->film.fetch();
}

void PaneSim::deliver(FilmReport&& report) {
  const std::lock_guard lock(state_->mutex);
  state_->film.deliver(std::move(report));
  state_->runWaiting();
}

bool PaneSim::resume() {
  const std::lock_guard lock(state_->mutex);
  const int64_t before = state_->ticks;
  state_->runWaiting();
  return state_->ticks != before;
}

bool PaneSim::waiting() const {
  const std::lock_guard lock(state_->mutex);
  return !state_->waiting.empty();
}

}  // namespace rg::glass
