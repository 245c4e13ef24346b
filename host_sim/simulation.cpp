#include "simulation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "drive/ticks.h"

namespace host {
namespace {

constexpr double kAdaptation_s = 0.6;     // a driver's eye over the first decades (unsourced)
constexpr int64_t kAdaptationTicks = 12;  // ten times a second
// A driver's eye, and a camera that is to look like one, goes only part of the way from day to a tunnel's
// light: the cabin, the lit screens and the bright mouth are seen too (unsourced).
constexpr double kAdaptedShare = 0.6;
constexpr double kRoadDries_mm_per_s = 0.2 / 3600.0;  // on a mild day with traffic (unsourced)
constexpr double kMostOnRoad_mm = 1.0;                // the rest runs off
constexpr int64_t kSensorTicks = 30;                  // four times a second
constexpr double kChaseBehind_m = 6.5, kChaseUp_m = 2.3;
// Just before the nose of a car of usual length (4.3 m), at a seated driver's height: the world without
// glass.
const glm::dvec3 kBumper_m(3.6, 0.0, 1.2);
constexpr double kNear_m = 0.05;         // nothing of a car is as close to the cameras above
constexpr double kNearOfLens_m = 0.005;  // the glass of a camera of the car's own may be

std::vector<glm::dvec3> routePoints(const RoadView& road) {
  if (!road.route) return {glm::dvec3(0.0), glm::dvec3(10000.0, 0.0, 0.0)};
  return {road.route->points_m.begin(), road.route->points_m.end()};
}

glm::dmat4 lookAlong(const glm::dvec3& eye, const glm::dvec3& forward, const glm::dvec3& up) {
  return glm::lookAt(eye, eye + forward, up);
}

const CameraView* cameraOf(const CarView& car, const std::string& name) {
  const auto found = std::ranges::find(car.cameras, name, &CameraView::name);
  return found == car.cameras.end() ? nullptr : &*found;
}

// Before the drive begins; at 0 s it is under way, and rain passes by it as fast as that.
void stand(CarState& car) { car.velocity_mps = car.angular_velocity_radps = glm::dvec3(0.0); }

}  // namespace

std::vector<std::string> cameraNames(const CarView& car) {
  std::vector<std::string> names{"cockpit", "bumper", "outside", "front", "side", "free"};
  for (const CameraView& camera : car.cameras) {  // one of the same name takes its place
    if (std::ranges::find(names, camera.name) == names.end()) names.push_back(camera.name);
  }
  return names;
}

Simulation::Simulation(const Scenario& scenario, const CarView& car, const RoadView& road, RainPlugin& plugin,
                       glm::ivec2 size_px)
    : camera(scenario.camera),
      scenario_(scenario),
      car_(car),
      plugin_(plugin),
      size_px_(size_px),
      route_(routePoints(road), road.route && road.route->closed),
      driver_(route_, scenario.plan),
      prewarm_ns_(static_cast<int64_t>(std::ceil(scenario.prewarm_s)) * 1'000'000'000) {
  const std::vector<std::string> names = cameras();
  if (std::ranges::find(names, camera) == names.end()) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    throw InputError("camera \"" + camera + "\" is none of " + all);
  }
  for (const auto& [pane, opening_m] : scenario.windows) {
    const auto found = std::ranges::find(car.panes, pane, &PaneView::name);
    if (found == car.panes.end()) throw InputError("windows." + pane + ": the car has no pane of that name");
    windows_.emplace_back(static_cast<uint32_t>(found - car.panes.begin() + 1), &opening_m);
  }
  // As if it had rained for ten minutes as it does at the start.
  water_on_road_mm_ = std::min(kMostOnRoad_mm, scenario.rain_mm_h.at(0.0) / 6.0);
  free_camera.position_m = driver_.state().position_m + glm::dvec3(-8.0, 3.0, 2.5);
}

double Simulation::timeS() const {
  return static_cast<double>(hostTickNs(std::max<int64_t>(tick_, 0)) - prewarm_ns_) * 1e-9;
}

Weather Simulation::weather() const {
  const double t = std::max(0.0, timeS());
  Weather w;
  w.rain_mm_h = overrides.rain_mm_h.value_or(scenario_.rain_mm_h.at(t));
  w.snow_mm_h = overrides.snow_mm_h.value_or(scenario_.snow_mm_h.at(t));
  w.hail_mm_h = overrides.hail_mm_h.value_or(scenario_.hail_mm_h.at(t));
  w.wind_mps =
      overrides.wind_mps.value_or(glm::dvec3(scenario_.wind_x_mps.at(t), scenario_.wind_y_mps.at(t), 0.0));
  w.temperature_c = scenario_.temperature_c.at(t);
  w.humidity = scenario_.humidity.at(t);
  w.visibility_m = scenario_.visibility_m.at(t);
  return w;
}

