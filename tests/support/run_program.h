// Runs a program of the build as a user would.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace testing_host {

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

inline std::string slurp(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// A folder of this test's own, empty.
inline std::filesystem::path freshFolder(const std::string& name) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("rainglass_test_" + name + "_" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

// `arguments` go through the shell; `environment` like "A=1 B=2".
inline Outcome runProgram(const std::string& program, const std::string& arguments,
                          const std::string& environment = "") {
  const auto folder = freshFolder("run");
  const std::string command = environment + " " + RG_BIN_DIR + "/" + program + " " + arguments + " >" +
                              (folder / "out").string() + " 2>" + (folder / "err").string();
  const int status = std::system(command.c_str());
  Outcome run{WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(folder / "out"), slurp(folder / "err")};
  std::filesystem::remove_all(folder);
  return run;
}

}  // namespace testing_host
