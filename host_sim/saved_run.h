// A run as a file: where the car, its wipers and the driver's eye are, and the plugin's state with all its
// water.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "saved_fields.h"

namespace host {

class Stage;

// (The JSON library's destructor throws nothing, though clang-tidy is not told.)
struct SavedRun {  // NOLINT(bugprone-exception-escape)
  std::string scenario;
  uint64_t seed = 0;
  int64_t time_ns = 0;  // on the scenario's clock
  nlohmann::json simulation;
  std::vector<unsigned char> plugin;
};

// Throw InputError with one line that names the file.
void requireWritable(const std::filesystem::path& file);
void saveTo(Stage& stage, int64_t time_ns, const std::filesystem::path& file);
// Of this scenario: as far as it can be told without a stage, so before models are loaded.
SavedRun readRun(const std::filesystem::path& file, const Scenario& scenario);
int64_t restoreFrom(Stage& stage, const SavedRun& run, const std::filesystem::path& file);  // the moment

}  // namespace host
