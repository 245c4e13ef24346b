#include "drive.h"

#include "checks.h"
#include "rain/hydrometeors.h"
#include "scene/scene.h"

namespace oracle {
namespace {

constexpr double kG_mps2 = 9.81;

std::vector<Hull> hullsOf(const std::vector<host::ShelterView>& shelters) {
  std::vector<Hull> hulls;
  for (const host::ShelterView& s : shelters) hulls.emplace_back(s.points_m);
  return hulls;
}

host::Scenario scenarioOf(const Variant& v) {
  std::vector<std::string> changes = v.changes;
  if (!v.falls.empty()) {
    const std::vector<std::string>& falls = v.falls == "snow" ? kSnow : v.falls == "sleet" ? kSleet : kHail;
    changes.insert(changes.end(), falls.begin(), falls.end());
  }
  host::Scenario s = host::loadScenario(v.scenario, changes, RG_SOURCE_DIR);
  s.camera = v.camera;
  return s;
}

}  // namespace

// Read once for all drives.
const Drive::Models& Drive::models() {
  static const Models models = [] {
    const std::string folder = std::string(RG_SOURCE_DIR) + "/models/";
    return Models{host::carView(host::loadScene(folder + "car.glb")),
                  host::roadView(host::loadScene(folder + "road.glb"))};
  }();
  return models;
}

Drive::Drive(const Variant& variant, double frame_s)
    : scenario_(scenarioOf(variant)),
      plugin_(rainOnlyApi(), scenario_.seed),
      rain_(rainOnly(plugin_.instance())),
      simulation_(scenario_, models().car, models().road, plugin_, {1280, 720}),
      road_hulls_(hullsOf(models().road.shelters)),
      car_hulls_(hullsOf(models().car.shelters)),
      frame_s_(frame_s) {
  forgetVolumes(!variant.sheltered);
  plugin_.addRoad(models().road);
  plugin_.addCar(models().car);
  for (const auto& [name, value] : scenario_.parameters) plugin_.setParameter(name, value);
  const auto& shelters = models().road.shelters;
  for (size_t i = 0; i < shelters.size(); ++i) {
    if (!variant.brake_for.empty() && shelters[i].name == variant.brake_for) brake_for_ = i;
  }
  if (!variant.brake_for.empty() && !brake_for_) throw std::runtime_error("no shelter " + variant.brake_for);
}

bool Drive::next() {
  const int64_t before_ns = time_ns_;
  time_ns_ = std::llround(static_cast<double>(++frame_) * frame_s_ * 1e9);
  if (time_s() > scenario_.seconds) return false;
  // In steps of a tick, as the car's place decides when it brakes.
  for (int64_t t = before_ns; t < time_ns_; t += 8'333'333) {
    simulation_.advance(t);
    if (brake_for_) brake();
    hardest_braking_mps2 = std::max(hardest_braking_mps2, -simulation_.driver().state().acceleration_mps2);
  }
  simulation_.advance(time_ns_);
  plugin_.update(pluginTime_ns());
  const glm::dvec3 roof = car().position_m + glm::dvec3(0.0, 0.0, 1.5);
  was_under_cover =
      was_under_cover || std::ranges::any_of(road_hulls_, [&](const Hull& h) { return h.depth(roof) > 0.0; });
  return true;
}

// The foot comes down when the nose is about to go in, so that the car stops with the shelter's edge before
// or above its glass. A little more than the tyres give, so that with what the foot's time constant takes the
// deceleration does reach 1 g.
void Drive::brake() {
  constexpr double kPedal = 1.1 * kG_mps2 / 9.0, kNose_m = 5.0;
  const host::CarState& car = simulation_.driver().state();
  const glm::dvec3 nose = car.position_m + car.orientation * glm::dvec3(kNose_m, 0.0, 1.5);
  braking_ = braking_ || road_hulls_[*brake_for_].depth(nose) > 0.0;
  if (!braking_) return;
  simulation_.driver().takeOver();
  simulation_.overrides.controls = host::Controls{0.0, kPedal, 0.0};
}

glm::dvec3 Drive::dropVelocity(uint32_t kind) const {
  const rg::rain::FallClass& c = rg::rain::fallClasses()[kind];
  return rain_.profile.drop_share[kind] * rain_.wind_mps + glm::dvec3(c.drift_mps, -c.speed_mps);
}

rg::ViewState Drive::view() const {
  const rg_view view = simulation_.pluginViewAt(time_ns_);
  return rg::readView(&view);
}

double Drive::depth(const glm::dvec3& a, const glm::dvec3& b) const {
  double deepest = -1e30;
  for (const Hull& h : road_hulls_) deepest = std::max(deepest, h.depth(a, b));
  const host::CarState at = car();
  const glm::dquat into = glm::conjugate(at.orientation);
  for (const Hull& h : car_hulls_)
    deepest = std::max(deepest, h.depth(into * (a - at.position_m), into * (b - at.position_m)));
  return deepest;
}

}  // namespace oracle
