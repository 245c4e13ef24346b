// A window that slides: what is behind its sill gets no rain, and what goes there leaves its water.
#include "glass/slide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "gl_fixture.h"
#include "glass/airflow.h"
#include "glass/impact.h"
#include "scene.h"

namespace rg::test {
namespace {

constexpr double kWindow_m = 0.3, kWindowTexel_m = 6e-3;

// A side window: nearly upright, looking ahead, so that wind drives rain at it.
Mesh window() { return windscreen(0.45, kWindow_m, rad(75), 0.0, 4); }

glass::PaneInfo info(const Mesh& mesh) {
  glass::PaneInfo info = paneInfo(mesh);
  info.texel_m = kWindowTexel_m;
  return info;
}

glass::PaneTick opened(glass::PaneTick tick, double opening_m) {
  tick.opening_m = opening_m;
  return tick;
}

// Of texels that are behind the sill at an opening: how much film there is, or -1 where one is no glass.
struct Hidden {
  size_t texels = 0, off = 0;
  int64_t film_pl = 0;
};
Hidden behindSill(Simulation& run, double opening_m, double more_m = 0.0) {
  Hidden out;
  const std::vector<int32_t> film = run.pane.readFilm();
  const glass::PaneMap& map = run.sim->map();
  for (int i = 0; i < map.texelCount(); ++i) {
    const double way_m = run.sim->slide().way_m(glm::dvec3(map.texel(i).position_m));
    if (!map.inside(i) || way_m + more_m >= opening_m) continue;
    ++out.texels;
    out.off += film[static_cast<size_t>(i)] < 0 ? size_t{1} : size_t{0};
    out.film_pl += std::max(film[static_cast<size_t>(i)], 0);
  }
  return out;
}

// The sill is the line of the lower edge, slanted as it may be, and glass is seen as far as there.
TEST(Slide, itsOwnSillIsTheLowerEdge) {
  Mesh mesh = window();
  const glm::vec3 up(-std::cos(rad(75)), 0.0, std::sin(rad(75)));
  // As a car's waistline rises: all columns raised in proportion.
  for (size_t i = 0; i < mesh.positions.size(); ++i) mesh.positions[i] += 0.08f * mesh.uvs[i].x * up;
  const glass::PaneInfo pane = info(mesh);
  const glass::PaneMap map(pane);
  const glass::Slide slide(pane, map);
  constexpr double kTolerance_m = 1e-6;  // of float positions
  EXPECT_NEAR(glm::distance(slide.direction(), -glm::dvec3(up)), 0.0, 1e-6);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double above_m = kWindow_m * static_cast<double>(mesh.uvs[i].y);
    EXPECT_NEAR(slide.way_m(glm::dvec3(mesh.positions[i])), above_m, kTolerance_m);
    const glm::dvec4 place(glm::dvec3(mesh.positions[i]), 1.0);
    EXPECT_NEAR(glm::dot(slide.seenWhere(above_m), place), 0.0, kTolerance_m)
        << "slid so far it is at the sill";
    EXPECT_GT(glm::dot(slide.seenWhere(above_m - 0.01), place), 0.009);
    EXPECT_LT(glm::dot(slide.seenWhere(above_m + 0.01), place), -0.009);
  }
}

TEST(Slide, refusesASillThatCannotBe) {
  const Mesh mesh = window();
  const auto refused = [&](const glm::dvec3& direction, const glm::dvec4& sill, const std::string& why) {
    glass::PaneInfo pane = info(mesh);
    pane.slide_direction = direction;
    pane.sill = sill;
    try {
      const glass::PaneSim sim(pane, 1, 7);
      FAIL() << "accepted; should say: " << why;
    } catch (const std::invalid_argument& e) {
      EXPECT_NE(std::string(e.what()).find("'windscreen'"), std::string::npos) << e.what();
      EXPECT_NE(std::string(e.what()).find(why), std::string::npos) << e.what();
    }
  };
  refused({1.0, 0.0, 0.0}, glm::dvec4(0.0), "along its own surface");
  refused(glm::dvec3(0.0), {0.0, 1.0, 0.0, 0.0}, "across the way");
  refused(glm::dvec3(0.0), {0.0, 0.0, 1.0, 0.0}, "across the way");  // it would come out of its sill
}

// Half a window catches half; drops lie on what is seen alone, and none where the host's own sill hides it
// though it is shut.
TEST(Slide, whatIsBehindTheSillCatchesNothing) {
  const Mesh mesh = window();
  for (const bool own_sill : {true, false}) {
    glass::PaneInfo pane = info(mesh);
    const double opening_m = own_sill ? 0.15 : 0.0;
    if (!own_sill) pane.sill = {0.0, 0.0, -1.0, -1.2};  // through the pane's middle
    const glass::PaneTick rain = opened(weather(50.0, 10.0), opening_m);
    glass::PaneSim sim(pane, 1, 7);
    const double shut_m3_s = glass::catchRate_m3_s(sim.map(), rain);
    for (int64_t i = 1; i <= 240; ++i) {
      glass::PaneTick tick = rain;
      tick.index = i;
      sim.submit(tick);
    }
    // A row of texels more or less.
    EXPECT_NEAR(glass::catchRate_m3_s(sim.map(), rain) / shut_m3_s, 0.5, kWindowTexel_m / kWindow_m);
    const auto seen = sim.snapshot();
    EXPECT_GT(seen->drops.size(), 50u);
    for (const auto& drop : seen->drops) {
      const auto place = sim.map().vehicleFromGrid(glm::dvec2(drop.position_m));
      ASSERT_TRUE(place);
      EXPECT_GE(sim.slide().way_m(*place), opening_m - kWindowTexel_m);
    }
  }
}

// The air's field is the car's: a pane that has slid down stands in the air that is there.
TEST(Slide, airOverTheGlassIsThatOfThePlaceItHasSlidTo) {
  const Mesh mesh = windscreen(0.45, kWindow_m, rad(60), 0.0, 4);
  const glass::PaneInfo pane = info(mesh);
  const glass::PaneMap map(pane);
  const glm::dvec3 air(-20.0, 0.0, 0.0), gravity(0.0, 0.0, -9.81);
  glass::ForceField shut, open;
  shut.make(map, gravity, air);
  open.make(map, gravity, air, -0.1 * map.meanUp());
  for (const double v_m : {0.0, 0.05, 0.12}) {
    const glm::dvec2 there = map.gridFromGlass({0.03, v_m - 0.1}), glass = map.gridFromGlass({0.03, v_m});
    // Linear between nodes that lie some 0.1 m apart.
    EXPECT_NEAR(glm::distance(open.at(map, glass).air_mps, shut.at(map, there).air_mps), 0.0, 0.3);
    EXPECT_GT(glm::distance(open.at(map, glass).air_mps, shut.at(map, glass).air_mps), 1.0);
  }
}

class SlidingFilm : public GlTest {};

// Rain, then a dry spell in which the window goes half down and up again: the seal's water is that which was
// there, to the last picolitre, and what comes back is dry.
TEST_F(SlidingFilm, theSealStripsWhatGoesDown) {
  const Mesh mesh = window();
  Simulation run(gl, info(mesh));
  run.run(weather(100.0, 10.0), 1.5);
  const glass::PaneTick still = opened(weather(0.0), 0.0);
  run.run(still, 0.5);
  const glass::PaneStats before = run.stats();
  ASSERT_GT(behindSill(run, 0.2).film_pl, 0) << "there is nothing to strip";

  // At once: more texels than a step strips.
  run.run(opened(still, 0.2), 0.5);
  const glass::PaneStats down = run.stats();
  const Hidden behind = behindSill(run, 0.2);
  EXPECT_GT(behind.texels, 2048u);
  EXPECT_EQ(behind.off, behind.texels);
  EXPECT_EQ(down.caught_pl, before.caught_pl);
  EXPECT_EQ(down.caught_pl, sumOf(down));
  EXPECT_GT(down.drained_pl - before.drained_pl, before.on_glass_pl / 4);
  EXPECT_EQ(down.wiped_pl, 0);

  run.run(still, 0.05);
  const glass::PaneStats up = run.stats();
  EXPECT_EQ(up.caught_pl, sumOf(up));
  constexpr double kRunsDown_m = 0.08;  // as far as water from above may come in that time
  const Hidden back = behindSill(run, 0.2, kRunsDown_m);
  EXPECT_GT(back.texels, 500u);
  EXPECT_EQ(back.off, 0u);
  EXPECT_EQ(back.film_pl, 0);
  for (const auto& drop : run.sim->snapshot()->drops) {
    const auto place = run.sim->map().vehicleFromGrid(glm::dvec2(drop.position_m));
    EXPECT_TRUE(place && run.sim->slide().way_m(*place) > 0.2 - kRunsDown_m);
  }
}

// A film that is made in the middle of its step, the window half down, has no glass behind the sill from that
// step on.
TEST_F(SlidingFilm, madeInTheMiddleOfAStepKnowsOfTheSill) {
  const Mesh mesh = window();
  glass::PaneInfo pane = info(mesh);
  pane.max_drops = 0;  // all is film
  const auto sim = std::make_shared<glass::PaneSim>(pane, 1, 7);
  glass::PaneTick flood = opened(weather(0.0, 15.0), 0.15);
  flood.class_count = 1;
  flood.classes[0] = {3e-3, 2e4, 8.0};  // some 100 um in a tick: it flows at once
  for (flood.index = 1; flood.index <= 3; ++flood.index) sim->submit(flood);
  glass::PaneGl gpu(gl, glass::makeFilmPrograms(gl), sim);
  for (; flood.index <= 7; ++flood.index) {
    sim->submit(flood);
    gpu.finish();
    const glass::PaneStats s = sim->stats();
    EXPECT_EQ(s.caught_pl, sumOf(s)) << "tick " << flood.index;
  }
  EXPECT_GT(sim->stats().film_pl, 0);
}

// A film that is made while the window is open, and in its first step the window closes: that makes no water.
TEST_F(SlidingFilm, hiddenAndShownInOneStepIsDry) {
  const Mesh mesh = window();
  Simulation run(gl, info(mesh));
  run.sim->detachFilm();
  for (int i = 0; i < 2; ++i) run.tick(opened(weather(0.0), 0.15));
  run.sim->attachFilm();
  for (int i = 0; i < 4; ++i) run.tick(weather(0.0));
  const glass::PaneStats s = run.stats();
  EXPECT_EQ(s.film_pl, 0);
  const std::vector<int32_t> film = run.pane.readFilm();
  for (int i = 0; i < run.sim->map().texelCount(); ++i)
    ASSERT_EQ(film[static_cast<size_t>(i)], run.sim->map().inside(i) ? 0 : -1) << i;
}

// Up and down in a downpour, the last ticks as when it stands open; then the film is lost with its context.
TEST_F(SlidingFilm, theLedgerClosesWhereverItStands) {
  const Mesh mesh = window();
  for (const auto surface : {glass::Glass::uncoated, glass::Glass::coated}) {
    glass::PaneInfo pane = info(mesh);
    pane.glass = surface;
    Simulation run(gl, pane);
    const glass::PaneTick rain = weather(100.0, 15.0, 0.8);
    for (int i = 0; i < 360; ++i) {
      run.tick(opened(rain, 0.12 * (1.0 - std::cos(i * 0.06))));
      if (i % 3 == 0) run.pane.step();
    }
    glass::PaneStats s = run.stats();
    EXPECT_EQ(s.caught_pl, sumOf(s));
    run.run(opened(rain, 0.2), 0.3);
    s = run.stats();
    EXPECT_EQ(s.caught_pl, sumOf(s));
    const Hidden behind = behindSill(run, 0.2);
    EXPECT_EQ(behind.off, behind.texels);
    run.sim->detachFilm();
    run.tick(opened(rain, 0.2));  // the film comes back in the middle of its step
    run.sim->attachFilm();
    glass::PaneGl again(gl, glass::makeFilmPrograms(gl), run.sim);
    for (int i = 0; i < 20; ++i) {
      run.tick(opened(rain, 0.2));
      again.step();
    }
    again.finish();
    s = run.sim->stats();
    EXPECT_EQ(s.caught_pl, sumOf(s));
    const std::vector<int32_t> film = again.readFilm();
    int64_t off = 0;
    for (int i = 0; i < run.sim->map().texelCount(); ++i)
      off += run.sim->map().inside(i) && film[static_cast<size_t>(i)] < 0 ? 1 : 0;
    EXPECT_EQ(off, static_cast<int64_t>(behind.texels)) << "a film made anew knows of the sill";
    run.sim->detachFilm();
  }
}

}  // namespace
}  // namespace rg::test
