// A washer's jet through the ABI: its water is caught, all of it, where and when it was ordered, however time
// is cut.
#include "bad_arguments.h"
#include "plugin_library.h"

namespace rg::test {
namespace {

rg_pane_stats paneStats(const SmallScene& scene) {
  rg_pane_stats stats{};
  stats.struct_size = sizeof stats;
  scene.expect(scene.api.get_pane_stats(scene.instance, kPane, &stats));
  return stats;
}

class Wash : public BadArguments {};

TEST_F(Wash, refusesNonsense) {
  const rg_wash_info good = scene.jet();
  const auto refused = [&](const char* what, const std::string& field,
                           const std::function<void(rg_wash_info&)>& spoil, rg_result code) {
    rg_wash_info wash = good;
    spoil(wash);
    expectRefused(
        what, [&] { return api.wash(scene.instance, &wash); }, code, field);
  };
  refused(
      "an unknown pane", "pane 77", [](rg_wash_info& w) { w.pane = 77; }, RG_ERROR_NOT_FOUND);
  refused(
      "a flood", "volume_m3", [](rg_wash_info& w) { w.volume_m3 = 1.0; }, RG_ERROR_BAD_ARGUMENT);
  refused(
      "no time", "duration_s", [](rg_wash_info& w) { w.duration_s = 0.0; }, RG_ERROR_BAD_ARGUMENT);
  refused(
      "no fan", "fan_rad", [](rg_wash_info& w) { w.fan_rad = 0.0; }, RG_ERROR_BAD_ARGUMENT);
  refused(
      "no direction", "direction", [](rg_wash_info& w) { w.direction[0] = 0.0; }, RG_ERROR_BAD_ARGUMENT);
  refused(
      "a jet that looks away", "wash", [](rg_wash_info& w) { w.direction[0] *= -1.0; },
      RG_ERROR_BAD_ARGUMENT);
  refused(
      "a jet on the inner side", "wash", [](rg_wash_info& w) { w.nozzle_m[0] = 0.7, w.direction[0] *= -1.0; },
      RG_ERROR_BAD_ARGUMENT);
  expectStructChecked<rg_wash_info>("rg_wash_info", good,
                                    {offsetof(rg_wash_info, duration_s), offsetof(rg_wash_info, volume_m3),
                                     offsetof(rg_wash_info, nozzle_m) + 8,
                                     offsetof(rg_wash_info, direction) + 16, offsetof(rg_wash_info, fan_rad)},
                                    [&](const rg_wash_info& w) { return api.wash(scene.instance, &w); });
}

// A host of the first header knows no turn, wear and lift: its wiper has the defaults.
TEST(OlderWiper, isTakenAsItIs) {
  PluginLibrary library;
  const SmallScene scene(*library.api);
  rg_wiper_info wiper;
  scene.api.default_wiper_info(&wiper);
  wiper.pane = kPane;
  wiper.struct_size = offsetof(rg_wiper_info, blade_turn);
  wiper.blade_turn = wiper.wear = wiper.lift_m = kNaN;  // beyond what it has
  EXPECT_EQ(scene.api.set_wiper(scene.instance, kWiper, &wiper), RG_OK);
  wiper.struct_size = sizeof wiper;
  EXPECT_EQ(scene.api.set_wiper(scene.instance, kWiper, &wiper), RG_ERROR_BAD_ARGUMENT);
}

// The narrow jet meets the pane whole, a wide one in part; both bring as much as meets it, to the last
// picolitre, between their beginning and their end.
TEST(WashedPane, catchesWhatMeetsItBetweenBeginningAndEnd) {
  PluginLibrary library;
  SmallScene scene(*library.api);
  scene.rain_mm_h = 0.0;
  rg_wash_info wash = scene.jet();
  wash.time_ns = 100'000'000;
  scene.expect(scene.api.wash(scene.instance, &wash));
  const auto runTo = [&](double time_s) {
    while (static_cast<double>(scene.time_ns) * 1e-9 < time_s - 1e-6) scene.expect(scene.step());
  };
  runTo(0.1);
  EXPECT_EQ(paneStats(scene).caught_ml, 0.0);
  runTo(0.35);
  EXPECT_NEAR(paneStats(scene).caught_ml, 2.5, 0.05);  // half of it, to a tick's grain
  runTo(0.7);
  EXPECT_NEAR(paneStats(scene).caught_ml, 5.0,
              0.15);  // texels are a centimetre: their sum is the cone to 3 %
  EXPECT_LE(paneStats(scene).caught_ml, 5.0);
  const double narrow_ml = paneStats(scene).caught_ml;
  wash.time_ns = 0;  // past: at once
  wash.fan_rad = 2.5;
  scene.expect(scene.api.wash(scene.instance, &wash));
  runTo(1.3);
  const double wide_ml = paneStats(scene).caught_ml - narrow_ml;
  // The pane's part of the cone's solid angle: two rectangles that meet before the nozzle, 0.3 m off.
  const double pane_sr = 2.0 * std::atan(0.2 * 0.4 / (0.3 * std::sqrt(0.2 * 0.2 + 0.4 * 0.4 + 0.3 * 0.3)));
  const double cone_sr = 2.0 * 3.14159265358979 * (1.0 - std::cos(0.5 * wash.fan_rad));
  EXPECT_NEAR(wide_ml / (5.0 * pane_sr / cone_sr), 1.0, 0.01);
  const rg_pane_stats s = paneStats(scene);
  EXPECT_NEAR(s.caught_ml, s.on_glass_ml + s.drained_ml + s.wiped_ml + s.blown_ml + s.evaporated_ml, 1e-9);
}

}  // namespace
}  // namespace rg::test
