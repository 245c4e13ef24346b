#include "rain/field.h"

#include <algorithm>
#include <cmath>

#include "rain/cells.h"
#include "rain/class_frames.h"
#include "rain/drops.h"
#include "rain/region.h"
#include "rain/shelter.h"
#include "rain/standing.h"

namespace rg::rain {
namespace {

using glm::dvec3;

constexpr uint32_t kEndUnits = 1024;         // as shared::kRainEndUnits
constexpr uint32_t kEndless = 1u << 30;      // ticks' units ahead: 2.4 h, longer than any drop stays in view
constexpr double kLongestEnd_s = 8000.0;     // ends beyond are none
constexpr int64_t kLongestGap = 2048;        // ticks left out at once; more is a seek
constexpr double kGoneOn_m = 5.0;            // what an eye may go on from a tick to its pictures
constexpr double kCeilingAboveEye_m = 10.0;  // rain that sets in is first seen there
constexpr double kLeastTurn_radps = 1.0472;  // 60 deg/s: a turn of the view that needs no warning
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

// One view, as far as the field follows it.
struct FollowedView {
  uint32_t id = 0;
  bool told = false;   // in this tick
  bool moved = false;  // `eye_m` and `worldFromEye` are of the tick before
  dvec3 eye_m{0.0};
  glm::dquat worldFromEye{1, 0, 0, 0};
  double streak_m = 0.0;  // of the longest streak, from the drop to its end
  uint32_t current = 0;
  std::array<std::array<RowSet, kClasses>, 2> rows;
};

struct Field::State {
  explicit State(const FieldSettings& given)
      : settings(given),
        drops(std::clamp(given.capacity, 1000u, 4000000u)),
        threshold(drops.capacity(), 0.0f) {
    fresh.reserve(1u << 16);
    left.reserve(1u << 16);
  }

  FieldSettings settings;
  Visibility visibility;
  WindProfile profile;  // from the next tick on
  Drops drops;
  std::vector<float> threshold;  // by slot, as Candidate's
  Cells cells;
  Shelter shelter;
  ClassFrames frames;
  RateHistory rate;
  std::vector<std::unique_ptr<FollowedView>> views;

  bool started = false;  // the lattice has its origin
  bool running = false;  // since the last seek a tick has been
  int64_t epoch = 0, tick = 0;
  double ceiling_m = 0.0;
  double keep = 1.0;  // share of the law's drops that is born
  std::array<uint32_t, kClasses> cells_of{};
  std::vector<uint32_t> fresh;  // cells that came into view in this tick
  std::vector<CellKey> left;    // cells that a view left in this tick
  uint64_t born = 0, died = 0, sheltered = 0, uploaded = 0, tests_before = 0;

  double time_s() const { return static_cast<double>(tick - epoch) * kTickSeconds; }
  uint32_t now() const { return static_cast<uint32_t>(static_cast<uint64_t>(tick - epoch) * kEndUnits); }
  double reachPerDiameter() const { return visibility.factor * visibility.reference_px; }

