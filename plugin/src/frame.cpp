#include "frame.h"

#include <algorithm>
#include <cmath>

#include "frame_gl.h"
#include "glass/pane_map.h"

namespace rg {
namespace {

constexpr double kTypicalFall_mps = 6.0;  // of the drops that bring most water, at 25 mm/h

// The tick at or before a time: ticks run once their moment has come.
int64_t tickAt(int64_t time_ns) {
  int64_t tick = time_ns / 1'000'000'000 * kTickHz + time_ns % 1'000'000'000 * kTickHz / 1'000'000'000;
  while (tickTimeNs(tick) > time_ns) --tick;
  while (tickTimeNs(tick + 1) <= time_ns) ++tick;
  return tick;
}

}  // namespace

Frame::Frame(const rg_create_info& info)
    : field_({info.max_drops, info.seed}), seed_(info.seed), capacity_(info.max_drops) {
  stage_.rain_tick = timers_.add("rain_tick", false);
  stage_.glass_tick = timers_.add("glass_tick", false);
  stage_.rain_upload = timers_.add("rain_upload", true);
  stage_.glass_step = timers_.add("glass_step", true);
  stage_.captures = timers_.add("captures", true);
  stage_.wetness = timers_.add("wetness", true);
  stage_.splashes = timers_.add("splashes", true);
  stage_.rain_beyond = timers_.add("rain_beyond", true);
  stage_.rain_draw = timers_.add("rain_draw", true);
  stage_.glass_draw = timers_.add("glass_draw", true);
  stage_.finish = timers_.add("finish", true);
}

// An instance that is still attached has no context to free its GL objects in.
Frame::~Frame() {
  if (!gl_) return;
  timers_.forget();
  gl_->forget();
}

// ---- objects ----

void Frame::setVolume(uint32_t id, const rain::VolumeInfo& info) {
  const std::lock_guard lock(sim_);
  const std::string wrong = field_.setVolume(id, info);
  if (!wrong.empty()) refuse(wrong);
  volumes_[id] = info.vehicle;
}

void Frame::removeVolume(uint32_t id) {
  const std::lock_guard lock(sim_);
  if (!field_.removeVolume(id)) refuse("there is no volume " + std::to_string(id), RG_ERROR_NOT_FOUND);
  volumes_.erase(id);
}

void Frame::removeVehicle(uint32_t id) {
  const std::lock_guard lock(sim_);
  bool known = !timeline_.empty() && timeline_.vehicleAt(id, timeline_.last().time_ns).has_value();
  known |= std::erase_if(volumes_, [id](const auto& v) { return v.second == id; }) > 0;
  for (const auto& [pane_id, p] : panes_) {
    if (p.vehicle != id) continue;
    removeWipersOf(pane_id);
    partPane(pane_id);
    std::erase_if(washes_, [on = pane_id](const WashObject& wash) { return wash.pane == on; });
    timeline_.removeOpening(pane_id);
  }
  known |= std::erase_if(panes_, [id](const auto& p) { return p.second.vehicle == id; }) > 0;
  if (!known) refuse("there is no vehicle " + std::to_string(id), RG_ERROR_NOT_FOUND);
  field_.removeVehicle(id);
  timeline_.removeVehicle(id);
}

void Frame::setPane(uint32_t id, uint32_t vehicle, bool active, const glass::PaneInfo& info) {
  auto sim = std::make_shared<glass::PaneSim>(info, id, seed_);
  const std::lock_guard lock(sim_);
  for (const auto& [wiper_id, w] : wipers_) {
    if (w.pane == id) sim->setWiper(wiper_id, w.info);
  }
  PaneObject object;
  object.vehicle = vehicle;
  object.active = active;
  object.sim = std::move(sim);
  if (const auto before = panes_.find(id); before != panes_.end()) object.airflow = before->second.airflow;
  object.sim->setAirflow(object.airflow);
  object.fog = std::make_shared<glass::Fog>(object.sim->map());
  object.demister = info.demister;
  object.mirror = info.mirror;
  object.opening_m = info.opening_m;
  if (gl_) object.sim->attachFilm();
  std::erase_if(washes_, [id](const WashObject& wash) { return wash.pane == id; });  // the glass is another
  timeline_.removeOpening(id);
  partPane(id);
  panes_[id] = std::move(object);
  joinPane(id);
}

// What runs off one pane may come onto another of the same car; mirrors stand apart from the body.
void Frame::joinPane(uint32_t id) {
  const PaneObject& here = panes_.at(id);
  for (const auto& [other_id, other] : panes_) {
    if (other_id == id || other.vehicle != here.vehicle || here.mirror > 0.0 || other.mirror > 0.0) continue;
    const auto join = [this](uint32_t from, uint32_t to) {
      auto pillar = std::make_shared<glass::Pillar>(panes_.at(from).sim->map(), panes_.at(to).sim->map());
      if (pillar->joins()) pillars_[{from, to}] = std::move(pillar);
    };
    join(id, other_id);
    join(other_id, id);
  }
  tellPillars();
}

void Frame::partPane(uint32_t id) {
  std::erase_if(pillars_, [id](const auto& p) { return p.first.first == id || p.first.second == id; });
  tellPillars();
}

void Frame::tellPillars() {
  for (auto& [id, p] : panes_) {
    std::vector<std::shared_ptr<glass::Pillar>> off, on;
    for (const auto& [between, pillar] : pillars_) {
      if (between.first == id) off.push_back(pillar);
      if (between.second == id) on.push_back(pillar);
    }
    p.sim->setPillars(std::move(off), std::move(on));
  }
}

PaneObject& Frame::pane(uint32_t id) {
  const auto found = panes_.find(id);
  if (found == panes_.end()) refuse("there is no pane " + std::to_string(id), RG_ERROR_NOT_FOUND);
  return found->second;
}

// Blades know where their glass lies: a pane with wipers stays shut.
double Frame::openingOf_m(uint32_t id, const PaneObject& p, int64_t time_ns) const {
  const bool wiped = std::ranges::any_of(wipers_, [id](const auto& w) { return w.second.pane == id; });
  return wiped ? 0.0 : timeline_.openingAt(id, time_ns).value_or(p.opening_m);
}

void Frame::removeWipersOf(uint32_t pane) {
  std::erase_if(wipers_, [&](const auto& w) {
    if (w.second.pane != pane) return false;
    timeline_.removeWiper(w.first);
    return true;
  });
}

void Frame::removePane(uint32_t id) {
  const std::lock_guard lock(sim_);
  pane(id);
  removeWipersOf(id);
  std::erase_if(washes_, [id](const WashObject& wash) { return wash.pane == id; });
  timeline_.removeOpening(id);
  partPane(id);
  panes_.erase(id);
}

void Frame::setWiper(uint32_t id, uint32_t pane_id, const glass::WiperInfo& info) {
  const std::lock_guard lock(sim_);
  PaneObject& on = pane(pane_id);
  on.sim->setWiper(id, info);
  const auto known = wipers_.find(id);
  if (known != wipers_.end() && known->second.pane != pane_id) pane(known->second.pane).sim->removeWiper(id);
  wipers_[id] = {pane_id, info};
}

void Frame::removeWiper(uint32_t id) {
  const std::lock_guard lock(sim_);
  const auto found = wipers_.find(id);
  if (found == wipers_.end()) refuse("there is no wiper " + std::to_string(id), RG_ERROR_NOT_FOUND);
  pane(found->second.pane).sim->removeWiper(id);
  wipers_.erase(found);
  timeline_.removeWiper(id);
}

void Frame::placeDrops(uint32_t id, std::span<const glass::PlacedDrop> drops) {
  const std::lock_guard lock(sim_);
  pane(id).sim->placeDrops(drops);
}

void Frame::setAirflow(uint32_t id, glass::Airflow airflow) {
  const std::lock_guard lock(sim_);
  PaneObject& on = pane(id);
  on.airflow = std::move(airflow);
  on.sim->setAirflow(on.airflow);
}

void Frame::wash(const WashOrder& order) {
  const std::lock_guard lock(sim_);
  PaneObject& on = pane(order.pane);
  if (std::ranges::count(washes_, order.pane, &WashObject::pane) >= std::ptrdiff_t{glass::kMostWashings})
    refuse("pane " + std::to_string(order.pane) + " is being washed by " +
           std::to_string(glass::kMostWashings) + " jets already");
  WashObject wash;
  wash.pane = order.pane;
  wash.info = order.jet;
  wash.jet = std::make_shared<const glass::Jet>(order.jet, on.sim->map(), on.sim->name());
  wash.begin_ns = started_ ? std::max(order.time_ns, tickTimeNs(next_tick_ - 1)) : order.time_ns;
  wash.end_ns = wash.begin_ns + std::llround(order.duration_s * 1e9);
  wash.volume_pl = std::llround(order.volume_m3 * wash.jet->share() * 1e15);
  washes_.push_back(std::move(wash));
}

void Frame::setRainPattern(rain::RainPattern pattern) {
  const std::lock_guard lock(sim_);
  pattern_ = std::move(pattern);
  ++pattern_version_;
}

// ---- time ----

rg_result Frame::update(int64_t time_ns, const std::vector<Sample>& samples) {
  const std::lock_guard lock(sim_);
  int64_t after_ns = timeline_.empty() ? INT64_MIN : timeline_.last().time_ns;
  for (const Sample& s : samples) {
    if (s.time_ns <= after_ns) refuse("rg_sample.time_ns does not ascend", RG_ERROR_WRONG_ORDER);
    if (s.time_ns > time_ns) refuse("rg_sample.time_ns is after the update's time", RG_ERROR_WRONG_ORDER);
    after_ns = s.time_ns;
  }
  if (started_ && time_ns < tickTimeNs(next_tick_ - 1))
    refuse("update's time runs backwards; seek() first", RG_ERROR_WRONG_ORDER);
  for (const Sample& s : samples) timeline_.add(s);
  if (timeline_.empty()) refuse("the first update needs a sample", RG_ERROR_WRONG_ORDER);

  tellSettings();
  const int64_t last = tickAt(time_ns);
  if (!started_) {
    next_tick_ = std::min(tickAt(timeline_.first().time_ns), last);
    for (int64_t i = next_tick_ - prewarm_ticks_; i < next_tick_; ++i) runTick(i, true);
    started_ = true;
  }
  const auto most = static_cast<int64_t>(settings_.time_catch_up_s * static_cast<double>(kTickHz));
  const int64_t dropped = std::max<int64_t>(0, last - next_tick_ + 1 - most);
  next_tick_ += dropped;
  for (auto& [id, p] : panes_) p.left_out_ticks += p.active ? static_cast<uint64_t>(dropped) : 0;
  for (; next_tick_ <= last; ++next_tick_) runTick(next_tick_, false);
  timeline_.prune(next_tick_ - 1);
  publish();
  return dropped > 0 ? RG_REMARK_TIME_DROPPED : field_.stats().thinning < 1.0 ? RG_REMARK_THINNED : RG_OK;
}

// To those who run the ticks.
void Frame::tellSettings() {
  timeline_.setGusts({seed_, settings_.wind_gust_share, settings_.wind_gust_time_s});
  timeline_.setByTemperature(settings_.precipitation_by_temperature >= 0.5);
  wind_profile_ = rain::WindProfile::of(settings_.wind_roughness_m, settings_.wind_height_m);
  field_.setWindProfile(wind_profile_);
  field_.setVisibility({settings_.rain_visibility_factor, settings_.rain_reference_px});
  workers_.keep(static_cast<size_t>(settings_.glass_threads));
}

void Frame::runTick(int64_t index, bool rain_only) {
  const Tick& tick = timeline_.tick(index);
  {
    const gl::ScopedStage timed(timers_, stage_.rain_tick);
    field_.tick(tick);
    beyond_.tick(tick, wind_profile_);
    splashes_.tick(tick, wind_profile_);
    wetness_.tick(tick);
  }
  if (rain_only) return;
  const gl::ScopedStage timed(timers_, stage_.glass_tick);
  tickGlass(tick);
}

void Frame::reset() {
  const std::lock_guard lock(sim_);
  timeline_.clear();
  field_.reset();
  beyond_.reset();
  splashes_.reset();
  wetness_.reset();
  washes_.clear();
  for (auto& [id, p] : panes_) {
    p.sim->reset();
    p.fog->reset();
    p.tick = 0;
    p.left_out_ticks = 0;
  }
  started_ = false;
  glass_moment_ = 0;
  prewarm_ticks_ = 0;
  field_.publishAll(upload_);
  publishBeyond();
  publishSplashes();
  publishWetness();
}

void Frame::seek(int64_t time_ns) {
  const std::lock_guard lock(sim_);
  if (timeline_.empty()) refuse("seek before the first update", RG_ERROR_WRONG_ORDER);
  Sample here = timeline_.last();
  here.wiper_knots.clear();
  here.opening_knots.clear();
  for (const auto& [id, p] : panes_) {
    if (const auto opening_m = timeline_.openingAt(id, here.time_ns))
      here.opening_knots.push_back({id, {time_ns, *opening_m}});
  }
  here.time_ns = time_ns;
  timeline_.clear();
  timeline_.add(here);
  next_tick_ = tickAt(time_ns);
  field_.seek(next_tick_);
}

void Frame::prewarm(double seconds) {
  const std::lock_guard lock(sim_);
  if (started_) refuse("prewarm after the first update", RG_ERROR_WRONG_ORDER);
  prewarm_ticks_ = static_cast<int64_t>(std::ceil(seconds * static_cast<double>(kTickHz)));
}

void Frame::rebase(const glm::dvec3& shift_m) {
  const std::lock_guard lock(sim_);
  timeline_.rebase(shift_m);
  field_.rebase(shift_m);
  beyond_.rebase(shift_m);
  splashes_.rebase(shift_m);
  publish();
}

// What nobody fetches (no context, a host that stopped drawing) must not pile up: more changes than drops
// there can be are told as all drops.
void Frame::publish() {
  if (upload_.slots.size() > capacity_)
    field_.publishAll(upload_);
  else
    field_.publish(upload_);
  publishBeyond();
  publishSplashes();
  publishWetness();
}

void Frame::publishBeyond() {
  beyond_.describe(upload_.picture.classes[0].reach_per_diameter, beyond_picture_);
  beyond_picture_.volumes.clear();
  field_.volumesSeen(beyond_.cones(), rain::kBeyondRange_m, beyond_picture_.volumes);
}

void Frame::publishSplashes() {
  splash_picture_ = splashes_.picture();
  field_.volumesNear(splash_picture_.eyes_m, surroundings::kSplashShelter_m, splash_picture_.volumes);
}

void Frame::publishWetness() {
  wetness_picture_.time_ns = splash_picture_.time_ns;
  wetness_picture_.water_mm = wetness_.water_mm();
  wetness_picture_.has_volumes = settings_.wetness_strength > 0.0;
  wetness_picture_.fall_mps = splash_picture_.drift_mps - glm::dvec3(0, 0, kTypicalFall_mps);
  wetness_picture_.origin_m = splash_picture_.origin_m;
  wetness_picture_.volumes.clear();
  if (wetness_picture_.has_volumes)
    field_.volumesNear(splash_picture_.eyes_m, surroundings::kWetShelter_m, wetness_picture_.volumes);
}

// ---- questions ----

double Frame::waterOnGround_mm() {
  const std::lock_guard lock(sim_);
  return wetness_.water_mm();
}

rain::FieldStats Frame::rainStats() {
  const std::lock_guard lock(sim_);
  return field_.stats();
}

bool Frame::nearVolumesFit() const {
  const std::lock_guard lock(sim_);
  return upload_.picture.volumesFit();
}

glass::PaneStats Frame::paneStats(uint32_t id) {
  const std::lock_guard lock(sim_);
  PaneObject& p = pane(id);
  finishGlass();
  glass::PaneStats stats = p.sim->stats();
  stats.dropped_ticks += p.left_out_ticks;
  return stats;
}

uint64_t Frame::hash(bool with_glass) {
  const std::lock_guard lock(sim_);
  uint64_t h = field_.hash();
  if (!with_glass) return h;
  finishGlass();
  for (auto& [id, p] : panes_) {
    const uint64_t film = gl_ ? gl_->filmHash(id) : 0;
    const auto fog = static_cast<uint64_t>(p.fog->stats().condensed_pl + p.fog->stats().on_glass_pl);
    for (const uint64_t part : {uint64_t{id}, p.sim->hash(), film + fog})
      h = (h ^ part) * UINT64_C(0x100000001b3);  // FNV-1a's prime
  }
  for (const auto& [between, pillar] : pillars_) h = (h ^ pillar->hash()) * UINT64_C(0x100000001b3);
  return h;
}

Settings Frame::settings() const {
  const std::lock_guard lock(sim_);
  return settings_;
}

void Frame::set(double Settings::*value, double to) {
  const std::lock_guard lock(sim_);
  settings_.*value = to;
}

}  // namespace rg
