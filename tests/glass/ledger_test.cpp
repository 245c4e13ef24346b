// Water is conserved to the last picolitre, in every regime.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>

#include "gl_fixture.h"
#include "scene.h"

namespace rg::test {
namespace {

class Ledger : public GlTest {};

double ml(int64_t pl) { return static_cast<double>(pl) * 1e-9; }

void print(const char* what, const glass::PaneStats& s, double wall_s) {
  std::printf(
      "%-22s caught %.2f on glass %.2f (film %.2f drops %.2f = %u ridge %.2f travelling %.3f) drained %.2f "
      "wiped %.2f blown %.2f evaporated %.4f mL; %.2f s\n",
      what, ml(s.caught_pl), ml(s.on_glass_pl), ml(s.film_pl), ml(s.drops_pl), s.drops, ml(s.ridge_pl),
      ml(s.travelling_pl), ml(s.drained_pl), ml(s.wiped_pl), ml(s.blown_pl), ml(s.evaporated_pl), wall_s);
}

struct Regime {
  const char* name;
  double rate_mm_h, speed_mps, wiper_cpm, humidity;
  glass::Glass glass;
};

TEST_F(Ledger, closesExactlyInEveryRegime) {
  const Mesh mesh = windscreen(0.9, 0.6, rad(30), 0.05);
  for (const Regime& regime : {Regime{"parked", 10, 0, 0, 0.9, glass::Glass::uncoated},
                               Regime{"downpour, wiped", 100, 10, 60, 0.9, glass::Glass::uncoated},
                               Regime{"fast, coated", 25, 36, 0, 0.9, glass::Glass::coated},
                               Regime{"dry air, dirty", 2, 14, 45, 0.3, glass::Glass::dirty}}) {
    const auto start = std::chrono::steady_clock::now();
    glass::PaneInfo info = paneInfo(mesh);
    info.glass = regime.glass;
    Simulation run(gl, info);
    run.sim->setWiper(3, wiper(rad(30), 0.6));
    const WiperMotor motor(3, rad(5), rad(120), regime.wiper_cpm);
    run.run(weather(regime.rate_mm_h, regime.speed_mps, regime.humidity), 4.0,
            regime.wiper_cpm > 0.0 ? &motor : nullptr);
    const glass::PaneStats s = run.stats();
    print(regime.name, s, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    EXPECT_EQ(s.caught_pl, sumOf(s)) << regime.name;
    EXPECT_GT(s.caught_pl, 0) << regime.name;
    // The report's sum of the film is that of its texels.
    int64_t film = 0;
    for (const int32_t v : run.pane.readFilm()) film += std::max(v, 0);
    EXPECT_EQ(film, s.film_pl) << regime.name;
  }
}

}  // namespace
}  // namespace rg::test
