// Ledgers in every regime, over ten minutes with --long: all the water that was caught is on the glass or
// went over an edge, off a blade or into the air.
#include "draws.h"
#include "gl_fixture.h"
#include "rig.h"

namespace rg::test {
namespace {

struct Regime {
  const char* name;
  double rain_mm_h, snow_mm_h, speed_mps, wiper_cpm, humidity, temperature_c;
  int32_t glass;
  double brakes_mps2 = 0.0;  // to and fro
  double wash_every_s = 0.0;
  friend void PrintTo(const Regime& regime, std::ostream* out) { *out << regime.name; }
};

const Regime kRegimes[] = {{"parked in rain", 10, 0, 0, 0, 0.9, 12, RG_GLASS_UNCOATED},
                           {"drizzle, dry air", 0.5, 0, 0, 0, 0.4, 20, RG_GLASS_DIRTY},
                           {"downpour, wiped", 100, 0, 10, 60, 0.95, 12, RG_GLASS_UNCOATED},
                           {"downpour, not wiped", 100, 0, 0, 0, 0.95, 12, RG_GLASS_DIRTY},
                           {"fast, coated", 25, 0, 36, 0, 0.9, 12, RG_GLASS_COATED},
                           {"fast, new coating, wiped", 25, 0, 30, 45, 0.8, 12, RG_GLASS_NEW_COATING},
                           {"braking", 10, 0, 20, 45, 0.9, 12, RG_GLASS_UNCOATED, 4.0},
                           {"sleet", 5, 5, 15, 45, 0.9, 1, RG_GLASS_UNCOATED},
                           {"washed in dry air", 0, 0, 8, 45, 0.3, 25, RG_GLASS_DIRTY, 0.0, 5.0}};

class Ledger : public Drawing<GlTest> {
 protected:
  Ledger() : rig(draws.number()) { rig.attach(); }
  void run(const Regime& regime, double seconds) {
    SCOPED_TRACE(regime.name);
    rig.reset();
    Plate plate;
    plate.width_m = 0.36;
    plate.height_m = 0.24;
    plate.bulge_m = 0.02;
    plate.glass = regime.glass;
    rig.set(1, plate);
    rig.put(1, 0.0, {regime.speed_mps, 0.0, 0.0});
    if (regime.wiper_cpm > 0.0) setWiper(plate, regime.wiper_cpm);
    rig.weather.rain_mm_h = regime.rain_mm_h;
    rig.weather.snow_mm_h = regime.snow_mm_h;
    rig.weather.humidity = regime.humidity;
    rig.weather.temperature_c = regime.temperature_c;
    rig.run(0.0);
    for (double t = 0.0; t < seconds; t += 1.0) {
      if (regime.brakes_mps2 > 0.0)
        rig.accelerate(1, {std::fmod(t, 4.0) < 2.0 ? -regime.brakes_mps2 : regime.brakes_mps2, 0.0, 0.0});
      if (regime.wash_every_s > 0.0 && std::fmod(t, regime.wash_every_s) < 0.5) rig.sprinkle(1, 2e-5, 0.5, 2);
      rig.run(std::min(1.0, seconds - t));
      if (std::fmod(t, 60.0) < 0.5) expectNothingLost(rig.stats(1));
    }
    const rg_pane_stats s = rig.stats(1);
    std::printf(
        "%-24s caught %.2f: on glass %.2f (%u drops) drained %.2f wiped %.2f blown %.2f evaporated %.3f mL\n",
        regime.name, s.caught_ml, s.on_glass_ml, s.drops, s.drained_ml, s.wiped_ml, s.blown_ml,
        s.evaporated_ml);
    EXPECT_GT(s.caught_ml, 0.0);
    EXPECT_EQ(s.dropped_s, 0.0);
    expectNothingLost(s);
    rig.remove(1);
    rig.wipers.clear();
  }

 private:
  void setWiper(const Plate& plate, double cycles_per_min) {
    rg_wiper_info wiper;
    rig.api.default_wiper_info(&wiper);
    wiper.pane = 1;
    const glm::dvec3 pivot = kMiddle_m - 0.12 * plate.up();
    for (int i = 0; i < 3; ++i) {
      wiper.pivot_m[i] = pivot[i];
      wiper.axis[i] = plate.outward()[i];
      wiper.rest_direction[i] = i == 1 ? 1.0 : 0.0;
    }
    wiper.arm_m = 0.12;
    wiper.blade_m = 0.18;
    wiper.wear = 0.5;
    rig.expect(rig.api.set_wiper(rig.instance, 1, &wiper));
    rig.wipers[1] = [cycles_per_min](double time_s) {
      return 1.5 - 1.2 * std::cos(2.0 * kPi * time_s * cycles_per_min / 60.0);
    };
  }

  Rig rig;
};

TEST_F(Ledger, closesInEveryRegime) {
  for (const Regime& regime : kRegimes) run(regime, 2.0);
}

class LongLedger : public Ledger, public ::testing::WithParamInterface<Regime> {};
TEST_P(LongLedger, closesOverTenMinutes) { run(GetParam(), 600.0); }
INSTANTIATE_TEST_SUITE_P(Long, LongLedger, ::testing::ValuesIn(kRegimes),
                         [](const ::testing::TestParamInfo<Regime>& param) {
                           std::string name = param.param.name;
                           std::erase_if(
                               name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
                           return name;
                         });

}  // namespace
}  // namespace rg::test
