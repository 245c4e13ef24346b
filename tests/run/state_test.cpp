// The state depends on the scenario and its seed, and on nothing else: not on which moments are drawn, nor on
// how time is cut into updates.
#include <gtest/gtest.h>

#include "run_host.h"

namespace testing_host {
namespace {

struct Hashes {
  std::string rain, state;
  bool operator==(const Hashes&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Hashes& h) { return out << h.rain << "/" << h.state; }

Hashes hashesOf(const std::string& options) {
  const auto folder = freshFolder("state");
  const Outcome run = runHost(
      "--headless --scenario drive --seconds 0.7 --size 64x36 --set prewarm_s=0.3 --set drive.start_m=300 " +
      options + " --out " + folder.string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json json = report(folder);
  std::filesystem::remove_all(folder);
  if (!json.is_object()) return {};
  EXPECT_EQ(json["gl_errors"], 0);
  return {json["rain_hash"], json["state_hash"]};
}

TEST(State, dependsOnTheSeedButNotOnFramesUpdatesOrTheRun) {
  const Hashes at60 = hashesOf("--fps 60 --shots 0.5");
  EXPECT_FALSE(at60.state.empty());
  EXPECT_EQ(hashesOf("--fps 12 --shots 0.3,0.5 --update-hz irregular"), at60);
  EXPECT_NE(hashesOf("--fps 12 --seed 2"), at60);
}

// The rain sensor reads the plugin and the washer orders from it at times of their own.
TEST(State, isTheSameHoweverTimeIsCutWithSensorAndWasher) {
  const std::string wet =
      "--set wipers=auto --set washes=[0.303] --set weather.rain_mm_h=60 --fps 12 --shots 0.5 ";
  const Hashes at60 = hashesOf(wet + "--update-hz 60");
  EXPECT_FALSE(at60.state.empty());
  EXPECT_EQ(hashesOf(wet + "--update-hz irregular"), at60);
  EXPECT_NE(hashesOf(wet + "--update-hz 60 --set wipers=off"), at60);
  EXPECT_NE(hashesOf(wet + "--update-hz 60 --set washes=[]"), at60);
}

}  // namespace
}  // namespace testing_host