  void start(const Tick& t);
  void moveTo(const Tick& t);
  void forgetCells();
  void followViews(const Tick& t);
  void followView(FollowedView& view, const ViewState& told);
  void replaceRows(const RowSet& before, const RowSet& after, uint32_t kind);
  void enter(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last);
  void leave(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last);
  void dropLeftCells();
  void emptyCell(uint32_t index);
  void expireDrops();
  void thin();
  dvec3 cellMiddle(const CellKey& key) const;
  bool lookAround(const CellKey& key, bool past);
  void fillCell(uint32_t index);
  bool birth(uint32_t index, const Candidate& candidate, const RateHistory::Entry& then, bool near_volume);
  void retest();
  void retestCell(uint32_t index);
  dvec3 placeOf(const RainDrop& drop) const;
  bool endOf(double after_s, uint32_t& end) const;
  void describe(Picture& picture) const;
};

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
  rate.fill(t.weather.rain_mm_h);
  shelter.restart();
  drops.startCalendar(now());
  running = true;
}

void Field::State::moveTo(const Tick& t) {
  for (; tick < t.index; ++tick) rate.add(t.weather.rain_mm_h);
}

void Field::State::forgetCells() {
  drops.clear();
  cells.clear();
  cells_of.fill(0);
  views.clear();
  running = false;
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
  changes = s.shelter.advance(s.time_s(), t.vehicles);
  s.followViews(t);
  s.dropLeftCells();
  s.expireDrops();
  if (changes.volumes || changes.bodies || gust) s.retest();
  s.thin();
  for (const uint32_t cell : s.fresh) s.fillCell(cell);
  s.fresh.clear();
}

// ---- views and cells ----

void Field::State::followViews(const Tick& t) {
  for (auto& view : views) view->told = false;
  ceiling_m = -1e30;
  for (const ViewState& told : t.views) {
    auto found = std::find_if(views.begin(), views.end(), [&](const auto& v) { return v->id == told.id; });
    if (found == views.end()) {
      views.push_back(std::make_unique<FollowedView>());
      found = views.end() - 1;
      (*found)->id = told.id;
    }
    (*found)->told = true;
    followView(**found, told);
  }
  for (auto& view : views) {
    if (view->told) continue;
    for (uint32_t kind = 0; kind < kClasses; ++kind)
      replaceRows(view->rows[view->current][kind], RowSet{}, kind);
  }
  std::erase_if(views, [](const auto& view) { return !view->told; });
}

void Field::State::followView(FollowedView& view, const ViewState& told) {
  const Cone cone = coneOf(told);
  const glm::dquat worldFromEye = glm::quat_cast(glm::transpose(glm::dmat3(told.eyeFromWorld)));
  const dvec3 velocity = eyeVelocityOf(told);
  double turn = 0.0, surprise_m = 0.0;
  if (view.moved && !told.discontinuity && cone.valid) {
    const dvec3 really = (cone.eye_m - view.eye_m) / kTickSeconds;
    surprise_m = glm::distance(really, velocity) * kTickSeconds;
    turn = 2.0 * std::acos(std::min(1.0, std::abs(glm::dot(worldFromEye, view.worldFromEye)))) / kTickSeconds;
  }
  view.moved = cone.valid;
  view.eye_m = cone.eye_m;
  view.worldFromEye = worldFromEye;
  if (cone.valid) ceiling_m = std::max(ceiling_m, cone.eye_m.z + kCeilingAboveEye_m);

  const uint32_t before = view.current, after = 1 - before;
  view.current = after;
  view.streak_m = 0.0;
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    const ClassLattice& lattice = classLattices()[kind];
    const dvec3 past = frames.velocity(kind) - velocity;
    Margin margin;
    margin.ahead_m = past * (1.25 * kTickSeconds);  // a quarter to spare
    margin.streak_m = past * (0.5 * exposureOf(told));
    view.streak_m = std::max(view.streak_m, glm::length(margin.streak_m));
    const double reach = reachPerDiameter() * 1e-3 * lattice.drops.to_mm;
    margin.sides_m = 0.02 + 1.3 * kTickSeconds * std::max(turn, kLeastTurn_radps) * reach + 1.3 * surprise_m;
    margin.reach_m = reach + 1.25 * kTickSeconds * glm::length(past) + 1.3 * surprise_m;
    findRows(cone, margin, (cone.eye_m - frames.origin(kind)) / lattice.cell_m, lattice.cell_m,
             view.rows[after][kind]);
    replaceRows(view.rows[before][kind], view.rows[after][kind], kind);
    view.rows[before][kind].clear();
  }
}

