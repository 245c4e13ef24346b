// Thin films through the ABI: how they flow, drain and stand under rain (physics.md 4). Films are laid evenly
// on level panes, which are then tilted; what runs over the edges and what is left is read from the ledger.
#include "draws.h"
#include "gl_fixture.h"
#include "rig.h"

namespace rg::test {
namespace {

constexpr double kFriction = 0.004;  // C_f of the plugin's airflow, within physics.md's 0.003 .. 0.005
constexpr double kM3 = 1e-6;         // in a mL

class FilmLaws : public Drawing<GlTest> {
 protected:
  static Plate filmOnly(double width_m, double height_m, double slope_rad, double texel_m = 3e-3) {
    Plate plate;
    plate.width_m = width_m;
    plate.height_m = height_m;
    plate.slope_rad = slope_rad;
    plate.texel_m = texel_m;
    plate.max_drops = 0;
    return plate;
  }
};

// tau = rho_a C_f U^2 / 2.
double windOfShear_mps(double tau_pa) { return std::sqrt(2.0 * tau_pa / (kRhoAir * kFriction)); }

// q = rho g sin a h^3 / (3 mu) - tau h^2 / (2 mu): of an even film as much runs over an edge in a second, for
// as long as nothing has come there from the other edge. Wind up the glass holds it where tau is 2/3 of rho g
// h sin a, and turns it round beyond.
TEST_F(FilmLaws, anEvenFilmFlowsAsGravityAndWindSay) {
  constexpr double kWidth_m = 0.18, kHeight_m = 0.18, kFastest_mps = 0.07;
  // Of what gravity alone makes flow. It goes by the third power of what lies in the fourth of the pane that
  // runs off, which by chance of the jets' 120 000 splashes is the mean to 0.5 % (standard deviation).
  constexpr double kTolerance = 0.025;
  struct Case {
    double ratio;  // tau / (rho g h sin a)
    double slope_rad, h_m;
  };
  std::vector<Case> cases;
  for (const auto& [least, most] :
       {std::pair{0.0, 0.0}, {0.25, 0.45}, {0.55, 0.60}, {0.73, 0.78}, {0.85, 1.0}, {1.1, 1.4}}) {
    // As thick as its waves, without wind, go 5 to 7 cm in a second; below the cap of speed.
    const double slope_rad = rad(draws.between(20, 65));
    const double h_m =
        std::sqrt(draws.between(0.05, kFastest_mps) * kMu / (kRho * kGravity * std::sin(slope_rad)));
    cases.push_back({draws.between(least, most), slope_rad, h_m});
  }
  Rig rig(draws.number());
  rig.attach();
  std::vector<std::pair<uint32_t, double>> films;
  for (uint32_t id = 1; const Case& c : cases) {
    rig.set(id, filmOnly(kWidth_m, kHeight_m, c.slope_rad));
    films.emplace_back(id++, c.h_m);
  }
  rig.lay(films, 8.0, 1.0);
  std::vector<double> laid_m;
  for (uint32_t id = 1; const Case& c : cases) {
    const rg_pane_stats s = rig.stats(id);
    EXPECT_EQ(gone_ml(s), 0.0) << "it does not lie still";
    laid_m.push_back(s.caught_ml * kM3 / s.area_m2);
    EXPECT_NEAR(laid_m.back() / c.h_m, 1.0, 0.01);
    const double tau_pa = c.ratio * kRho * kGravity * laid_m.back() * std::sin(c.slope_rad);
    const Plate plate = filmOnly(kWidth_m, kHeight_m, c.slope_rad);
    rig.put(id++, 0.0, -windOfShear_mps(tau_pa) * plate.up());  // still air blows up its glass
  }
  rig.run(0.2);
  std::vector<rg_pane_stats> before;
  for (uint32_t id = 1; id <= cases.size(); ++id) before.push_back(rig.stats(id));
  constexpr double kTime_s = 0.85 * kHeight_m / kFastest_mps - 0.2;
  rig.run(kTime_s);
  for (size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const rg_pane_stats s = rig.stats(static_cast<uint32_t>(i + 1));
    const double by_gravity =
        kRho * kGravity * std::sin(c.slope_rad) * std::pow(laid_m[i], 3.0) / (3.0 * kMu);
    const double drained = (s.drained_ml - before[i].drained_ml) * kM3 / kWidth_m / kTime_s;
    const double blown = (s.blown_ml - before[i].blown_ml) * kM3 / kWidth_m / kTime_s;
    std::printf("tau %.2f rho g h sin a, %.0f deg, %.0f um: flow %.4f of gravity's, law %.4f\n", c.ratio,
                c.slope_rad * 180 / kPi, laid_m[i] * 1e6, (drained - blown) / by_gravity,
                1.0 - 1.5 * c.ratio);
    EXPECT_NEAR((drained - blown) / by_gravity, 1.0 - 1.5 * c.ratio, kTolerance)
        << "tau " << c.ratio << " of rho g h sin a";
    // A texel at the edge that got little may lose some of it.
    EXPECT_LT(c.ratio < 2.0 / 3.0 ? blown : drained, 1e-3 * by_gravity)
        << "it goes the wrong way too, at " << c.ratio;
    expectNothingLost(s);
  }
}

// What is left above a metre of the lower edge of a film that drains: behind the wave from the upper edge a
// thickness goes x = (k h^2 - s h) t, where k = rho g sin a / mu and s = tau / mu, the wind's shear, up.
// Without wind that is Jeffreys 1930, h = sqrt(mu x / (rho g sin a t)), and 2/3 L h(L).
double left_m2(double height_m, double k_per_m_s, double s_per_s, double time_s) {
  const double root = s_per_s * s_per_s + 4.0 * k_per_m_s * height_m / time_s;
  return (s_per_s * height_m +
          time_s / (6.0 * k_per_m_s) * (std::pow(root, 1.5) - std::pow(std::abs(s_per_s), 3.0))) /
         (2.0 * k_per_m_s);
}

// The finer the grid, the nearer; and halving the step changes next to nothing. A step is halved by halving
// sin a at twice the time: the flow of a step is a function of their product alone.
TEST_F(FilmLaws, drainsAsJeffreysSaysAndTheBetterTheFinerTheGrid) {
  constexpr double kWidth_m = 0.06, kHeight_m = 0.3;
  const double slope_rad = rad(draws.between(25, 40)), h_m = draws.between(90e-6, 110e-6);
  const double shear_down = draws.between(0.4, 1.0),
               shear_up = draws.between(0.2, 0.5);  // by rho g h(L) sin a
  SCOPED_TRACE("slope " + std::to_string(slope_rad) + " rad, " + std::to_string(h_m * 1e6) + " um, shear " +
               std::to_string(shear_down) + " down, " + std::to_string(shear_up) + " up");
  Rig rig(draws.number());
  rig.attach();
  enum : uint32_t { kCoarse = 1, kUsual, kFine, kHalfStep, kQuarterStep, kWindDown, kWindUp, kEnd };
  const Plate usual = filmOnly(kWidth_m, kHeight_m, slope_rad);
  rig.set(kCoarse, filmOnly(kWidth_m, kHeight_m, slope_rad, 6e-3));
  rig.set(kFine, filmOnly(kWidth_m, kHeight_m, slope_rad, 1.5e-3));
  for (const uint32_t id : {kUsual, kWindDown, kWindUp}) rig.set(id, usual);
  rig.set(kHalfStep, filmOnly(kWidth_m, kHeight_m, std::asin(std::sin(slope_rad) / 2.0)));
  rig.set(kQuarterStep, filmOnly(kWidth_m, kHeight_m, std::asin(std::sin(slope_rad) / 4.0)));
  std::vector<std::pair<uint32_t, double>> films;
  for (uint32_t id = kCoarse; id < kEnd; ++id) films.emplace_back(id, h_m);
  rig.lay(films, 2.0, 0.5);
  const double k_per_m_s = kRho * kGravity * std::sin(slope_rad) / kMu;
  const double passed_s = kHeight_m / (k_per_m_s * h_m * h_m);
  const double time_s = std::ceil(1.3 * passed_s * 60.0) / 60.0;
  const double tau_pa = kMu * k_per_m_s * std::sqrt(kHeight_m / (k_per_m_s * time_s));
  for (uint32_t id = kCoarse; id < kEnd; ++id) rig.put(id, 0.0);
  rig.put(kWindDown, 0.0, windOfShear_mps(shear_down * tau_pa) * usual.up());
  rig.put(kWindUp, 0.0, -windOfShear_mps(shear_up * tau_pa) * usual.up());
  const auto left = [&](uint32_t id, double shear = 0.0) {
    const rg_pane_stats s = rig.stats(id);
    expectNothingLost(s);
    rig.remove(id);
    return s.on_glass_ml * kM3 / kWidth_m / left_m2(kHeight_m, k_per_m_s, shear * tau_pa / kMu, time_s);
  };
  rig.run(time_s);
  const double coarse = left(kCoarse), at_usual = left(kUsual), fine = left(kFine);
  const double down = left(kWindDown, -shear_down), up = left(kWindUp, shear_up);
  rig.run(time_s);
  const double half = left(kHalfStep);
  rig.run(2.0 * time_s);
  const double quarter = left(kQuarterStep);
  std::printf(
      "left, by the law: texels of 6, 3, 1.5 mm %.4f %.4f %.4f; half a step, a quarter %.4f %.4f; wind down "
      "%.4f, up %.4f\n",
      coarse, at_usual, fine, half, quarter, down, up);
  EXPECT_NEAR(at_usual, 1.0, 0.02) << "with texels of 3 mm";  // first-order upwind; 100 texels
  EXPECT_NEAR(down, 1.0, 0.04) << "wind down the glass";      // the same, and waves up to twice as fast
  EXPECT_NEAR(up, 1.0, 0.02) << "wind up the glass";
  EXPECT_LT(std::abs(at_usual - 1.0), 0.65 * std::abs(coarse - 1.0));
  EXPECT_LT(std::abs(fine - 1.0), 0.65 * std::abs(at_usual - 1.0));
  EXPECT_NEAR(half, at_usual, 0.01);
  EXPECT_NEAR(quarter, half, 0.01);
}

// Nusselt: steady under rain h = (3 mu R_eff x / (rho g sin a))^(1/3), so 3/4 L h(L) stands above each metre
// of the lower edge: under an even supply, and under rain, whose drops make the film uneven: the flux is its
// mean cube, so its mean is less: by up to 11 % here.
TEST_F(FilmLaws, standsUnderRainByTheCubeRootLaw) {
  // First-order upwind lags by half a texel, of fifty at least; jets' chances do the rest.
  constexpr double kEven = 0.02, kRainLeast = 0.85, kRainMost = 1.02;
  const double rain_mm_h = draws.between(60, 140);
  Rig rig(draws.number());
  rig.attach();
  std::vector<Plate> plates;
  for (const auto& [least, most] : {std::pair{20, 35}, {40, 60}})
    plates.push_back(filmOnly(0.24, draws.between(0.15, 0.3), rad(draws.between(least, most))));
  for (uint32_t id = 1; const Plate& plate : plates) rig.set(id++, plate);
  rig.run(0.0);
  const auto law_ml = [](const Plate& plate, double r_eff_mps) {
    const double h_m =
        std::cbrt(3.0 * kMu * r_eff_mps * plate.height_m / (kRho * kGravity * std::sin(plate.slope_rad)));
    return 0.75 * plate.height_m * h_m * plate.width_m / kM3;
  };
  const auto meanOnGlass = [&](double until_steady_s) {
    rig.run(until_steady_s);
    constexpr int kTimes = 12;
    std::vector<double> mean_ml(plates.size(), 0.0);
    for (int k = 0; k < kTimes; ++k) {
      rig.run(0.25);
      for (uint32_t id = 1; id <= plates.size(); ++id) mean_ml[id - 1] += rig.stats(id).on_glass_ml / kTimes;
    }
    return mean_ml;
  };
  // Steady from when what was caught would be as thick as the film at the lower edge.
  double steady_s = 0.0;
  for (const Plate& plate : plates) {
    const double r_eff = rain_mm_h / 3.6e6 * std::cos(plate.slope_rad);
    steady_s = std::max(steady_s, 1.15 * law_ml(plate, r_eff) / (0.75 * plate.area_m2() * r_eff / kM3));
  }
  rig.weather.rain_mm_h = rain_mm_h;
  const std::vector<double> under_rain = meanOnGlass(steady_s);
  rig.weather.rain_mm_h = 0.0;
  const double even_mps = rain_mm_h / 3.6e6, even_s = steady_s + 3.5;
  for (uint32_t id = 1; const Plate& plate : plates)
    rig.sprinkle(id++, even_mps * even_s * plate.area_m2(), even_s);
  const std::vector<double> under_jets = meanOnGlass(steady_s);
  for (size_t i = 0; i < plates.size(); ++i) {
    const double rain_law_ml = law_ml(plates[i], even_mps * std::cos(plates[i].slope_rad)),
                 even_law_ml = law_ml(plates[i], even_mps);
    std::printf("%.0f mm/h, %.0f deg, %.2f m: rain %.4f, evenly %.4f of the law\n", rain_mm_h,
                plates[i].slope_rad * 180 / kPi, plates[i].height_m, under_rain[i] / rain_law_ml,
                under_jets[i] / even_law_ml);
    EXPECT_LT(under_rain[i] / rain_law_ml, kRainMost) << rain_mm_h << " mm/h";
    EXPECT_GT(under_rain[i] / rain_law_ml, kRainLeast) << rain_mm_h << " mm/h";
    EXPECT_NEAR(under_jets[i] / even_law_ml, 1.0, kEven) << rain_mm_h << " mm/h, evenly";
    expectNothingLost(rig.stats(static_cast<uint32_t>(i + 1)));
  }
}

}  // namespace
}  // namespace rg::test
