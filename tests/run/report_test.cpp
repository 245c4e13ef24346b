// What a run reports, and that water is conserved in every scenario that is shipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "run_host.h"

namespace testing_host {
namespace {

constexpr double kLedger = 1e-3;  // the project's promise

nlohmann::json runScenario(const std::string& name, const std::string& options) {
  const auto folder = freshFolder("report");
  const Outcome run =
      runHost("--headless --size 64x36 --scenario " + name + " " + options + " --out " + folder.string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  nlohmann::json json = report(folder);
  std::filesystem::remove_all(folder);
  return json;
}

TEST(Report, holdsWhatItPromises) {
  const nlohmann::json json = runScenario("parked", "--seconds 1 --fps 10 --set prewarm_s=0.5");
  ASSERT_TRUE(json.is_object());
  for (const char* key : {"vendor", "renderer", "version"}) EXPECT_TRUE(json["gl"][key].is_string()) << key;
  EXPECT_TRUE(json["timer"] == "gpu" || json["timer"] == "finish");
  EXPECT_EQ(json["scenario"], "parked");
  EXPECT_EQ(json["frames"], 11);
  EXPECT_EQ(json["simulated_s"], 1.0);
  EXPECT_GT(json["wall_s"], 0.0);
  EXPECT_EQ(json["gl_errors"], 0);
  for (const char* stage : {"rain_tick", "glass_tick", "rain_upload", "glass_step", "splashes", "rain_beyond",
                            "rain_draw", "glass_draw"}) {
    ASSERT_TRUE(json["stages"].contains(stage)) << stage;
    EXPECT_LE(json["stages"][stage]["cpu_ms"]["p50"], json["stages"][stage]["cpu_ms"]["p99"]) << stage;
  }
  EXPECT_GT(json["stages"]["rain_draw"]["gpu_ms"]["p50"], 0.0);
  for (const char* key :
       {"rate_mm_h", "live", "born", "died", "sheltered_at_birth", "shelter_tests", "snow_mm_h", "hail_mm_h",
        "live_snow", "live_melting", "live_hail", "live_bounced", "bounced"})
    EXPECT_TRUE(json["rain"].contains(key)) << key;
  EXPECT_EQ(json["rain"]["rate_mm_h"], 10.0);
  ASSERT_FALSE(json["panes"].empty());
  for (const char* key : {"area_m2", "caught_ml", "on_glass_ml", "drained_ml", "wiped_ml", "blown_ml",
                          "evaporated_ml", "ledger_error", "dropped_s"}) {
    EXPECT_TRUE(json["panes"][0][key].is_number()) << key;
  }
}

// Terms of the ledger that a scenario is to put to the test, by more than a millilitre on one of its panes,
// and after how long it does.
struct TermsTested {
  double after_s = 0.6;
  std::vector<const char*> terms{};
};
const std::map<std::string, TermsTested> kTermsTested = {
    {"downpour", {2.0, {"caught_ml", "on_glass_ml", "drained_ml", "wiped_ml", "blown_ml"}}},
    {"drying", {6.0, {"evaporated_ml"}}}};

TermsTested termsTestedBy(const std::string& scenario) {
  const auto found = kTermsTested.find(scenario);
  return found == kTermsTested.end() ? TermsTested{} : found->second;
}

std::vector<std::string> shippedScenarios() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(RG_SOURCE_DIR "/scenarios"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

void expectWaterConserved(const std::string& scenario, const std::string& options) {
  const nlohmann::json json = runScenario(scenario, "--shots 0 " + options);
  ASSERT_TRUE(json.is_object());
  EXPECT_EQ(json["gl_errors"], 0);
  std::map<std::string, double> most;
  for (const auto& pane : json["panes"]) {
    EXPECT_LE(pane["ledger_error"], kLedger) << pane["name"];
    for (const auto& [term, ml] : pane.items()) {
      if (ml.is_number()) most[term] = std::max(most[term], ml.get<double>());
    }
  }
  for (const char* term : termsTestedBy(scenario).terms) EXPECT_GT(most[term], 1.0) << term;
}

class EveryScenario : public ::testing::TestWithParam<std::string> {};
TEST_P(EveryScenario, conservesWaterInItsFirstSeconds) {
  const TermsTested tested = termsTestedBy(GetParam());
  expectWaterConserved(GetParam(), "--seconds " + std::to_string(tested.after_s) +
                                       (tested.terms.empty() ? " --set prewarm_s=0.5" : ""));
}

class LongEveryScenario : public ::testing::TestWithParam<std::string> {};
TEST_P(LongEveryScenario, conservesWaterToItsEnd) { expectWaterConserved(GetParam(), ""); }

std::string nameOf(const ::testing::TestParamInfo<std::string>& scenario) { return scenario.param; }
INSTANTIATE_TEST_SUITE_P(Shipped, EveryScenario, ::testing::ValuesIn(shippedScenarios()), nameOf);
INSTANTIATE_TEST_SUITE_P(Long, LongEveryScenario, ::testing::ValuesIn(shippedScenarios()), nameOf);

}  // namespace
}  // namespace testing_host