// Counts the cells that `after` has and `before` had not as entered, and the other way round.
void Field::State::replaceRows(const RowSet& before, const RowSet& after, uint32_t kind) {
  for (int32_t y = after.y0; y < after.y0 + after.ny; ++y) {
    for (int32_t z = after.z0; z < after.z0 + after.nz; ++z) {
      const RowSpan was = before.at(y, z), is = after.at(y, z);
      if (was.first == was.last) {
        enter(kind, y, z, is.first, is.last);
      } else {
        enter(kind, y, z, is.first, std::min(is.last, was.first));
        enter(kind, y, z, std::max(is.first, was.last), is.last);
      }
    }
  }
  for (int32_t y = before.y0; y < before.y0 + before.ny; ++y) {
    for (int32_t z = before.z0; z < before.z0 + before.nz; ++z) {
      const RowSpan was = before.at(y, z), is = after.at(y, z);
      if (is.first == is.last) {
        leave(kind, y, z, was.first, was.last);
      } else {
        leave(kind, y, z, was.first, std::min(was.last, is.first));
        leave(kind, y, z, std::max(was.first, is.last), was.last);
      }
    }
  }
}

void Field::State::enter(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last) {
  for (int32_t x = first; x < last; ++x) {
    bool is_fresh = false;
    const uint32_t index = cells.acquire({x, y, z, kind}, is_fresh);
    if (!is_fresh) continue;
    fresh.push_back(index);
    ++cells_of[kind];
  }
}

void Field::State::leave(uint32_t kind, int32_t y, int32_t z, int32_t first, int32_t last) {
  for (int32_t x = first; x < last; ++x) left.push_back({x, y, z, kind});
}

// After all views have entered theirs: a cell that goes from one view to another stays.
void Field::State::dropLeftCells() {
  for (const CellKey& key : left) {
    const uint32_t index = cells.release(key);
    if (index == kNone) continue;
    emptyCell(index);
    cells.free(index);
    --cells_of[key.kind];
  }
  left.clear();
}

void Field::State::emptyCell(uint32_t index) {
  Cell& cell = cells[index];
  while (cell.first_drop != kNone) {
    drops.remove(cell.first_drop, cell.first_drop);
    ++died;
  }
}

void Field::State::expireDrops() {
  drops.expire(now(), [&](uint32_t slot) {
    drops.remove(slot, cells[drops.cellOf(slot)].first_drop);
    ++died;
  });
}

// Keeps the expected number of drops below the buffer's size, by the same share everywhere.
void Field::State::thin() {
  double expected = 0.0;
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    expected += cells_of[kind] * classLattices()[kind].cell_m3 * rate.wettest().density_m3[kind];
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
  for (uint32_t slot = 0; slot < drops.end(); ++slot) {
    if (!drops.alive(slot)) continue;
    const uint32_t kind = shared::rainClassOf(drops[slot]);
    if (static_cast<double>(threshold[slot]) < keep * rate.wettest().density_m3[kind]) continue;
    drops.remove(slot, cells[drops.cellOf(slot)].first_drop);
    ++died;
  }
}

// ---- births and shelter ----

dvec3 Field::State::cellMiddle(const CellKey& key) const {
  return frames.origin(key.kind) + (dvec3(key.x, key.y, key.z) + 0.5) * classLattices()[key.kind].cell_m;
}

bool Field::State::lookAround(const CellKey& key, bool past) {
  if (shelter.empty()) return false;
  return shelter.lookAround(cellMiddle(key), dvec3(0.5 * classLattices()[key.kind].cell_m),
                            frames.path(key.kind), time_s(), past);
}

