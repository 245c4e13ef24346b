// The command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace host {

struct Options {
  std::string scenario = "drive";
  std::filesystem::path environment, drops, car, road, video, out = "out", budget;
  std::filesystem::path save, restore;
  std::optional<double> save_at_s;  // none: at the end
  bool headless = false;
  bool gl_debug = false;
  glm::ivec2 size_px{1280, 720};
  double fps = 60.0;
  std::optional<double> seconds;
  std::optional<uint64_t> seed;
  std::vector<std::string> changes;  // --set
  std::string camera;
  std::vector<double> shots_s;
  double update_hz = 0.0;  // 0: an update for every picture
  bool irregular_updates = false;
};

// Throws InputError with one line. `done` is set when help was asked for and printed.
Options parseOptions(int argc, const char* const* argv, bool& done);

// Makes the folder of --out where there is none; throws InputError where it cannot be made.
void makeOutFolder(const std::filesystem::path& folder);

}  // namespace host
