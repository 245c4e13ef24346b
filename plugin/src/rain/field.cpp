#include "rain/field.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "rain/field_state.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr int64_t kLongestGap = 2048;        // ticks left out at once; more is a seek
constexpr double kCeilingAboveEye_m = 10.0;  // rain that sets in is first seen there
constexpr double kFilled =
    0.93;  // of the buffer that the expected number may take: 7 % for chance and the cells' edges
constexpr double kThinningStep = 0.02;  // thinning changes in steps, so that it is not felt at every tick

uint64_t mixed(uint64_t a, uint64_t b) {
  uint64_t z = (a + 0x9e3779b97f4a7c15u) ^ (b * 0xd6e8feb86659fd93u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

bool usable(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

// ---- a tick ----

void Field::State::start(const Tick& t) {
  if (!started) {
    epoch = tick = t.index;
    const dvec3 origin_m = !t.vehicles.empty() ? t.vehicles[0].pose.position_m
                           : !t.views.empty()  ? coneOf(t.views[0]).eye_m
                                               : dvec3(0.0);
    frames.start(usable(origin_m) ? origin_m : dvec3(0.0), usableWind(t));
    started = true;
  } else {
    tick = t.index;
    frames.resume(usableWind(t));
  }
  rate.fill(ratesOf(t.weather));
  shelter.restart();
  drops.startCalendar(now());
  running = true;
}

void Field::State::moveTo(const Tick& t) {
  const Rates rates = ratesOf(t.weather);
  for (; tick < t.index; ++tick) rate.add(rates);
}

void Field::State::forgetCells() {
  clearCells();
  followed.reset();
  running = false;
}

void Field::State::clearCells() {
  drops.clear();
  cells.clear();
  border.clear(Border::levelFor(reachPerDiameter()));
  bounced_cell = kNone;
}

void Field::tick(const Tick& t) {
  State& s = *state_;
  if (s.running && (t.index < s.tick || t.index - s.tick > kLongestGap)) seek(t.index);
  if (!s.running && s.started && t.index != s.tick) seek(t.index);
  Shelter::Changes changes;
  bool gust = s.frames.setProfile(s.profile);
  if (!s.running) {
    s.start(t);
  } else {
    s.moveTo(t);
    gust = s.frames.advance(s.time_s(), usableWind(t)) || gust;
  }
  s.ground_m = std::isfinite(t.weather.ground_height_m) ? t.weather.ground_height_m : kNoGround_m;
  changes = s.shelter.advance(s.time_s(), t.vehicles);
  if (s.border.level() != Border::levelFor(s.reachPerDiameter())) s.clearCells();
  s.findClasses();
  s.followViews(t);
  s.emptyLeftCells();
  s.expireDrops();
  if (changes.volumes || changes.bodies || gust) s.retest();
  s.thin();
  s.fillEnteredCells();
}

// Classes of which there is nothing cost nothing. What sets in does so from the ceiling down: the air above
// it, where nobody looked before, is still as empty as it was.
void Field::State::findClasses() {
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    const bool is_about = kind != kBouncedClass && isAbout(kind);
    set_in.set(kind, is_about && !followed.test(kind));
    followed.set(kind, is_about);
  }
}

void Field::State::followViews(const Tick& t) {
  border.follow({t.index, t.views, reachPerDiameter(), followed}, frames);
  ceiling_m = -1e30;
  for (const auto& view : border.views()) {
    if (view->moved) ceiling_m = std::max(ceiling_m, view->eye_m.z + kCeilingAboveEye_m);
  }
}

void Field::State::emptyLeftCells() {
  const uint32_t before = drops.live();
  const std::vector<uint32_t>& left = border.left();
  constexpr size_t kAhead = 4;
  for (size_t i = 0; i < left.size(); ++i) {
    if (i + kAhead < left.size()) drops.fetch(cells[left[i + kAhead]].bunch);
    drops.removeAll(cells[left[i]].bunch, cells[left[i]].key.kind);
    cells.free(left[i]);
  }
  died += before - drops.live();
}

void Field::State::expireDrops() {
  drops.expire(now(), [&](uint32_t slot) {
    if (isStone(shared::rainClassOf(drops[slot]))) fallen.push_back(drops[slot]);
    drops.remove(slot, cells[drops.cellOf(slot)].bunch);
    ++died;
  });
  // In an order of their own: which slots they get does not depend on what the calendar went through.
  std::ranges::sort(fallen, {},
                    [](const RainDrop& s) { return std::tuple(s.id, s.cell_x, s.cell_y, s.cell_z); });
  for (const RainDrop& stone : fallen) bounce(stone);
  fallen.clear();
}

// Keeps the expected number of drops below the buffer's size, by the same share everywhere.
void Field::State::thin() {
  double expected = 0.0;
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    const double cell_m = border.cell_m(kind);
    expected += border.cellsOf(kind) * (cell_m * cell_m * cell_m) * rate.most_m3(kind);
  }
  const double room = kFilled * drops.capacity();
  const double wanted = expected > room ? room / expected : 1.0;
  if (wanted == keep || (std::abs(wanted - keep) < kThinningStep * keep && wanted < 1.0 && wanted > keep))
    return;
  if (wanted > keep) {
    keep = wanted;
    return;
  }
  keep = wanted < 1.0 ? wanted * (1.0 - kThinningStep) : 1.0;
  std::array<double, kClasses> least{};
  for (uint32_t kind = 0; kind < kClasses; ++kind) least[kind] = chanceAt(rate.most_m3(kind), kind);
  for (uint32_t slot = 0; slot < drops.end(); ++slot) {
    if (!drops.alive(slot)) continue;
    const uint32_t kind = shared::rainClassOf(drops[slot]);
    if (static_cast<double>(drops.chanceOf(slot)) > least[kind]) continue;
    drops.remove(slot, cells[drops.cellOf(slot)].bunch);
    ++died;
  }
}

// ---- the rest of the interface ----

Field::Field(const FieldSettings& settings) : state_(std::make_unique<State>(settings)) {}
Field::~Field() = default;

std::string Field::setVolume(uint32_t id, const VolumeInfo& info) { return state_->shelter.set(id, info); }
bool Field::removeVolume(uint32_t id) { return state_->shelter.remove(id); }
bool Field::openToSky(const glm::dvec3& place_m, const glm::dvec3& velocity_mps, uint32_t without) {
  return state_->shelter.openToSky(place_m, velocity_mps, without);
}
void Field::volumesSeen(std::span<const Cone> views, double radius_m, std::vector<NearVolume>& out) const {
  state_->shelter.seen(views, radius_m, out);
}
void Field::volumesNear(std::span<const glm::dvec3> eyes_m, double radius_m,
                        std::vector<NearVolume>& out) const {
  state_->shelter.near(eyes_m, radius_m, out);
}
void Field::removeVehicle(uint32_t vehicle) { state_->shelter.removeVehicle(vehicle); }

void Field::setVisibility(const Visibility& visibility) {
  Visibility& ours = state_->visibility;
  if (std::isfinite(visibility.factor)) ours.factor = std::clamp(visibility.factor, 0.25, 4.0);
  if (std::isfinite(visibility.reference_px))
    ours.reference_px = std::clamp(visibility.reference_px, 100.0, 10000.0);
}

void Field::setWindProfile(const WindProfile& profile) { state_->profile = profile; }

void Field::reset() {
  state_->forgetCells();
  state_->started = false;
  state_->keep = 1.0;
  state_->born = state_->died = state_->sheltered = state_->bounced = 0;
  state_->tests_before = state_->shelter.tests();
}

void Field::seek(int64_t tick_index) {
  State& s = *state_;
  s.forgetCells();
  if (!s.started) return;
  s.tick = tick_index;
  s.frames.jump(s.time_s());
}

void Field::rebase(const dvec3& shift_m) {
  State& s = *state_;
  s.frames.shift(shift_m);
  s.ceiling_m -= shift_m.z;
  s.border.shift(shift_m);
  s.shelter.shift(shift_m);
}

FieldStats Field::stats() const {
  const State& s = *state_;
  FieldStats stats;
  if (s.started) stats.rates = s.rate.now().rates;
  stats.thinning = s.keep;
  stats.live = s.drops.live();
  for (uint32_t kind = 0; kind < kClasses; ++kind)
    stats.live_of[static_cast<uint32_t>(fallClasses()[kind].hydrometeor)] += s.drops.liveOf(kind);
  stats.born = s.born;
  stats.died = s.died;
  stats.bounced = s.bounced;
  stats.sheltered_at_birth = s.sheltered;
  stats.shelter_tests = s.shelter.tests() - s.tests_before;
  stats.uploaded_bytes = s.uploaded;
  return stats;
}

uint64_t Field::hash() const {
  const State& s = *state_;
  uint64_t sum = mixed(static_cast<uint64_t>(s.tick - s.epoch), s.settings.seed);
  for (uint32_t slot = 0; slot < s.drops.end(); ++slot) {
    if (!s.drops.alive(slot)) continue;
    const RainDrop& d = s.drops[slot];
    uint64_t h = mixed(static_cast<uint32_t>(d.cell_x),
                       uint64_t{static_cast<uint32_t>(d.cell_y)} << 32 | static_cast<uint32_t>(d.cell_z));
    h = mixed(h, uint64_t{d.fraction_xy} << 32 | d.fraction_z_class);
    h = mixed(h, uint64_t{d.id} << 32 |
                     static_cast<uint64_t>(std::lround(static_cast<double>(d.diameter_m) * 1e7)));
    sum += mixed(h, s.drops.ends(slot) ? d.end : 0);
  }
  return sum;
}

}  // namespace rg::rain
