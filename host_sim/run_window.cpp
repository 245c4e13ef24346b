// The drive in a window: real time, a person may take the wheel.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#define GLFW_INCLUDE_NONE  // GL comes through glad
#include <GLFW/glfw3.h>

#include "image/png.h"
#include "overlay/overlay.h"
#include "report.h"
#include "run.h"
#include "stage.h"
#include "window/glfw_window.h"
#include "window/pilot.h"

namespace host {
namespace {

constexpr int64_t kLongestStep_ns = 100'000'000;  // a slower picture makes the world slower, not jumpy
constexpr int64_t kPrewarmPiece_ns = 100'000'000;
constexpr double kPrewarmPictureEvery_s = 0.25;
constexpr double kNotice_s = 5.0;  // how long what a key did is told

using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void refuseWhatNeedsNoWindow(const Options& options) {
  const char* option = !options.video.empty()     ? "--video"
                       : !options.shots_s.empty() ? "--shots"
                       : !options.budget.empty()  ? "--budget"
                       : options.save_at_s        ? "--save-at"
                                                  : nullptr;
  if (option)
    throw InputError(std::string(option) +
                     " needs --headless: a window draws when it can, not at given times");
}

class WindowRun {
 public:
  WindowRun(const Options& options, const Scenario& scenario, Models models)
      : options_(options),
        scenario_(scenario),
        window_(makeWindow("Rainglass", options.size_px, options.gl_debug)),
        stage_(options, scenario, std::move(models), *window_),
        pilot_(stage_.simulation(), *window_),
        overlay_(*window_, window_->textScale()),
        target_(*window_, window_->sizePx()) {
    stage_.simulation().resize(target_.sizePx());
    listen();
  }

  int run();

 private:
  void listen();
  void prewarm();
  void drive();
  void followSize();
  void show(const char* note);
  void writePicture();
  enum class Wanted { nothing, save, restore };
  void doWhatIsWanted();
  std::string saveOrRestore(Wanted wanted);
  const char* note() const;
  void report(double wall_s);

