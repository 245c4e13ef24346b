#include "report.h"

#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace host {
namespace {

using Json = nlohmann::ordered_json;

std::string hex(uint64_t value) {
  std::ostringstream text;
  text << std::hex << std::setfill('0') << std::setw(16) << value;
  return text.str();
}

Json stages(const std::vector<rg_stage_stats>& all) {
  Json json = Json::object();
  for (const rg_stage_stats& s : all) {
    Json stage;
    stage["cpu_ms"] = {{"p50", s.cpu_ms_p50}, {"p95", s.cpu_ms_p95}, {"p99", s.cpu_ms_p99}};
    if (s.gpu != 0) stage["gpu_ms"] = {{"p50", s.gpu_ms_p50}, {"p95", s.gpu_ms_p95}, {"p99", s.gpu_ms_p99}};
    stage["samples"] = s.samples;
    json[s.name] = stage;
  }
  return json;
}

Json pane(const std::string& name, const rg_pane_stats& p) {
  return {{"name", name},
          {"area_m2", p.area_m2},
          {"drops", p.drops},
          {"caught_ml", p.caught_ml},
          {"run_on_ml", p.run_on_ml},
          {"on_glass_ml", p.on_glass_ml},
          {"drained_ml", p.drained_ml},
          {"wiped_ml", p.wiped_ml},
          {"blown_ml", p.blown_ml},
          {"evaporated_ml", p.evaporated_ml},
          {"ledger_error", p.ledger_error},
          {"dropped_s", p.dropped_s}};
}

}  // namespace

void writeReport(const std::filesystem::path& file, const Report& r) {
  Json json;
  json["gl"] = {{"vendor", r.gl_vendor}, {"renderer", r.gl_renderer}, {"version", r.gl_version}};
  json["timer"] = r.gpu_timer ? "gpu" : "finish";
  json["scenario"] = r.scenario;
  json["seed"] = r.seed;
  json["size"] = {r.size_px.x, r.size_px.y};
  json["frames"] = r.frames;
  json["simulated_s"] = r.simulated_s;
  json["wall_s"] = r.wall_s;
  json["stages"] = stages(r.stages);
  json["rain"] = {{"rate_mm_h", r.rain.rate_mm_h},
                  {"live", r.rain.live},
                  {"born", r.rain.born},
                  {"died", r.rain.died},
                  {"sheltered_at_birth", r.rain.sheltered_at_birth},
                  {"shelter_tests", r.rain.shelter_tests},
                  {"thinning", r.rain.thinning},
                  {"snow_mm_h", r.rain.snow_mm_h},
                  {"hail_mm_h", r.rain.hail_mm_h},
                  {"live_snow", r.rain.live_snow},
                  {"live_melting", r.rain.live_melting},
                  {"live_hail", r.rain.live_hail},
                  {"live_bounced", r.rain.live_bounced},
                  {"bounced", r.rain.bounced}};
  json["panes"] = Json::array();
  for (const auto& [name, stats] : r.panes) json["panes"].push_back(pane(name, stats));
  json["rain_hash"] = hex(r.rain_hash);
  json["state_hash"] = hex(r.state_hash);
  json["gl_errors"] = r.gl_errors;
  std::ofstream out(file);
  out << json.dump(2) << "\n";
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace host
