// What must not matter: left or right, how time is cut, whether the car drives or the wind blows. Through the
// ABI, with everything on the pane at once.
#include "draws.h"
#include "gl_fixture.h"
#include "rig.h"

namespace rg::test {
namespace {

constexpr uint32_t kPane = 3, kWiper = 5;

std::vector<double> termsOf(const rg_pane_stats& s) {
  return {static_cast<double>(s.drops),
          s.area_m2,
          s.caught_ml,
          s.on_glass_ml,
          s.drained_ml,
          s.wiped_ml,
          s.blown_ml,
          s.evaporated_ml,
          s.film_ml,
          s.drops_ml,
          s.ridge_ml};
}

// A curved screen in a curve, rain and wind from the side, wiped and washed.
struct Scene {
  double rain_mm_h, speed_mps, side_wind_mps, side_mps2, temperature_c, humidity;
  explicit Scene(Draws& draws)
      : rain_mm_h(draws.between(30, 90)),
        speed_mps(draws.between(8, 30)),
        side_wind_mps(draws.between(3, 9)),
        side_mps2(draws.between(2, 5)),
        temperature_c(draws.between(5, 30)),
        humidity(draws.between(0.3, 0.8)) {}
  std::string told() const {
    std::ostringstream out;
    out << rain_mm_h << " mm/h, " << speed_mps << " m/s, side wind " << side_wind_mps << " m/s, sideways "
        << side_mps2 << " m/s2, " << temperature_c << " C, humidity " << humidity;
    return out.str();
  }
  // `side` -1: left for right.
  void put(Rig& rig, double side, bool mirrored_grid) const {
    Plate plate;
    plate.width_m = 0.5;
    plate.height_m = 0.36;
    plate.bulge_m = 0.04;
    plate.mirrored = mirrored_grid;
    rig.set(kPane, plate);
    rg_wiper_info wiper;
    rig.api.default_wiper_info(&wiper);
    wiper.pane = kPane;
    const glm::dvec3 pivot = kMiddle_m - 0.18 * plate.up() + side * glm::dvec3(0.0, 0.05, 0.0);
    for (int i = 0; i < 3; ++i) {
      wiper.pivot_m[i] = pivot[i];
      wiper.axis[i] = plate.outward()[i];
      wiper.rest_direction[i] = i == 1 ? side : 0.0;
    }
    wiper.arm_m = 0.16;
    wiper.blade_m = 0.24;
    wiper.blade_angle_rad = side * 0.1;
    wiper.lift_m = 1e-3;
    rig.expect(rig.api.set_wiper(rig.instance, kWiper, &wiper));
    rig.wipers[kWiper] = [side](double time_s) { return side * (1.4 - 0.9 * std::cos(7.0 * time_s)); };
    rig.put(kPane, 0.0, {speed_mps, 0.0, 0.0});
    rig.accelerate(kPane, {0.0, side * side_mps2, 0.0});
    rig.weather.rain_mm_h = rain_mm_h;
    rig.weather.wind_mps[1] = side * side_wind_mps;
    rig.weather.temperature_c = temperature_c;
    rig.weather.humidity = humidity;
    std::vector<rg_glass_drop> drops;
    for (int i = 0; i < 12; ++i)
      drops.push_back({side * (0.036 * i - 0.19), 0.012 * i - 0.05, 1e-3 + 2e-4 * i, 40.0});
    rig.place(kPane, drops);
  }
};

class SymmetryLaws : public Drawing<GlTest> {};

// The mirror's image of a scene, its grid mirrored too so that both draw the same numbers, has the same
// water: to the last picolitre, as mirroring changes but signs.
TEST_F(SymmetryLaws, theMirroredSceneHasTheSameWater) {
  const Scene scene(draws);
  SCOPED_TRACE(scene.told());
  Rig rig(draws.number());
  rig.attach();
  std::array<std::vector<double>, 2> water;
  for (const bool mirrored : {false, true}) {
    rig.reset();
    scene.put(rig, mirrored ? -1.0 : 1.0, mirrored);
    rig.run(2.0);
    const rg_pane_stats s = rig.stats(kPane);
    expectNothingLost(s);
    water[mirrored ? 1 : 0] = termsOf(s);
    for (const double ml : {s.drained_ml, s.evaporated_ml, s.film_ml, s.drops_ml, s.ridge_ml + s.wiped_ml})
      EXPECT_GT(ml, 1e-3);
  }
  EXPECT_EQ(water[0], water[1]);
}

// Screens that meet the wind from the left have in the mean what others have that meet it from the right,
// each with chances of its own: within what their spread says of so few (4.5 standard errors: once in 100
// 000).
TEST(SymmetryLawsInTheMean, windFromEitherSideDoesTheSame) {
  constexpr uint32_t kScreens = 10;
  constexpr double kSure = 4.5;
  Draws draws;
  SCOPED_TRACE(Draws::told());
  const double side_mps = draws.between(5, 9), speed_mps = draws.between(8, 25),
               rain_mm_h = draws.between(40, 90);
  SCOPED_TRACE("side wind " + std::to_string(side_mps) + " m/s, " + std::to_string(speed_mps) + " m/s, " +
               std::to_string(rain_mm_h) + " mm/h");
  Rig rig(draws.number());
  for (uint32_t id = 1; id <= 2 * kScreens; ++id) {
    Plate plate;
    plate.width_m = 0.3;
    plate.height_m = 0.24;
    plate.bulge_m = 0.03;
    plate.max_drops = 2000;
    plate.glass = RG_GLASS_COATED;
    rig.set(id, plate);
    rig.put(id, 0.0, {speed_mps, id <= kScreens ? side_mps : -side_mps, 0.0});
  }
  rig.weather.rain_mm_h = rain_mm_h;
  rig.weather.humidity = 0.5;
  rig.run(2.0);
  std::vector<std::vector<double>> terms;
  for (uint32_t id = 1; id <= 2 * kScreens; ++id) {
    const rg_pane_stats s = rig.stats(id);
    expectNothingLost(s);
    terms.push_back({s.caught_ml, s.on_glass_ml, s.drained_ml, s.blown_ml, s.evaporated_ml});
  }
  constexpr size_t kDrained = 2, kBlown = 3;
  double run_off_ml = 0.0;  // of a screen, below and above
  for (const std::vector<double>& term : terms)
    run_off_ml += (term[kDrained] + term[kBlown]) / static_cast<double>(terms.size());
  for (size_t k = 0; k < terms[0].size(); ++k) {
    std::array<double, 2> mean{};
    double variance = 0.0;
    for (size_t i = 0; i < terms.size(); ++i) mean[i / kScreens] += terms[i][k] / kScreens;
    for (size_t i = 0; i < terms.size(); ++i)
      variance += std::pow(terms[i][k] - mean[i / kScreens], 2.0) / (2 * kScreens - 2);
    const double error = std::sqrt(variance * 2.0 / kScreens);
    std::printf("%.4f and %.4f mL, standard error %.4f\n", mean[0], mean[1], error);
    EXPECT_NEAR(mean[0], mean[1], kSure * error) << "term " << k;
    // Which way a screen's few large drops leave is their chance, and at some speeds next to none go the one
    // or the other: of both together it is well told.
    const double enough_ml = k == kDrained || k == kBlown ? 0.06 * run_off_ml : 0.1 * mean[0];
    EXPECT_LT(error, enough_ml) << "too little to tell, term " << k;
  }
}

// The same inputs give the same state however time is cut into updates and steps.
TEST_F(SymmetryLaws, waterIsTheSameHoweverTimeIsCut) {
  const Scene scene(draws);
  SCOPED_TRACE(scene.told());
  Rig rig(draws.number());
  rig.attach();
  // Samples at the host's own ticks, 40 a second, handed over in updates of these numbers of them, over and
  // over.
  const auto hashOf = [&](const std::vector<int>& cuts) {
    rig.reset();
    scene.put(rig, 1.0, false);
    rig.run(0.0);
    for (size_t k = 0, done = 0; done < 60; ++k) {
      const auto many = std::min<size_t>(60 - done, static_cast<size_t>(cuts[k % cuts.size()]));
      rig.updates(3, many);
      done += many;
    }
    return rig.hash();
  };
  const uint64_t each = hashOf({1});
  EXPECT_EQ(hashOf({2, 7, 1, 3}), each);
  EXPECT_EQ(hashOf({20}), each);
  std::vector<int> drawn;
  for (int i = 0; i < 8; ++i) drawn.push_back(static_cast<int>(draws.between(1, 15)));
  EXPECT_EQ(hashOf(drawn), each) << "cut as drawn";
}

// Still air met at a speed is a headwind of that speed to the glass.
TEST_F(SymmetryLaws, drivingIsAHeadwind) {
  const double speed_mps = draws.between(5, 35);
  SCOPED_TRACE(std::to_string(speed_mps) + " m/s");
  Rig rig(draws.number());
  rig.attach();
  std::array<std::vector<double>, 2> water;
  for (const bool wind : {false, true}) {
    rig.reset();
    Plate plate;
    plate.height_m = 0.3;
    plate.glass = RG_GLASS_COATED;
    rig.set(kPane, plate);
    rig.put(kPane, 0.0, {wind ? 0.0 : speed_mps, 0.0, 0.0});
    rig.weather.wind_mps[0] = wind ? -speed_mps : 0.0;
    rig.weather.rain_mm_h = 50.0;
    rig.run(1.5);
    water[wind ? 1 : 0] = termsOf(rig.stats(kPane));
  }
  EXPECT_EQ(water[0], water[1]);
}

}  // namespace
}  // namespace rg::test
