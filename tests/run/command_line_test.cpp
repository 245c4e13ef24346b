// What the program answers to its user: exit codes and one line each.
#include <gtest/gtest.h>

#include <algorithm>

#include "run_host.h"

namespace testing_host {
namespace {

void expectRefused(const std::string& arguments, int exit_code, const std::string& named,
                   const std::string& environment = "") {
  const Outcome run = runHost(arguments, environment);
  EXPECT_EQ(run.exit_code, exit_code) << arguments << "\n" << run.err;
  EXPECT_EQ(std::ranges::count(run.err, '\n'), 1) << arguments << "\n" << run.err;
  EXPECT_NE(run.err.find(named), std::string::npos) << arguments << "\n" << run.err;
}

TEST(CommandLine, helpNamesEveryOption) {
  const Outcome run = runHost("--help");
  EXPECT_EQ(run.exit_code, 0);
  for (const char* option :
       {"--scenario", "--environment", "--drops",     "--headless", "--size",   "--fps",     "--seconds",
        "--seed",     "--car",         "--road",      "--set",      "--camera", "--shots",   "--video",
        "--out",      "--budget",      "--update-hz", "--gl-debug", "--save",   "--save-at", "--restore"}) {
    EXPECT_NE(run.out.find(option), std::string::npos) << option;
  }
}

TEST(CommandLine, wrongUsageIsOneLineAndExitCode2) {
  expectRefused("--no-such-option", 2, "--no-such-option");
  expectRefused("--headless --size 12", 2, "--size");
  expectRefused("--headless --size 0x0", 2, "--size");
  expectRefused("--headless --size 99999x99999", 2, "--size");
  expectRefused("--headless --fps 0", 2, "--fps");
  expectRefused("--headless --fps nan", 2, "--fps");
  expectRefused("--headless --shots 1,x", 2, "--shots");
  expectRefused("--headless --seconds -1", 2, "--seconds");
  expectRefused("--headless --update-hz fast", 2, "--update-hz");
}

TEST(CommandLine, wrongInputIsOneLineAndExitCode2) {
  expectRefused("--headless --scenario none", 2, "none");
  expectRefused("--headless --set weather.rain_mm_h=-5", 2, "rain_mm_h");
  expectRefused("--headless --set plugin.rain.gain=1e9", 2, "rain.gain");
  expectRefused("--headless --set plugin.no.such=1", 2, "no.such");
  expectRefused("--headless --camera moon", 2, "window, mirror, lens");
  expectRefused("--headless --car /nonexistent.glb", 2, "nonexistent.glb");
  expectRefused("--headless --road /dev/null", 2, "null: is not a regular file");
  expectRefused("--headless --environment /nonexistent.hdr", 2, "nonexistent.hdr");
  expectRefused("--headless --drops /nonexistent.json", 2, "/nonexistent.json");
  expectRefused("--headless --out /dev/null/x --shots 0 --seconds 0", 2, "--out");
}

// Mesa can be told to offer no more than an older OpenGL; a GPU's own driver cannot, and is passed over.
TEST(CommandLine, withoutOpenGl45ItSaysWhatWasFoundAndEndsWith3) {
  const std::string mesa = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";
  if (!std::filesystem::exists(mesa)) GTEST_SKIP() << "Mesa is not installed";
  expectRefused("--headless --seconds 0 --shots 0", 3, "3.3",
                "__EGL_VENDOR_LIBRARY_FILENAMES=" + mesa +
                    " LIBGL_ALWAYS_SOFTWARE=1 MESA_GL_VERSION_OVERRIDE=3.3 MESA_GLSL_VERSION_OVERRIDE=330");
}

TEST(CommandLine, withoutADisplayAWindowIsRefusedInOneLine) {
  expectRefused("", 2, "--headless", "env -u DISPLAY -u WAYLAND_DISPLAY");
}

}  // namespace
}  // namespace testing_host
