// A run that begins from a saved one is that run gone on: the same state and the same pictures, its sensor
// and washer included. What is no such file is told in one line.
#include <gtest/gtest.h>

#include "run_host.h"

namespace testing_host {
namespace {

class SavedRuns : public ::testing::Test {
 protected:
  SavedRuns() : folder(freshFolder("saved")) {}
  ~SavedRuns() override { std::filesystem::remove_all(folder); }

  Outcome run(const std::string& out, const std::string& options) const {
    return runHost(
        "--headless --scenario drive --size 64x36 --set prewarm_s=0.3 --set drive.start_m=300 "
        "--set wipers=auto --set washes=[0.2] --set weather.rain_mm_h=60 --out " +
        (folder / out).string() + " " + options);
  }
  std::string file(const std::string& name) const { return (folder / name).string(); }

  std::filesystem::path folder;
};

TEST_F(SavedRuns, goOnWithTheSameStateAndPictures) {
  const Outcome whole = run("whole", "--seconds 0.5 --shots 0.3,0.5 --save-at 0.3 --save " + file("at.run"));
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_NE(whole.out.find("at.run"), std::string::npos) << whole.out;
  const Outcome rest = run("rest", "--seconds 0.5 --shots 0.5 --restore " + file("at.run"));
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  const nlohmann::json a = report(folder / "whole"), b = report(folder / "rest");
  ASSERT_TRUE(a.is_object() && b.is_object());
  EXPECT_EQ(a["state_hash"], b["state_hash"]);
  EXPECT_EQ(a["rain_hash"], b["rain_hash"]);
  EXPECT_EQ(a["panes"], b["panes"]);
  double run_on_ml = 0.0;
  for (const nlohmann::json& pane : a["panes"]) run_on_ml += pane["run_on_ml"].get<double>();
  EXPECT_GT(run_on_ml, 0.01) << "what is under way round pillars is a part of what is saved";
  EXPECT_EQ(b["gl_errors"], 0);
  EXPECT_TRUE(slurp(folder / "whole" / "shot_0.50.png") == slurp(folder / "rest" / "shot_0.50.png"));
  EXPECT_FALSE(slurp(folder / "whole" / "shot_0.30.png") == slurp(folder / "whole" / "shot_0.50.png"));

  // And what is none, or another's.
  const auto refused = [&](const std::string& options, const std::string& why) {
    const Outcome bad = run("bad", "--seconds 0.5 " + options);
    EXPECT_EQ(bad.exit_code, 2) << options;
    EXPECT_NE(bad.err.find(why), std::string::npos) << bad.err;
    EXPECT_EQ(std::ranges::count(bad.err, '\n'), 1) << bad.err;
  };
  const std::string saved = slurp(folder / "at.run");
  const auto write = [&](const std::string& name, const std::string& bytes) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return "--restore " + file(name);
  };
  refused("--restore " + file("none.run"), "no such file");
  refused(write("text.run", "hello\n"), "no run");
  refused(write("cut.run", saved.substr(0, saved.size() / 2)), "cut short");
  refused("--seed 2 --restore " + file("at.run"), "--seed");
  refused("--shots 0.2 --restore " + file("at.run"), "0.3");
}

TEST_F(SavedRuns, areRefusedWhereTheyCannotBeWrittenBeforeTheRunBegins) {
  const Outcome bad = run("out", "--seconds 600 --save " + file("no/such/folder.run"));
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("cannot be written"), std::string::npos) << bad.err;
  EXPECT_EQ(run("out", "--seconds 1 --save-at 0.5").exit_code, 2);
}

}  // namespace
}  // namespace testing_host
