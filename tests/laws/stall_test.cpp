// A host that stalls: what is caught up with is bounded, what is left out is told, and no water is lost or
// made meanwhile.
#include "draws.h"
#include "gl_fixture.h"
#include "rig.h"

namespace rg::test {
namespace {

class StallLaws : public Drawing<GlTest> {
 protected:
  StallLaws() : rig(draws.number()) {
    Plate plate;
    plate.width_m = 0.5;
    plate.height_m = 0.3;
    rig.set(1, plate);
    rig.weather.rain_mm_h = kRain_mm_h;
    rig.attach();
  }
  ~StallLaws() override = default;

  // The rain that came in the time that was not left out.
  void expectCaughtBut(const rg_pane_stats& s) const {
    const double law_ml = kRain_mm_h / 3.6 * std::cos(rad(30)) * s.area_m2 * (rig.time_s() - s.dropped_s);
    EXPECT_NEAR(s.caught_ml / law_ml, 1.0, 0.15) << "left out " << s.dropped_s << " s of " << rig.time_s();
  }

  double longestCatchUp_s() const {
    rg_parameter parameter{};
    parameter.struct_size = sizeof parameter;
    for (uint32_t i = 0; std::string_view(parameter.name) != "time.catch_up_s"; ++i)
      rig.expect(rig.api.get_parameter(rig.instance, i, &parameter));
    EXPECT_EQ(parameter.preset, parameter.maximum);
    return parameter.maximum;
  }

  static constexpr double kRain_mm_h = 30.0;
  Rig rig;
};

TEST_F(StallLaws, whatIsCaughtUpWithIsBoundedAndTheRestIsTold) {
  rig.run(1.0);
  EXPECT_EQ(rig.stats(1).dropped_s, 0.0);
  const double longest_s = longestCatchUp_s();
  rig.expect(rig.api.set_parameter(rig.instance, "time.catch_up_s", longest_s));
  rig.update(std::llround(longest_s * 120.0));
  EXPECT_EQ(rig.result, RG_OK);
  EXPECT_EQ(rig.stats(1).dropped_s, 0.0) << "what is caught up with is caught up with on glass too";
  const double stall_s = draws.between(60, 600), bound_s = draws.between(0.5, 3.0);
  SCOPED_TRACE("a stall of " + std::to_string(stall_s) + " s, caught up with " + std::to_string(bound_s) +
               " s");
  rig.expect(rig.api.set_parameter(rig.instance, "time.catch_up_s", bound_s));
  const auto ticks = static_cast<int64_t>(stall_s * 120.0);
  rig.update(ticks);
  EXPECT_EQ(rig.result, RG_REMARK_TIME_DROPPED);
  rig.run(1.0);
  EXPECT_EQ(rig.result, RG_OK);
  const rg_pane_stats s = rig.stats(1);
  EXPECT_NEAR(s.dropped_s, static_cast<double>(ticks) / 120.0 - bound_s, 1.0 / 120.0);
  expectCaughtBut(s);
  expectNothingLost(s);
  rig.reset();
  rig.run(0.0);
  EXPECT_EQ(rig.stats(1).dropped_s, 0.0);
}

// The same while step_gpu does not come. What was placed and washed on meanwhile is there afterwards.
TEST_F(StallLaws, withoutTheGpuNoOrderedWaterIsLost) {
  rig.run(1.0);
  const double before_ml = rig.stats(1).caught_ml;
  rig.weather.rain_mm_h = 0.0;
  const auto seconds = static_cast<int64_t>(draws.between(6, 12));
  double placed_ml = 0.0;
  for (int64_t k = 0; k < 60 * seconds; ++k) {
    rig.update(2, false);
    if (k % 30 != 0) continue;
    const double radius_m = draws.between(0.5e-3, 1e-3);  // 90 degrees: half a ball
    rig.place(1, {{draws.between(-0.2, 0.2), draws.between(-0.1, 0.1), radius_m, 90.0}});
    placed_ml += 2.0 / 3.0 * kPi * std::pow(radius_m, 3.0) * 1e6;
  }
  rig.sprinkle(1, 5e-6, 0.5, 3);
  for (int64_t k = 0; k < 60 * seconds; ++k) rig.update(2, false);
  const rg_pane_stats s = rig.stats(1);
  EXPECT_GT(s.dropped_s, static_cast<double>(2 * seconds) - 5.5);  // it waits for 5 s of ticks
  EXPECT_LT(s.dropped_s, static_cast<double>(2 * seconds) - 4.5);
  // Rain ends within the two ticks to the first sample without; jets' shares of 20 m away are right to some
  // per mille.
  EXPECT_NEAR(s.caught_ml - before_ml, placed_ml + 5.0, 0.1);
  expectNothingLost(s);
}

}  // namespace
}  // namespace rg::test
