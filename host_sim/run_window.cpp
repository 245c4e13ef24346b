// The drive in a window: real time, a person may take the wheel.
#define GLFW_INCLUDE_NONE  // GL comes through glad
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "image/png.h"
#include "report.h"
#include "run.h"
#include "stage.h"
#include "window/glfw_window.h"

namespace host {
namespace {

constexpr int64_t kLongestStep_ns = 100'000'000;  // a slower picture makes the world slower, not jumpy
constexpr double kFreeSpeed_mps = 8.0;
constexpr double kTurn_rad_per_px = 0.003;

constexpr const char* kKeys =
    "arrows        take the wheel: accelerate, brake, steer      Backspace  give it back\n"
    "C             next camera (cockpit, outside, front, side, free)\n"
    "W A S D Q E   move the free camera; drag with the mouse to look round\n"
    "R / Shift R   more / less rain          V / Shift V  more / less wind from ahead\n"
    "B / Shift B   wind from the left / right              0  weather as the scenario says\n"
    "1 2 I O       wipers: slow, fast, intermittent, off   M  as the scenario says\n"
    "P             pause                     F2  picture to the --out folder\n"
    "F1            these keys                Esc  quit\n";

// What the keys have changed.
class Pilot {
 public:
  Pilot(Stage& stage, Window& window, const Options& options) : stage_(stage), window_(window), options_(options) {
    window.events.on_key = [this](int key, bool pressed) {
      if (pressed) onKey(key);
    };
    window.events.on_drag = [this](glm::dvec2 moved_px) { look(moved_px); };
  }

  bool paused() const { return paused_; }
  bool takePicture() { return std::exchange(picture_, false); }

  // Keys that are held, every picture.
  void hold(double seconds) {
    Simulation& sim = stage_.simulation();
    if (sim.overrides.controls) {
      Controls& c = *sim.overrides.controls;
      c.throttle = window_.isDown(GLFW_KEY_UP) ? 1.0 : 0.0;
      c.brake = window_.isDown(GLFW_KEY_DOWN) ? 1.0 : 0.0;
      c.steer = (window_.isDown(GLFW_KEY_LEFT) ? 1.0 : 0.0) - (window_.isDown(GLFW_KEY_RIGHT) ? 1.0 : 0.0);
    }
    if (sim.camera == "free") moveFree(seconds);
  }

 private:
  bool shift() const { return window_.isDown(GLFW_KEY_LEFT_SHIFT) || window_.isDown(GLFW_KEY_RIGHT_SHIFT); }

  void onKey(int key) {
    Overrides& o = stage_.simulation().overrides;
    switch (key) {
      case GLFW_KEY_ESCAPE: window_.close(); break;
      case GLFW_KEY_F1: std::fputs(kKeys, stdout); std::fflush(stdout); break;
      case GLFW_KEY_F2: picture_ = true; break;
      case GLFW_KEY_P: paused_ = !paused_; break;
      case GLFW_KEY_C: nextCamera(); break;
      case GLFW_KEY_R: changeRain(); break;
      case GLFW_KEY_V: changeWind({shift() ? 2.0 : -2.0, 0.0, 0.0}); break;
      case GLFW_KEY_B: changeWind({0.0, shift() ? 2.0 : -2.0, 0.0}); break;
      case GLFW_KEY_0: o.rain_mm_h.reset(); o.wind_mps.reset(); break;
      case GLFW_KEY_1: o.wipers = WiperMode::slow; break;
      case GLFW_KEY_2: o.wipers = WiperMode::fast; break;
      case GLFW_KEY_I: o.wipers = WiperMode::intermittent; break;
      case GLFW_KEY_O: o.wipers = WiperMode::off; break;
      case GLFW_KEY_M: o.wipers.reset(); break;
      case GLFW_KEY_UP:
      case GLFW_KEY_DOWN:
      case GLFW_KEY_LEFT:
      case GLFW_KEY_RIGHT:
        if (!o.controls) {
          o.controls = Controls{};
          stage_.simulation().driver().takeOver();
        }
        break;
      case GLFW_KEY_BACKSPACE:
        o.controls.reset();
        stage_.simulation().driver().giveBack();
        break;
      default: break;
    }
  }

  void nextCamera() {
    Simulation& sim = stage_.simulation();
    const auto now = std::ranges::find(kCameras, sim.camera);
    sim.camera = now + 1 == std::end(kCameras) ? kCameras[0] : now[1];
  }

