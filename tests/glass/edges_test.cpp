// Over each of a pane's edges water leaves it, and the ledger says how: blown off over the upper, drained
// over the others.
#include <gtest/gtest.h>

#include <array>

#include "gl_fixture.h"
#include "lone_film.h"

namespace rg::test {
namespace {

class Edges : public GlTest {};

struct Way {
  const char* edge;
  glm::dvec2 towards;  // right, up
  bool blows;
};
constexpr std::array<Way, 4> kWays{{{"lower", {0.0, -1.0}, false},
                                    {"upper", {0.0, 1.0}, true},
                                    {"left", {-1.0, 0.0}, false},
                                    {"right", {1.0, 0.0}, false}}};

// By acceleration (braking, a curve) and by the air's shear (run-back at speed), to the last picolitre.
TEST_F(Edges, filmRunsOverEachAndIsTold) {
  for (const Way& way : kWays) {
    for (const bool by_air : {false, true}) {
      SCOPED_TRACE(std::string(way.edge) + (by_air ? ", by air" : ", by acceleration"));
      LoneFilm film(gl, {24, 20}, 3e-3);
      film.lay([](glm::dvec2) { return 120e-6; });
      const glm::dvec2 push = (by_air ? 1.5 : 6.0) * way.towards;
      film.run(1, 8.0, glm::dvec4(0.0));
      const int64_t before = film.volume_pl();
      film.run(60, 8.0, by_air ? glm::dvec4(0.0, 0.0, push) : glm::dvec4(push, 0.0, 0.0));
      EXPECT_GT(film.drained_pl + film.blown_pl, before / 5);
      EXPECT_EQ(film.drained_pl + film.blown_pl, before - film.volume_pl());
      EXPECT_EQ(way.blows ? film.drained_pl : film.blown_pl, 0);
    }
  }
}

// Drops too.
TEST(DropEdges, dropsRunOverEachAndAreTold) {
  for (const Way& way : kWays) {
    SCOPED_TRACE(way.edge);
    const Mesh mesh = windscreen(0.2, 0.2, rad(30));
    glass::PaneInfo info = paneInfo(mesh);
    info.glass = glass::Glass::new_coating;
    glass::PaneSim sim(info, 1, 7);
    const glass::PlacedDrop drop{0.06 * way.towards.x, 0.06 * way.towards.y, 2.5e-3, rad(101)};
    sim.placeDrops({&drop, 1});
    glass::PaneTick tick = weather(0.0);
    const glm::dvec3 up(-std::cos(rad(30)), 0.0, std::sin(rad(30))), right(0.0, -1.0, 0.0);
    tick.acceleration_mps2 = 6.0 * (way.towards.x * right + way.towards.y * up) - 8.0 * glm::cross(right, up);
    for (tick.index = 1; tick.index <= 120; ++tick.index) sim.submit(tick);
    const glass::PaneStats s = sim.stats();
    EXPECT_EQ(s.caught_pl, sumOf(s));
    // What it leaves behind is a small part; without a film it is booked as drained.
    EXPECT_GT(way.blows ? s.blown_pl : s.drained_pl, s.caught_pl * 8 / 10);
    EXPECT_EQ(s.blown_pl > 0, way.blows);
  }
}

}  // namespace
}  // namespace rg::test