void Simulation::resume() {
  knots_.clear();
  cut_ = false;
  if (overrides.controls)
    driver_.takeOver();
  else if (driver_.byHand())
    driver_.giveBack();
}

void Simulation::advance(int64_t time_ns) {
  const int64_t until_ns = pluginTime(time_ns);
  if (tick_ < 0) {
    tick_ = 0;
    tell();
  }
  while (hostTickNs(tick_ + 1) <= until_ns) tick();
}

void Simulation::tick() {
  ++tick_;
  const double t = timeS();
  if (t > 0.0) {
    if (overrides.controls)
      driver_.tick(*overrides.controls);
    else
      driver_.tick();
  }
  tickWipers();
  tickDemister();
  const double rain_mm = weather().rain_mm_h / 3600.0 * kHostTickSeconds;
  water_on_road_mm_ =
      std::clamp(water_on_road_mm_ + rain_mm - kRoadDries_mm_per_s * kHostTickSeconds, 0.0, kMostOnRoad_mm);
  if (adapting_luminance && tick_ % kAdaptationTicks == 0) {
    const double here = std::log(std::max(1e-4, adapting_luminance(eyeOf(driver_.state()).position_m)));
    if (!adapted_) day_log_luminance_ = here;
    day_log_luminance_ = std::max(day_log_luminance_, here);
    const double target = std::lerp(day_log_luminance_, here, kAdaptedShare);
    const double share =
        adapted_ ? 1.0 - std::exp(-kHostTickSeconds * kAdaptationTicks / kAdaptation_s) : 1.0;
    log_luminance_ += (target - log_luminance_) * share;
    adapted_ = true;
  }
  tell();
}

// What the sensor knows does not depend on how time is cut: the plugin is brought to a time of its own for
// it.
void Simulation::tickWipers() {
  const double t = timeS();
  wiper_mode_ = overrides.wipers.value_or(wiperModeAt(scenario_, std::max(0.0, t)));
  if (wiper_mode_ != WiperMode::automatic) {
    motor_.setMode(wiper_mode_, overrides.wiper_pause_s.value_or(scenario_.wiper_pause_s));
  } else {
    if (tick_ % kSensorTicks == 0 && !car_.wipers.empty()) {
      plugin_.update(hostTickNs(tick_ - 1));
      const rg_pane_stats seen = plugin_.paneStats(car_.wipers.front().pane_index);
      sensor_.sense((seen.caught_ml - seen.run_on_ml) * 1e-6, seen.area_m2, t);
    }
    motor_.setMode(sensor_.mode(), sensor_.pause_s());
  }
  const double before_s = t - kHostTickSeconds;
  if (std::ranges::any_of(scenario_.washes, [&](double at) { return at > before_s && at <= t; })) wash();
  const int64_t begin_ns = hostTickNs(tick_ - 1);
  for (const WiperKnotShare& knot : motor_.tick()) {
    // A tick is no whole number of nanoseconds: its end is told to the last one, so that nothing is to be
    // guessed beyond it.
    const int64_t at_ns = knot.seconds_into_tick < kHostTickSeconds
                              ? begin_ns + static_cast<int64_t>(knot.seconds_into_tick * 1e9)
                              : hostTickNs(tick_);
    for (size_t i = 0; i < car_.wipers.size(); ++i) {
      knots_.push_back({at_ns, static_cast<uint32_t>(i + 1), 0,
                        knot.share * static_cast<double>(car_.wipers[i].sweep_rad)});
    }
  }
}

// Switched between two ticks, however updates lie: the plugin is brought to that time for it.
void Simulation::tickDemister() {
  double share = demister_;
  for (const auto& [at_s, then] : scenario_.demister) {
    if (timeS() >= at_s) share = then;
  }
  if (share == demister_) return;
  demister_ = share;
  plugin_.update(hostTickNs(tick_ - 1));
  plugin_.setParameter("fog.demister", share);
}

void Simulation::wash() {
  plugin_.wash(car_, hostTickNs(std::max<int64_t>(tick_, 0)));
  motor_.wipe(kWashCycles);
}

void Simulation::tell() {
  Moment m;
  m.time_ns = hostTickNs(tick_);
  m.car = driver_.state();
  if (timeS() < 0.0) stand(m.car);
  m.traffic = trafficAt(m.time_ns - prewarm_ns_);
  const Weather w = weather();
  plugin_.api().default_weather(&m.weather);
  m.weather.rain_mm_h = w.rain_mm_h;
  m.weather.snow_mm_h = w.snow_mm_h;
  m.weather.hail_mm_h = w.hail_mm_h;
  m.weather.ground_height_m = m.car.position_m.z;  // the road's, where the car stands on it
  for (int i = 0; i < 3; ++i) m.weather.wind_mps[i] = w.wind_mps[i];
  m.weather.temperature_c = w.temperature_c;
  m.weather.humidity = w.humidity;
  m.weather.visibility_m = w.visibility_m;
  m.view = viewOf(m.car);
  m.view.discontinuity = cut_ || camera != camera_before_ ? 1 : 0;
  camera_before_ = camera;
  cut_ = false;
  m.knots = std::move(knots_);
  knots_.clear();
  for (const auto& [pane, opening_m] : windows_)
    m.openings.push_back({m.time_ns, pane, 0, opening_m->at(std::max(0.0, timeS()))});
  plugin_.tell(std::move(m));
}