  const Options& options_;
  const Scenario& scenario_;
  std::unique_ptr<Window> window_;
  Stage stage_;
  Pilot pilot_;
  Overlay overlay_;
  Target target_;
  int64_t time_ns_ = 0;
  uint64_t frames_ = 0;
  double mean_frame_s_ = 0.0;
  Wanted wanted_ = Wanted::nothing;
  std::string notice_;
  Clock::time_point noticed_;
  Clock::time_point before_ = Clock::now();
};

void WindowRun::listen() {
  WindowEvents& on = window_->events;
  on.on_key = [this](int key, bool pressed) {
    if (pressed && key == GLFW_KEY_F1)
      overlay_.toggle();
    else if (pressed && key == GLFW_KEY_F5)
      wanted_ = Wanted::save;
    else if (pressed && key == GLFW_KEY_F9)
      wanted_ = Wanted::restore;
    else if (pressed)
      pilot_.onKey(key);
  };
  on.on_cursor = [this](glm::dvec2 at_px) { overlay_.moveCursor(at_px); };
  on.on_button = [this](bool pressed) { overlay_.pressButton(pressed); };
  on.on_scroll = [this](double steps) { overlay_.scroll(steps); };
  on.on_drag = [this](glm::dvec2 moved_px) {
    if (!overlay_.wantsMouse()) pilot_.look(moved_px);
  };
}

int WindowRun::run() {
  if (options_.restore.empty())
    prewarm();
  else
    time_ns_ = restoreFrom(stage_, readRun(options_.restore, scenario_), options_.restore);
  const auto begin = before_ = Clock::now();
  drive();
  if (!options_.save.empty()) saveTo(stage_, time_ns_, options_.save);
  report(secondsSince(begin));
  return 0;
}

// The scenario's rain before the drive, seen as it falls: where the computer is slow this takes a while.
void WindowRun::prewarm() {
  const int64_t whole_ns = stage_.simulation().pluginTime(0);
  time_ns_ = -whole_ns;
  stage_.update(time_ns_);
  stage_.draw(time_ns_, target_, 0);  // lays the light that eyes adapt to
  auto shown = Clock::now();
  while (time_ns_ < 0 && !window_->closed()) {
    time_ns_ += std::min(kPrewarmPiece_ns, -time_ns_);
    stage_.update(time_ns_);
    if (secondsSince(shown) < kPrewarmPictureEvery_s) continue;
    char note[64];
    std::snprintf(note, sizeof note, "rain before the drive: %.0f s", static_cast<double>(-time_ns_) * 1e-9);
    show(note);
    shown = Clock::now();
  }
}

void WindowRun::drive() {
  const auto end_ns = options_.seconds ? static_cast<int64_t>(*options_.seconds * 1e9) : INT64_MAX;
  while (!window_->closed() && time_ns_ < end_ns) {
    const auto passed_ns =
        std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - before_).count();
    pilot_.hold(static_cast<double>(passed_ns) * 1e-9);
    if (!pilot_.paused()) {
      time_ns_ += std::min({int64_t{passed_ns}, kLongestStep_ns, end_ns - time_ns_});
      stage_.update(time_ns_);
    }
    doWhatIsWanted();
    show(note());
  }
}

// Whatever is wrong with the file, or with the moment, the drive goes on.
void WindowRun::doWhatIsWanted() {
  const Wanted wanted = std::exchange(wanted_, Wanted::nothing);
  if (wanted == Wanted::nothing) return;
  try {
    notice_ = saveOrRestore(wanted);
  } catch (const std::runtime_error& e) {
    notice_ = e.what();
    std::fprintf(stderr, "host_sim: %s\n", e.what());
  }
  noticed_ = Clock::now();
}

std::string WindowRun::saveOrRestore(Wanted wanted) {
  const std::filesystem::path file = options_.save.empty() ? options_.out / "saved.run" : options_.save;
  if (wanted == Wanted::save)
    saveTo(stage_, time_ns_, file);
  else
    time_ns_ = restoreFrom(stage_, readRun(file, scenario_), file);
  char text[64];
  std::snprintf(text, sizeof text, "%s at %.1f s", wanted == Wanted::save ? "saved" : "back",
                static_cast<double>(time_ns_) * 1e-9);
  return text;
}

const char* WindowRun::note() const {
  if (!notice_.empty() && secondsSince(noticed_) < kNotice_s) return notice_.c_str();
  return pilot_.paused() ? "paused" : "";
}

void WindowRun::followSize() {
  const glm::ivec2 size_px = window_->sizePx();
  if (size_px == target_.sizePx() || size_px.x <= 0 || size_px.y <= 0) return;  // 0: made an icon
  target_.resize(size_px);
  stage_.simulation().resize(size_px);
}

// Draws the moment with the panel over it, and lets keys and mouse have their say.
void WindowRun::show(const char* note) {
  const double frame_s = secondsSince(before_);
  before_ = Clock::now();
  mean_frame_s_ = mean_frame_s_ > 0.0 ? std::lerp(mean_frame_s_, frame_s, 0.05) : frame_s;
  const double fps = 1.0 / std::max(mean_frame_s_, 1e-6);
  followSize();
  stage_.draw(time_ns_, target_, 0);
  if (pilot_.takePicture()) writePicture();
  overlay_.draw(stage_, target_.sizePx(), frame_s, fps, note);
  Simulation& sim = stage_.simulation();
  char title[200];
  std::snprintf(
      title, sizeof title, "Rainglass  %.0f km/h%s  rain %.1f mm/h  wipers %s  %s  %.0f fps%s%s  (F1: keys)",
      sim.driver().state().speed_mps * 3.6, sim.overrides.controls ? " by hand" : "", sim.weather().rain_mm_h,
      wiperModeName(sim.wiperMode()), sim.camera.c_str(), fps, *note ? "  " : "", note);
  window_->setTitle(title);
  window_->show();
  ++frames_;
}

// Without the panel.
void WindowRun::writePicture() {
  const Picture picture(*window_, target_.sizePx());
  stage_.draw(time_ns_, target_, picture.framebuffer());
  char name[64];
  std::snprintf(name, sizeof name, "shot_%.2f.png", static_cast<double>(time_ns_) * 1e-9);
  writePng(options_.out / name, picture.read(), target_.sizePx().x, target_.sizePx().y);
  std::printf("%s\n", (options_.out / name).c_str());
  std::fflush(stdout);
}

void WindowRun::report(double wall_s) {
  Report report;
  report.frames = frames_;
  report.size_px = target_.sizePx();
  report.simulated_s = static_cast<double>(std::max<int64_t>(time_ns_, 0)) * 1e-9;
  report.wall_s = wall_s;
  stage_.fillReport(report);
  writeReport(options_.out / "report.json", report);
}

}  // namespace

int runWindow(const Options& options) {
  if (!hasDisplay()) throw InputError("there is no display for a window; use --headless");
  refuseWhatNeedsNoWindow(options);
  const Scenario scenario = chosenScenario(options);
  Models models = loadModels(scenario);
  makeOutFolder(options.out);
  if (!options.save.empty()) requireWritable(options.save);
  for (const KeyHelp& help : kKeyHelp) std::printf("%-12s  %s\n", help.keys, help.effect);
  std::fflush(stdout);
  return WindowRun(options, scenario, std::move(models)).run();
}

}  // namespace host
