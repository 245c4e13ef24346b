// Runs the host_sim program as a user would, with GL errors told.
#pragma once

#include <nlohmann/json.hpp>

#include "run_program.h"

namespace testing_host {

inline Outcome runHost(const std::string& arguments, const std::string& environment = "") {
  return runProgram("host_sim", arguments + " --gl-debug", environment);
}

inline nlohmann::json report(const std::filesystem::path& folder) {
  return nlohmann::json::parse(slurp(folder / "report.json"), nullptr, false);
}

}  // namespace testing_host