void Field::State::fillCell(uint32_t index) {
  const CellKey key = cells[index].key;
  const ClassLattice& lattice = classLattices()[key.kind];
  const double most = keep * rate.wettest().density_m3[key.kind];
  Candidates candidates(settings.seed, key, lattice.cell_m3);
  const Candidate* candidate = &candidates.next();
  if (candidate->threshold_m3 >= most) return;
  const bool near_volume = lookAround(key, true);
  cells[index].near_volume = near_volume;
  const double corner_z = cellMiddle(key).z - 0.5 * lattice.cell_m;
  for (; candidate->threshold_m3 < most; candidate = &candidates.next()) {
    // What rain there is where the drop is was decided when it fell through the ceiling.
    const double z = corner_z + candidate->fraction_z * 0x1p-16 * lattice.cell_m;
    const double delay =
        rate.steady() ? 0.0
                      : std::max(0.0, ceiling_m - z) / lattice.drops.speed_mps * static_cast<double>(kTickHz);
    const RateHistory::Entry& then = rate.ago(static_cast<uint32_t>(std::min(delay, 1e6)));
    if (candidate->threshold_m3 >= keep * then.density_m3[key.kind]) continue;
    if (!birth(index, *candidate, then, near_volume)) return;
  }
}

// False when the buffer is full.
bool Field::State::birth(uint32_t index, const Candidate& candidate, const RateHistory::Entry& then,
                         bool near_volume) {
  const CellKey key = cells[index].key;
  const ClassLattice& lattice = classLattices()[key.kind];
  RainDrop drop{};
  drop.cell_x = key.x;
  drop.cell_y = key.y;
  drop.cell_z = key.z;
  drop.fraction_xy = candidate.fraction_x | candidate.fraction_y << 16;
  drop.fraction_z_class = candidate.fraction_z | key.kind << 16;
  // To a tenth of a micrometre, so that the last digit of a machine's log does not show.
  drop.diameter_m = static_cast<float>(
      std::round(then.law.quantile(lattice.drops.from_mm, lattice.drops.to_mm, candidate.size) * 1e4) * 1e-7);
  drop.id = candidate.id;
  drop.end = now() + kEndless;
  bool ends = false;
  if (near_volume) {
    const dvec3 place = placeOf(drop);
    const ClassPath& path = frames.path(key.kind);
    const double enters_s = shelter.willEnter(place, path, time_s());
    if (enters_s <= 0.0 || shelter.cameThrough(place, path, time_s())) {
      ++sheltered;
      return true;
    }
    ends = endOf(enters_s, drop.end);
  }
  const uint32_t slot = drops.add(drop, index, cells[index].first_drop, ends, now());
  if (slot == kNone) return false;
  threshold[slot] = static_cast<float>(candidate.threshold_m3);
  ++born;
  return true;
}

dvec3 Field::State::placeOf(const RainDrop& drop) const {
  const uint32_t kind = shared::rainClassOf(drop);
  const dvec3 fraction(drop.fraction_xy & 0xffffu, drop.fraction_xy >> 16, drop.fraction_z_class & 0xffffu);
  return frames.origin(kind) + (dvec3(drop.cell_x, drop.cell_y, drop.cell_z) + (fraction + 0.5) * 0x1p-16) *
                                   classLattices()[kind].cell_m;
}

// Rounded down, so that the drop does not outlive its entry.
bool Field::State::endOf(double after_s, uint32_t& end) const {
  const bool ends = after_s < kLongestEnd_s;
  end = now() + (ends ? static_cast<uint32_t>(after_s * kTickHz * kEndUnits) : kEndless);
  return ends;
}

// What has been foreseen is no longer right: drops that may meet a volume, or were to meet one, are asked
// again where they end, also in cells that were not near a volume before. Where they came from has not
// changed: drops that never were stay so.
void Field::State::retest() {
  for (uint32_t index = 0; index < cells.poolSize(); ++index) {
    if (cells[index].views > 0 && cells[index].first_drop != kNone) retestCell(index);
  }
}

