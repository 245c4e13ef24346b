#include "window/pilot.h"

#define GLFW_INCLUDE_NONE  // GL comes through glad
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace host {
namespace {

constexpr double kFreeSpeed_mps = 8.0;
constexpr double kTurn_rad_per_px = 0.003;
constexpr double kMostWind_mps = 40.0;
constexpr double kWindStep_mps = 2.0;

// Level with the ground: columns are the car's forward and left.
glm::dmat2 heading(const CarState& car) {
  const glm::dvec3 forward = car.orientation * glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec2 f = glm::normalize(glm::dvec2(forward));
  return {f, glm::dvec2(-f.y, f.x)};
}

// Takes the free camera to where the present one is.
void placeFree(FreeCamera& free, const Eye& eye) {
  const glm::dmat3 world_from_eye = glm::transpose(glm::dmat3(eye.view.eye_from_world));
  const glm::dvec3 forward = -world_from_eye[2];
  free.position_m = eye.position_m;
  free.yaw_rad = std::atan2(forward.y, forward.x);
  free.pitch_rad = std::asin(std::clamp(forward.z, -1.0, 1.0));
}

}  // namespace

glm::dvec2 windByCar(Simulation& sim) {
  return -glm::transpose(heading(sim.driver().state())) * glm::dvec2(sim.weather().wind_mps);
}

void setWindByCar(Simulation& sim, glm::dvec2 from_mps) {
  const glm::dvec2 wind_mps =
      heading(sim.driver().state()) * -glm::clamp(from_mps, -kMostWind_mps, kMostWind_mps);
  sim.overrides.wind_mps = glm::dvec3(wind_mps, 0.0);
}

void Pilot::onKey(int key) {
  Overrides& o = sim_.overrides;
  switch (key) {
    case GLFW_KEY_ESCAPE:
      window_.close();
      break;
    case GLFW_KEY_F2:
      picture_ = true;
      break;
    case GLFW_KEY_P:
      paused_ = !paused_;
      break;
    case GLFW_KEY_C:
      nextCamera();
      break;
    case GLFW_KEY_R:
      changeRain();
      break;
    case GLFW_KEY_N:
      nextPrecipitation();
      break;
    case GLFW_KEY_V:
      changeWind({kWindStep_mps, 0.0});
      break;
    case GLFW_KEY_B:
      changeWind({0.0, kWindStep_mps});
      break;
    case GLFW_KEY_0:
      o.rain_mm_h.reset();
      o.snow_mm_h.reset();
      o.hail_mm_h.reset();
      o.wind_mps.reset();
      break;
    case GLFW_KEY_1:
      o.wipers = WiperMode::slow;
      break;
    case GLFW_KEY_2:
      o.wipers = WiperMode::fast;
      break;
    case GLFW_KEY_I:
      o.wipers = WiperMode::intermittent;
      break;
    case GLFW_KEY_O:
      o.wipers = WiperMode::off;
      break;
    case GLFW_KEY_U:
      o.wipers = WiperMode::automatic;
      break;
    case GLFW_KEY_X:
      sim_.wash();
      break;
    case GLFW_KEY_M:
      o.wipers.reset();
      break;
    case GLFW_KEY_UP:
    case GLFW_KEY_DOWN:
    case GLFW_KEY_LEFT:
    case GLFW_KEY_RIGHT:
      takeOver();
      break;
    case GLFW_KEY_BACKSPACE:
      giveBack();
      break;
    default:
      break;
  }
}

void Pilot::look(glm::dvec2 moved_px) {
  if (sim_.camera != "free") return;
  FreeCamera& f = sim_.free_camera;
  f.yaw_rad -= moved_px.x * kTurn_rad_per_px;
  f.pitch_rad = std::clamp(f.pitch_rad - moved_px.y * kTurn_rad_per_px, -1.5, 1.5);
}

void Pilot::hold(double seconds) {
  if (sim_.overrides.controls) {
    Controls& c = *sim_.overrides.controls;
    c.throttle = window_.isDown(GLFW_KEY_UP) ? 1.0 : 0.0;
    c.brake = window_.isDown(GLFW_KEY_DOWN) ? 1.0 : 0.0;
    c.steer = along(GLFW_KEY_LEFT, GLFW_KEY_RIGHT);
  }
  if (sim_.camera == "free") moveFree(seconds);
}

bool Pilot::takePicture() { return std::exchange(picture_, false); }

bool Pilot::shift() const {
  return window_.isDown(GLFW_KEY_LEFT_SHIFT) || window_.isDown(GLFW_KEY_RIGHT_SHIFT);
}

double Pilot::along(int plus_key, int minus_key) const {
  return (window_.isDown(plus_key) ? 1.0 : 0.0) - (window_.isDown(minus_key) ? 1.0 : 0.0);
}

void Pilot::takeOver() {
  if (sim_.overrides.controls) return;
  sim_.overrides.controls = Controls{};
  sim_.driver().takeOver();
}

void Pilot::giveBack() {
  if (!sim_.overrides.controls) return;
  sim_.overrides.controls.reset();
  sim_.driver().giveBack();
}

void Pilot::nextCamera() {
  const std::vector<std::string> names = sim_.cameras();
  const auto now = static_cast<size_t>(std::ranges::find(names, sim_.camera) - names.begin());
  const std::string& name = names[(now + 1) % names.size()];
  if (name == "free") placeFree(sim_.free_camera, sim_.eyeAt(static_cast<int64_t>(sim_.timeS() * 1e9)));
  sim_.camera = name;
}

// Steps of a fifth of a decade: 0.2, 0.32, 0.5, ... mm/h.
void Pilot::changeRain() {
  constexpr double kStep = 1.5849, kLeast_mm_h = 0.2, kMost_mm_h = 200.0;
  const double now = sim_.weather().rain_mm_h;
  double next = shift() ? now / kStep : std::max(now, kLeast_mm_h / kStep) * kStep;
  if (next < kLeast_mm_h * 0.999) next = 0.0;
  sim_.overrides.rain_mm_h = std::min(next, kMost_mm_h);
}

// At rates that are heavy for each.
void Pilot::nextPrecipitation() {
  constexpr double kRain_mm_h = 20.0, kSnow_mm_h = 2.0, kHail_mm_h = 40.0;
  const Weather now = sim_.weather();
  const bool was_snow = now.snow_mm_h > 0.0, was_hail = !was_snow && now.hail_mm_h > 0.0;
  sim_.overrides.rain_mm_h = was_hail ? kRain_mm_h : 0.0;
  sim_.overrides.snow_mm_h = was_snow || was_hail ? 0.0 : kSnow_mm_h;
  sim_.overrides.hail_mm_h = was_snow ? kHail_mm_h : 0.0;
}

void Pilot::changeWind(glm::dvec2 from_mps) {
  setWindByCar(sim_, windByCar(sim_) + (shift() ? -from_mps : from_mps));
}

void Pilot::moveFree(double seconds) {
  FreeCamera& f = sim_.free_camera;
  const glm::dvec3 forward(std::cos(f.yaw_rad), std::sin(f.yaw_rad), 0.0), left(-forward.y, forward.x, 0.0);
  const glm::dvec3 by = forward * along(GLFW_KEY_W, GLFW_KEY_S) + left * along(GLFW_KEY_A, GLFW_KEY_D) +
                        glm::dvec3(0.0, 0.0, along(GLFW_KEY_E, GLFW_KEY_Q));
  f.position_m += by * (kFreeSpeed_mps * seconds);
}

}  // namespace host
