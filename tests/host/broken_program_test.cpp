// What a user with a broken model file sees: one line that names it, and exit code 2, before any GL is asked
// for.
#include <gtest/gtest.h>

#include <algorithm>

#include "broken_files.h"
#include "support/run_host.h"

namespace {

using files::Bytes;
using files::Gltf;
using files::TempFolder;

// With an EGL that finds no display: a program that went for GL first would say so and end with 3.
testing_host::Outcome run(const std::string& option, const std::filesystem::path& file,
                          const TempFolder& folder) {
  return testing_host::runHost("--headless " + option + " " + file.string() +
                                   " --seconds 0 --shots 0 --size 64x36 --out " + (folder / "out").string(),
                               "EGL_PLATFORM=none __EGL_VENDOR_LIBRARY_DIRS=/nonexistent");
}

void expectRefused(const std::string& option, const std::filesystem::path& file, const TempFolder& folder,
                   const std::string& what, const std::string& expected) {
  const testing_host::Outcome outcome = run(option, file, folder);
  EXPECT_EQ(outcome.exit_code, 2) << what << ": " << outcome.err;
  EXPECT_EQ(outcome.out, "") << what;
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << what << ": " << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with('\n')) << what << ": " << outcome.err;
  EXPECT_NE(outcome.err.find(file.filename().string()), std::string::npos) << what << ": " << outcome.err;
  EXPECT_NE(outcome.err.find(expected), std::string::npos) << what << ": " << outcome.err;
}

Gltf broken(const files::Break& b) {
  Gltf g = files::wholeCar();
  b.apply(g);
  return g;
}

TEST(BrokenProgram, refusesEachBrokenBinaryInOneLineWithExitCode2) {
  ASSERT_GE(files::kBreaks.size(), 24U);
  const TempFolder folder;
  for (const files::Break& b : files::kBreaks)
    expectRefused("--car", folder.write("broken.glb", broken(b).glb()), folder, b.name, b.expected);
}

TEST(BrokenProgram, refusesEachBrokenTextInOneLineWithExitCode2) {
  const TempFolder folder;
  for (const files::Break& b : files::kBreaks) {
    if (files::onlyBinary(b)) continue;
    const Gltf g = broken(b);
    folder.write("buffer.bin", g.bin);
    expectRefused("--car", folder.write("broken.gltf", g.gltf()), folder, b.name, b.expected);
  }
}

TEST(BrokenProgram, refusesWhatIsNoModelAtAll) {
  const TempFolder folder;
  const Bytes sound = files::wholeCar().glb();
  std::filesystem::create_directories(folder / "folder.glb");
  expectRefused("--car", folder / "none.glb", folder, "missing", "no such file");
  expectRefused("--car", folder / "folder.glb", folder, "folder", "is a directory");
  expectRefused("--car", folder.write("empty.glb", Bytes{}), folder, "empty", "is empty");
  expectRefused("--car", folder.write("cut.glb", Bytes(sound.begin(), sound.begin() + 100)), folder, "cut",
                "length");
  expectRefused("--car", folder.write("text.gltf", std::string("{\"asset\":}")), folder, "JSON", "JSON");
  expectRefused("--car", folder.write("list.gltf", std::string("[]")), folder, "list", "");
  Bytes other = sound;
  other[4] = 1;
  expectRefused("--car", folder.write("version.glb", other), folder, "version", "version is 1");
  Gltf outside = files::wholeCar();
  outside.json["images"][0] = {{"name", "paint"}, {"uri", "../outside.png"}};
  folder.write("buffer.bin", outside.bin);
  expectRefused("--car", folder.write("outside.gltf", outside.gltf()), folder, "path", "image 0 \"paint\"");
}

TEST(BrokenProgram, refusesABrokenRoadAsWell) {
  const TempFolder folder;
  const files::Break& b = files::kBreaks.front();
  expectRefused("--road", folder.write("way.glb", broken(b).glb()), folder, b.name, b.expected);
}

// Else the tests above would pass with a program that refuses everything.
TEST(BrokenProgram, takesTheSoundFileAndOnlyThenMissesGl) {
  const TempFolder folder;
  const testing_host::Outcome outcome =
      run("--car", folder.write("sound.glb", files::wholeCar().glb()), folder);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(outcome.err.find("sound.glb"), std::string::npos) << outcome.err;
}

}  // namespace
