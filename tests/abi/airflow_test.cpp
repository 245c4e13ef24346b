// The air over a pane as a host says it is, through the ABI.
#include "bad_arguments.h"
#include "plugin_library.h"

namespace rg::test {
namespace {

class AirflowArguments : public BadArguments {};

TEST_F(AirflowArguments, refusesNonsense) {
  const std::array<float, 3> up{0.0f, 0.0f, 1.0f};
  rg_airflow good;
  api.default_airflow(&good);
  good.columns = good.rows = 1;
  good.ahead = up.data();
  EXPECT_EQ(api.set_airflow(scene.instance, kPane, &good), RG_OK);
  EXPECT_EQ(api.set_airflow(scene.instance, kPane, nullptr), RG_OK);
  expectRefused(
      "an unknown pane", [&] { return api.set_airflow(scene.instance, 77, &good); }, RG_ERROR_NOT_FOUND,
      "pane 77");
  const auto refused = [&](const char* what, const std::string& field,
                           const std::function<void(rg_airflow&)>& spoil) {
    rg_airflow airflow = good;
    spoil(airflow);
    expectRefused(
        what, [&] { return api.set_airflow(scene.instance, kPane, &airflow); }, RG_ERROR_BAD_ARGUMENT, field);
  };
  const std::array<float, 3> storm{0.0f, 1e9f, 0.0f}, nan{0.0f, 0.0f, std::nanf("")};
  refused("rows without columns", "columns", [](rg_airflow& a) { a.columns = 0; });
  refused("too many", "columns", [](rg_airflow& a) { a.columns = 1'000'000; });
  refused("no field", "ahead", [](rg_airflow& a) { a.ahead = nullptr; });
  refused("a storm", "ahead", [&](rg_airflow& a) { a.ahead = storm.data(); });
  refused("no number", "ahead", [&](rg_airflow& a) { a.ahead = nan.data(); });
  expectStructChecked<rg_airflow>(
      "rg_airflow", good,
      {offsetof(rg_airflow, stagnation), offsetof(rg_airflow, outward), offsetof(rg_airflow, lee),
       offsetof(rg_airflow, drag_friction)},
      [&](const rg_airflow& a) { return api.set_airflow(scene.instance, kPane, &a); });
}

// A large drop in the middle of the pane, no rain, the car at 10 m/s: where has its water gone?
rg_pane_stats afterTwoSeconds(const rg_api& api, const rg_airflow* airflow, uint64_t& hash) {
  SmallScene scene(api);
  scene.expect(scene.api.remove_wiper(scene.instance, kWiper));
  scene.rain_mm_h = 0.0;
  if (airflow != nullptr) scene.expect(scene.api.set_airflow(scene.instance, kPane, airflow));
  scene.expect(scene.setPane());  // again: what air runs over it stays as told
  rg_glass_drop drop{};
  drop.base_radius_m = 2e-3;
  drop.contact_angle_deg = 60.0;
  scene.expect(scene.step());
  scene.expect(scene.api.place_drops(scene.instance, kPane, &drop, 1));
  for (int i = 0; i < 120; ++i) scene.expect(scene.step());
  rg_pane_stats stats{};
  stats.struct_size = sizeof stats;
  scene.expect(scene.api.get_pane_stats(scene.instance, kPane, &stats));
  scene.expect(scene.api.get_hash(scene.instance, RG_HASH_STATE, &hash));
  return stats;
}

TEST(HostsAirflow, drivesWaterWhereItBlows) {
  PluginLibrary library;
  const rg_api& api = *library.api;
  rg_airflow airflow;
  api.default_airflow(&airflow);
  uint64_t by_default = 0, as_default = 0, other = 0;
  const rg_pane_stats still = afterTwoSeconds(api, nullptr, by_default);
  afterTwoSeconds(api, &airflow, as_default);
  EXPECT_EQ(as_default, by_default) << "the default's numbers are the default";
  EXPECT_EQ(still.blown_ml, 0.0);

  // Four and a half times the free air's speed: 45 m/s.
  const std::array<float, 6> up{0.0f, 0.0f, 4.5f, 0.0f, 0.0f, 4.5f},
      down{0.0f, 0.0f, -4.5f, 0.0f, 0.0f, -4.5f};
  airflow.columns = 2;
  airflow.rows = 1;
  airflow.ahead = up.data();
  const rg_pane_stats risen = afterTwoSeconds(api, &airflow, other);
  EXPECT_GT(risen.blown_ml, 0.5 * risen.caught_ml) << "over the upper edge";
  EXPECT_NE(other, by_default);
  airflow.ahead = down.data();
  const rg_pane_stats fallen = afterTwoSeconds(api, &airflow, other);
  EXPECT_GT(fallen.drained_ml, 0.5 * fallen.caught_ml) << "over the lower edge";
  EXPECT_EQ(fallen.blown_ml, 0.0);
}

}  // namespace
}  // namespace rg::test
