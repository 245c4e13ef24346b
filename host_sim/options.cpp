#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

#include "scenario.h"

namespace host {
namespace {

constexpr int kLargest_px = 16384;

glm::ivec2 parseSize(const std::string& text) {
  glm::ivec2 size(0);
  char x = 0, rest = 0;
  std::istringstream in(text);
  if (!(in >> size.x >> x >> size.y) || x != 'x' || in >> rest || size.x < 16 || size.y < 16 ||
      size.x > kLargest_px || size.y > kLargest_px) {
    throw InputError("--size " + text + ": must be WIDTHxHEIGHT, each 16 .. 16384");
  }
  return size;
}

std::vector<double> parseShots(const std::string& text) {
  std::vector<double> shots;
  std::istringstream in(text);
  for (std::string item; std::getline(in, item, ',');) {
    char* end = nullptr;
    const double t = std::strtod(item.c_str(), &end);
    if (item.empty() || *end != '\0' || !(t >= 0.0 && t <= 36000.0))
      throw InputError("--shots " + text + ": \"" + item + "\" is not a time in seconds");
    shots.push_back(t);
  }
  std::ranges::sort(shots);
  shots.erase(std::unique(shots.begin(), shots.end()), shots.end());
  return shots;
}

double parseUpdateHz(const std::string& text, bool& irregular) {
  irregular = text == "irregular";
  if (irregular || text.empty()) return 0.0;
  char* end = nullptr;
  const double hz = std::strtod(text.c_str(), &end);
  if (*end != '\0' || !(hz >= 1.0 && hz <= 10000.0))
    throw InputError("--update-hz " + text + ": must be 1 .. 10000 or irregular");
  return hz;
}

}  // namespace

Options parseOptions(int argc, const char* const* argv, bool& done) {
  Options o;
  std::string size = "1280x720", shots, update_hz;
  double seconds = 0.0, save_at = 0.0;
  uint64_t seed = 0;
  CLI::App app{
      "Drives a glTF car through the rain: in a window, or headless to pictures, video and a report.",
      "host_sim"};
  app.add_option("--scenario", o.scenario, "Scenario: a name in scenarios/, or a TOML file")
      ->capture_default_str();
  app.add_option("--environment", o.environment,
                 "Surroundings and light from a latitude-longitude .hdr instead of the computed sky");
  app.add_option(
      "--drops", o.drops,
      "Show the drops of this list (JSON) on a flat pane before the environment, without rain or car");
  app.add_flag("--headless", o.headless, "No window: OpenGL by EGL, no display needed");
  app.add_option("--size", size, "Size of the picture")->capture_default_str();
  app.add_option("--fps", o.fps,
                 "Pictures per simulated second; changes which moments are drawn, not the state")
      ->capture_default_str();
  auto* seconds_option = app.add_option("--seconds", seconds, "Simulated time, instead of the scenario's");
  auto* seed_option = app.add_option("--seed", seed, "Seed of all randomness, instead of the scenario's");
  app.add_option("--car", o.car, "glTF car, instead of the scenario's");
  app.add_option("--road", o.road, "glTF road, instead of the scenario's");
  app.add_option("--set", o.changes, "Change a key of the scenario: path.to.key=value")
      ->allow_extra_args(false);
  app.add_option("--camera", o.camera,
                 "cockpit, bumper, outside, front, side, free, or one of the car's own (the project's has "
                 "window and lens)");
  app.add_option("--shots", shots, "Write DIR/shot_<seconds>.png at these times: T1,T2,...");
  app.add_option("--video", o.video, "Write an mp4 (needs the ffmpeg program)");
  app.add_option("--out", o.out, "Folder for shots and report.json")->capture_default_str();
  app.add_option("--budget", o.budget, "Hold the run to this budget file; exit code 4 when over");
  app.add_option(
      "--save", o.save,
      "Write the state at the end of the run, water and all, to a file that --restore begins from");
  auto* save_at_option = app.add_option("--save-at", save_at, "Second at which --save does so");
  app.add_option("--restore", o.restore,
                 "Begin at the moment and in the state of a file that --save or F5 wrote: the same scenario, "
                 "car, seed and version; --set may change what comes");
  app.add_option("--update-hz", update_hz,
                 "How time is cut into plugin updates: a rate, or irregular; does not change the state");
  app.add_flag("--gl-debug", o.gl_debug,
               "Have the driver check every call and tell its errors in full: slower, on a GPU much");
  app.footer("Exit codes: 0 done, 1 failed, 2 wrong usage or input, 3 no OpenGL 4.5, 4 over budget.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    done = true;
    return o;
  } catch (const CLI::ParseError& e) {
    throw InputError(std::string(e.what()) + " (see --help)");
  }
  o.size_px = parseSize(size);
  o.shots_s = parseShots(shots);
  o.update_hz = parseUpdateHz(update_hz, o.irregular_updates);
  if (!(o.fps > 0.0 && o.fps <= 1000.0)) throw InputError("--fps must be above 0 and at most 1000");
  if (*seconds_option) {
    if (!(seconds >= 0.0 && seconds <= 36000.0)) throw InputError("--seconds must be 0 .. 36000");
    o.seconds = seconds;
  }
  if (*seed_option) o.seed = seed;
  if (*save_at_option) {
    if (o.save.empty()) throw InputError("--save-at needs --save");
    if (!(save_at >= 0.0 && save_at <= 36000.0)) throw InputError("--save-at must be 0 .. 36000");
    o.save_at_s = save_at;
  }
  return o;
}

void makeOutFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error))
    throw InputError("--out " + folder.string() + ": is not a folder and cannot be made one");
}

}  // namespace host