  // Steps of a fifth of a decade: 0.2, 0.32, 0.5, ... mm/h.
  void changeRain() {
    constexpr double kStep = 1.5849, kLeast_mm_h = 0.2, kMost_mm_h = 200.0;
    const double now = stage_.simulation().weather().rain_mm_h;
    double next = shift() ? now / kStep : std::max(now, kLeast_mm_h / kStep) * kStep;
    if (next < kLeast_mm_h) next = 0.0;
    stage_.simulation().overrides.rain_mm_h = std::min(next, kMost_mm_h);
  }

  void changeWind(const glm::dvec3& by_car_mps) {
    Simulation& sim = stage_.simulation();
    const CarState& car = sim.driver().state();
    sim.overrides.wind_mps = glm::clamp(sim.weather().wind_mps + car.orientation * by_car_mps, -40.0, 40.0) * glm::dvec3(1.0, 1.0, 0.0);
  }

  void look(glm::dvec2 moved_px) {
    FreeCamera& f = stage_.simulation().free_camera;
    f.yaw_rad -= moved_px.x * kTurn_rad_per_px;
    f.pitch_rad = std::clamp(f.pitch_rad - moved_px.y * kTurn_rad_per_px, -1.5, 1.5);
  }

  void moveFree(double seconds) {
    FreeCamera& f = stage_.simulation().free_camera;
    const glm::dvec3 forward(std::cos(f.yaw_rad), std::sin(f.yaw_rad), 0.0), left(-forward.y, forward.x, 0.0);
    const auto along = [&](int plus, int minus) { return (window_.isDown(plus) ? 1.0 : 0.0) - (window_.isDown(minus) ? 1.0 : 0.0); };
    f.position_m += (forward * along(GLFW_KEY_W, GLFW_KEY_S) + left * along(GLFW_KEY_A, GLFW_KEY_D) +
                     glm::dvec3(0.0, 0.0, along(GLFW_KEY_E, GLFW_KEY_Q))) * (kFreeSpeed_mps * seconds);
  }

  Stage& stage_;
  Window& window_;
  const Options& options_;
  bool paused_ = false, picture_ = false;
};

std::string title(Stage& stage, double fps, bool paused) {
  Simulation& sim = stage.simulation();
  char text[200];
  std::snprintf(text, sizeof text, "Rainglass  %.0f km/h  rain %.1f mm/h  wipers %s  %s  %.0f fps%s  (F1: keys)", sim.driver().state().speed_mps * 3.6,
                sim.weather().rain_mm_h, wiperModeName(sim.wiperMode()), sim.camera.c_str(), fps, paused ? "  paused" : "");
  return text;
}

}  // namespace

int runWindow(const Options& options) {
  if (!hasDisplay()) throw InputError("there is no display for a window; use --headless");
  const Scenario scenario = chosenScenario(options);
  const auto window = makeWindow("Rainglass", options.size_px);
  Stage stage(options, scenario, *window);
  Pilot pilot(stage, *window, options);
  Target target(*window, window->sizePx());
  std::fputs(kKeys, stdout);
  std::fflush(stdout);

  stage.prewarm();
  Report report;
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  auto before = begin;
  int64_t time_ns = 0;
  double mean_frame_s = 1.0 / 60.0;
  const auto end_ns = options.seconds ? static_cast<int64_t>(*options.seconds * 1e9) : INT64_MAX;
  while (!window->closed() && time_ns < end_ns) {
    const auto now = Clock::now();
    const auto step_ns = std::min<int64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now - before).count(), kLongestStep_ns);
    before = now;
    mean_frame_s += 0.05 * (static_cast<double>(step_ns) * 1e-9 - mean_frame_s);
    pilot.hold(static_cast<double>(step_ns) * 1e-9);
    if (!pilot.paused()) {
      time_ns += step_ns;
      stage.update(time_ns);
    }
    if (window->sizePx() != target.sizePx() && window->sizePx().x > 0 && window->sizePx().y > 0) {
      target.resize(window->sizePx());
      stage.simulation().resize(window->sizePx());
    }
    stage.draw(time_ns, target, 0);
    if (pilot.takePicture()) {
      std::filesystem::create_directories(options.out);
      const Picture picture(*window, target.sizePx());
      stage.draw(time_ns, target, picture.framebuffer());
      char name[64];
      std::snprintf(name, sizeof name, "shot_%.2f.png", static_cast<double>(time_ns) * 1e-9);
      writePng(options.out / name, picture.read(), target.sizePx().x, target.sizePx().y);
    }
    window->setTitle(title(stage, 1.0 / mean_frame_s, pilot.paused()));
    window->show();
    ++report.frames;
  }
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  report.size_px = target.sizePx();
  report.simulated_s = static_cast<double>(time_ns) * 1e-9;
  report.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  stage.fillReport(report);
  writeReport(options.out / "report.json", report);
  return 0;
}

}  // namespace host
