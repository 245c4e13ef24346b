// Known drops, drawn by the program as its users run it, against path-traced pictures of them: README.md
// beside this file.
#include <gtest/gtest.h>

#include "run_host.h"

namespace testing_host {
namespace {

const std::string kPictures = RG_SOURCE_DIR "/tests/picture/";

void expectPathTracedLook(const std::string& name) {
  const auto folder = freshFolder("drops");
  const Outcome run = runHost("--headless --drops " + kPictures + name + ".json --environment " + kPictures +
                              "street_env.hdr --size 1280x720 --shots 0 --out " + folder.string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(report(folder)["gl_errors"], 0);
  // compare.py's limits are the project's own.
  const std::string command = "/usr/bin/python3 " + kPictures + "compare.py " + kPictures + name + ".png " +
                              (folder / "shot_0.00.png").string() + " " + kPictures + "background.png";
  EXPECT_EQ(std::system(command.c_str()), 0) << "beyond the limits of " << command;
  std::filesystem::remove_all(folder);
}

TEST(KnownDrops, onUncoatedGlassLookPathTraced) { expectPathTracedLook("pane_uncoated"); }
TEST(KnownDrops, onCoatedGlassLookPathTraced) { expectPathTracedLook("pane_coated"); }
TEST(KnownDrops, onASteeperPaneBesideTheEyeLookPathTraced) { expectPathTracedLook("pane_steep"); }

}  // namespace
}  // namespace testing_host