CarState Simulation::carAt(int64_t time_ns) const {
  const double since_s =
      static_cast<double>(pluginTime(time_ns) - hostTickNs(std::max<int64_t>(tick_, 0))) * 1e-9;
  const bool before = timeS() < 0.0;
  CarState car = driver_.at(before ? 0.0 : since_s);
  if (before) stand(car);
  return car;
}

std::vector<CarState> Simulation::trafficAt(int64_t time_ns) const {
  std::vector<CarState> cars;
  for (const TrafficCar& car : scenario_.traffic)
    cars.push_back(host::trafficAt(route_, car, static_cast<double>(time_ns) * 1e-9));
  return cars;
}

Eye Simulation::eyeAt(int64_t time_ns) const { return eyeOf(carAt(time_ns)); }
rg_view Simulation::pluginViewAt(int64_t time_ns) const { return viewOf(carAt(time_ns)); }

Eye Simulation::eyeOf(const CarState& car) const {
  Eye eye;
  double fov_rad = 1.05, near_m = kNear_m;
  const auto toWorld = [&](const glm::dvec3& v) { return car.position_m + car.orientation * v; };
  glm::dvec3 forward, up = car.orientation * glm::dvec3(0.0, 0.0, 1.0);
  if (const CameraView* own = cameraOf(car_, camera)) {
    const auto yaw = static_cast<double>(own->yaw_rad), pitch = static_cast<double>(own->pitch_rad);
    eye.position_m = toWorld(glm::dvec3(own->position_m));
    forward = car.orientation *
              glm::dvec3(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
    fov_rad = static_cast<double>(own->fov_rad);
    eye.inside = own->inside;
    near_m = kNearOfLens_m;
  } else if (camera == "cockpit") {
    const double pitch = static_cast<double>(car_.eye.pitch_rad);
    eye.position_m = toWorld(glm::dvec3(car_.eye.position_m));
    forward = car.orientation * glm::dvec3(std::cos(pitch), 0.0, std::sin(pitch));
    fov_rad = static_cast<double>(car_.eye.fov_rad);
    eye.inside = true;
  } else if (camera == "bumper") {
    eye.position_m = toWorld(kBumper_m);
    forward = car.orientation * glm::dvec3(1.0, 0.0, 0.0);
  } else if (camera == "free") {
    eye.position_m = free_camera.position_m;
    forward = {std::cos(free_camera.yaw_rad) * std::cos(free_camera.pitch_rad),
               std::sin(free_camera.yaw_rad) * std::cos(free_camera.pitch_rad),
               std::sin(free_camera.pitch_rad)};
    up = {0.0, 0.0, 1.0};
  } else {
    // Seen from around the car, level with the horizon: at it from behind, the front, the left side.
    const glm::dvec3 place = camera == "front"  ? glm::dvec3(6.0, 1.3, 1.7)
                             : camera == "side" ? glm::dvec3(1.2, 4.5, 1.5)
                                                : glm::dvec3(-kChaseBehind_m, 0.0, kChaseUp_m);
    const glm::dvec3 at = camera == "outside" ? glm::dvec3(3.0, 0.0, 1.1) : glm::dvec3(1.4, 0.0, 0.85);
    const glm::dvec3 heading = car.orientation * glm::dvec3(1.0, 0.0, 0.0);
    const glm::dquat level = glm::angleAxis(std::atan2(heading.y, heading.x), glm::dvec3(0.0, 0.0, 1.0));
    eye.position_m = car.position_m + level * place;
    forward = glm::normalize(car.position_m + level * at - eye.position_m);
    up = {0.0, 0.0, 1.0};
  }
  eye.velocity_mps = camera == "free" ? glm::dvec3(0.0)
                                      : car.velocity_mps + glm::cross(car.angular_velocity_radps,
                                                                      eye.position_m - car.position_m);
  eye.view.eye_from_world = lookAlong(eye.position_m, forward, up);
  eye.view.projection = reversedPerspective(fov_rad, size_px_, near_m);
  return eye;
}

rg_view Simulation::viewOf(const CarState& car) const {
  const Eye eye = eyeOf(car);
  return pluginView(plugin_.api(), eye.view, size_px_, eye.velocity_mps, eye.inside ? kCarId : 0);
}

}  // namespace host
