#include "saved_run.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "stage.h"

namespace host {
namespace {

constexpr int kFormat = 1;
constexpr size_t kLongestLine = 1u << 20;
constexpr int64_t kLatest_ns = 36'000'000'000'000;  // as --seconds

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(file.string() + ": " + why);
}

// From the line; the bytes follow it.
SavedRun parsed(const nlohmann::json& json) {
  SavedRun run;
  if (!json.is_object() || json.value("host_sim_run", 0) != kFormat)
    throw InputError("is no run that this version of host_sim saved");
  run.scenario = json.at("scenario").get<std::string>();
  run.seed = json.at("seed").get<uint64_t>();
  run.time_ns = json.at("time_ns").get<int64_t>();
  run.simulation = json.at("simulation");
  if (run.time_ns < 0 || run.time_ns > kLatest_ns) throw InputError("its time is out of range");
  return run;
}

// A line of JSON, then the plugin's bytes. Beside it first, so that a file that was there is whole until the
// new one is.
void writeRun(const SavedRun& run, const std::filesystem::path& file) {
  const std::filesystem::path part = file.string() + ".part";
  const nlohmann::json head{
      {"host_sim_run", kFormat}, {"scenario", run.scenario},     {"seed", run.seed},
      {"time_ns", run.time_ns},  {"simulation", run.simulation}, {"plugin_bytes", run.plugin.size()}};
  std::ofstream out(part, std::ios::binary);
  out << head.dump() << "\n";
  out.write(reinterpret_cast<const char*>(run.plugin.data()),
            static_cast<std::streamsize>(run.plugin.size()));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(part, file, error);
  if (!out || error) {
    std::filesystem::remove(part, error);
    refuse(file, "cannot be written");
  }
}

}  // namespace

void requireWritable(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const bool exists = std::filesystem::exists(file, error);
  const bool writable =
      !exists || (std::filesystem::is_regular_file(file, error) && access(file.c_str(), W_OK) == 0);
  // What is written is a file beside it, which then takes its name.
  if (!writable || access(folder.c_str(), W_OK) != 0) refuse(file, "cannot be written");
}

SavedRun readRun(const std::filesystem::path& file, const Scenario& scenario) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) refuse(file, "there is no such file");
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, "cannot be read");
  const std::string all{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const size_t end = all.find('\n');
  if (end > kLongestLine) refuse(file, "is no run that host_sim saved");  // npos is, too
  try {
    const auto json = nlohmann::json::parse(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(end));
    SavedRun run = parsed(json);
    run.plugin.assign(all.begin() + static_cast<std::ptrdiff_t>(end) + 1, all.end());
    if (json.at("plugin_bytes").get<uint64_t>() != run.plugin.size()) throw InputError("is cut short");
    if (run.scenario != scenario.name)
      throw InputError("was saved in the scenario \"" + run.scenario + "\", this is \"" + scenario.name +
                       "\"");
    if (run.seed != scenario.seed)
      throw InputError("was saved with --seed " + std::to_string(run.seed) + ", this is " +
                       std::to_string(scenario.seed));
    return run;
  } catch (const nlohmann::json::exception&) {
    refuse(file, "is no run that host_sim saved");
  } catch (const InputError& e) {
    refuse(file, e.what());
  }
}

void saveTo(Stage& stage, int64_t time_ns, const std::filesystem::path& file) {
  writeRun(stage.save(time_ns), file);
  std::printf("%s\n", file.c_str());
  std::fflush(stdout);
}

int64_t restoreFrom(Stage& stage, const SavedRun& run, const std::filesystem::path& file) {
  try {
    return stage.restore(run);
  } catch (const InputError& e) {
    refuse(file, e.what());
  }
}

}  // namespace host
