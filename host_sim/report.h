// report.json: what a run was, what it cost, and where the water went.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rainglass/rainglass.h"

namespace host {

struct Report {
  std::string gl_vendor, gl_renderer, gl_version;
  bool gpu_timer = false;
  std::string scenario;
  uint64_t seed = 0;
  glm::ivec2 size_px{0};
  uint64_t frames = 0;
  double simulated_s = 0.0, wall_s = 0.0;
  std::vector<rg_stage_stats> stages;
  rg_rain_stats rain{};
  std::vector<std::pair<std::string, rg_pane_stats>> panes;
  uint64_t rain_hash = 0, state_hash = 0;
  uint64_t gl_errors = 0;
};

// Throws std::runtime_error naming the file when it cannot be written.
void writeReport(const std::filesystem::path& file, const Report& report);

}  // namespace host