void Field::State::retestCell(uint32_t index) {
  Cell& cell = cells[index];
  const bool near_volume = lookAround(cell.key, false);
  if (!near_volume && !cell.near_volume) return;
  cell.near_volume = near_volume;
  for (uint32_t slot = cell.first_drop; slot != kNone;) {
    const uint32_t next = drops.nextInCell(slot);
    const double enters_s =
        near_volume ? shelter.willEnter(placeOf(drops[slot]), frames.path(cell.key.kind), time_s())
                    : kNever_s;
    uint32_t end = 0;
    const bool ends = endOf(enters_s, end);
    if (enters_s <= 0.0) {
      drops.remove(slot, cell.first_drop);
      ++died;
    } else if (ends != drops.ends(slot) || (ends && end != drops[slot].end)) {
      drops.setEnd(slot, end, ends, now());
    }
    slot = next;
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
  state_->born = state_->died = state_->sheltered = 0;
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
  for (auto& view : s.views) view->eye_m -= shift_m;
  s.shelter.shift(shift_m);
}

FieldStats Field::stats() const {
  const State& s = *state_;
  return {
      s.started ? s.rate.now().law.rate_mm_h : 0.0, s.keep,    s.drops.live(), s.born, s.died, s.sheltered,
      s.shelter.tests() - s.tests_before,           s.uploaded};
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

void Field::State::describe(Picture& picture) const {
  picture.tick = tick;
  picture.time_ns = tickTimeNs(tick);
  picture.epoch_ticks = static_cast<uint32_t>(tick - epoch);
  picture.slot_end = drops.end();
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    picture.classes[kind] = {frames.origin(kind), frames.velocity(kind), classLattices()[kind].cell_m,
                             reachPerDiameter()};
  }
  picture.volumes.clear();
  std::vector<dvec3> eyes;
  double streak_m = 0.0;
  for (const auto& view : views) {
    if (!view->moved) continue;
    eyes.push_back(view->eye_m);
    streak_m = std::max(streak_m, view->streak_m);
  }
  shelter.near(eyes, reachPerDiameter() * 1e-3 * kLargest_mm + streak_m + kGoneOn_m, picture.volumes);
}

void Field::publish(Upload& upload) {
  State& s = *state_;
  for (const uint32_t slot : s.drops.changed()) {
    upload.slots.push_back(slot);
    upload.records.push_back(s.drops[slot]);
  }
  s.uploaded += s.drops.changed().size() * sizeof(RainDrop);
  s.drops.clearChanged();
  s.describe(upload.picture);
}

void Field::publishAll(Upload& upload) {
  State& s = *state_;
  upload.whole = true;
  upload.slots.clear();
  upload.records.clear();
  for (uint32_t slot = 0; slot < s.drops.end(); ++slot) {
    if (!s.drops.alive(slot)) continue;
    upload.slots.push_back(slot);
    upload.records.push_back(s.drops[slot]);
  }
  s.uploaded += upload.records.size() * sizeof(RainDrop);
  s.drops.clearChanged();
  s.describe(upload.picture);
}

void Field::streaks(const ViewState& view, int64_t time_ns, std::vector<Streak>& out) const {
  const State& s = *state_;
  out.clear();
  Picture picture;
  s.describe(picture);
  const auto setup = std::make_unique<StreakSetup>();
  setUpStreaks(picture, view, time_ns, *setup);
  const dvec3 eye = coneOf(view).eye_m;
  for (uint32_t slot = 0; slot < s.drops.end(); ++slot) {
    if (!s.drops.alive(slot)) continue;
    const RainDrop& drop = s.drops[slot];
    const uint32_t kind = shared::rainClassOf(drop);
    const shared::RainStreak streak =
        shared::rainStreak(drop, setup->classes[kind], setup->view, setup->shelter);
    if (streak.from_s >= streak.to_s) continue;
    const dvec3 place = dvec3(streak.drop_m) + eye, velocity(streak.velocity_mps);
    out.push_back({slot, kind, static_cast<double>(drop.diameter_m), place,
                   place + velocity * static_cast<double>(streak.from_s),
                   place + velocity * static_cast<double>(streak.to_s), static_cast<double>(streak.fade)});
  }
}

}  // namespace rg::rain
