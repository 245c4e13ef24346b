// The film against the laws of thin films, and the GPU's film against the same law run on the CPU.
#include <gtest/gtest.h>

#include <cstring>

#include "beads.h"
#include "film_reference.h"
#include "gl/loader.h"
#include "gl_fixture.h"
#include "glass/film_gl.h"
#include "glass/film_link.h"
#include "scene.h"

namespace rg::test {
namespace {

constexpr double kRhoG_mu = 1000.0 * 9.81 / 1.0e-3;

class Film : public GlTest {
 protected:
  glass::PaneInfo filmOnly(const Mesh& mesh) {
    glass::PaneInfo info = paneInfo(mesh);
    info.max_drops = 0;
    return info;
  }
  // Mean over the columns at a distance from the upper edge.
  double meanThickness_m(const Simulation& sim, const std::vector<int32_t>& film, double from_top_m,
                         double height_m) {
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < sim.sim->map().texelCount(); ++i) {
      if (!sim.sim->map().inside(i)) continue;
      const double below = 0.5 * height_m - sim.sim->map().glassFromGrid(sim.sim->map().middleOf(i)).y;
      if (std::abs(below - from_top_m) > 0.02) continue;
      sum += sim.thickness_m(film, i);
      ++count;
    }
    return sum / count;
  }
};

// Nusselt: h = (3 mu R_eff x / (rho g sin a))^(1/3) at x below the upper edge, steady under rain.
TEST_F(Film, steadyUnderRainFollowsTheCubeRootLaw) {
  constexpr double kTolerance =
      0.10;  // drops fall one by one, so the film is a little uneven, and the flux is its mean cube
  const double slope = rad(30);
  const Mesh mesh = windscreen(0.09, 0.8, slope);
  Simulation sim(gl, filmOnly(mesh));
  sim.run(weather(50.0), 40.0);
  const double r_eff = 50.0 / 3.6e6 * std::cos(slope);
  std::array<double, 3> mean{};
  constexpr int kTimes = 20;
  for (int k = 0; k < kTimes; ++k) {
    sim.run(weather(50.0), 0.5);
    const std::vector<int32_t> film = sim.pane.readFilm();
    for (size_t i = 0; i < 3; ++i)
      mean[i] += meanThickness_m(sim, film, 0.2 + 0.25 * static_cast<double>(i), 0.8) / kTimes;
  }
  for (size_t i = 0; i < 3; ++i) {
    const double x = 0.2 + 0.25 * static_cast<double>(i);
    const double law = std::cbrt(3.0 * r_eff * x / (kRhoG_mu * std::sin(slope)));
    std::printf("x %.2f m: %.1f um, law %.1f um\n", x, mean[i] * 1e6, law * 1e6);
    EXPECT_NEAR(mean[i] / law, 1.0, kTolerance) << "at " << x << " m";
  }
}

// Jeffreys 1930: after rain h = sqrt(mu x / (rho g sin a t)) wherever the wave from the upper edge has
// passed.
TEST_F(Film, drainsAsJeffreysSays) {
  constexpr double kTolerance = 0.05;  // of upwind differences on a 3 mm grid
  const double slope = rad(30);
  const Mesh mesh = windscreen(0.06, 0.8, slope);
  const glass::PaneInfo info = filmOnly(mesh);
  glass::PaneSim sim(info, 1, 7);
  FilmReference film(sim.map(), sim.unevenness());
  for (int i = 0; i < sim.map().texelCount(); ++i) {
    if (sim.map().inside(i))
      film.film[static_cast<size_t>(i)] =
          static_cast<int32_t>(std::llround(150e-6 * static_cast<double>(sim.map().texel(i).area_m2) * 1e15));
  }
  sim.attachFilm();
  int steps = 0;
  for (const double t_s : {10.0, 20.0, 40.0}) {
    while (steps < std::lround(t_s * 60.0)) {
      for (int half = 0; half < 2; ++half) {
        glass::PaneTick tick = weather(0.0);
        tick.index = 2 * steps + half + 1;
        sim.submit(tick);
      }
      for (const glass::FilmOrder& order : sim.fetchOrders()) sim.deliver(film.run(order));
      ++steps;
    }
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < sim.map().texelCount(); ++i) {
      const double x = 0.4 - sim.map().glassFromGrid(sim.map().middleOf(i)).y;
      if (!sim.map().inside(i) || std::abs(x - 0.5) > 0.01) continue;
      sum += static_cast<double>(film.film[static_cast<size_t>(i)]) * 1e-15 /
             static_cast<double>(sim.map().texel(i).area_m2);
      ++count;
    }
    const double law = std::sqrt(0.5 / (kRhoG_mu * std::sin(slope) * t_s));
    std::printf("t %.0f s: %.1f um, law %.1f um\n", t_s, sum / count * 1e6, law * 1e6);
    EXPECT_NEAR(sum / count / law, 1.0, kTolerance) << "after " << t_s << " s";
  }
}

std::string told(const shared::FilmTile& tile) {
  std::string text;
  for (const int v :
       {tile.event_texel, tile.event_pl, static_cast<int>(tile.film_low_pl), static_cast<int>(tile.film_high),
        tile.drained_pl, tile.blown_pl, tile.evaporated_pl, static_cast<int>(tile.beads_pl)})
    text += std::to_string(v) + " ";
  return text;
}

void expectSame(const glass::FilmReport& got, const glass::FilmReport& expected) {
  ASSERT_EQ(got.taken_pl, expected.taken_pl);
  ASSERT_EQ(got.ridge_pl, expected.ridge_pl);
  ASSERT_EQ(got.thrown, expected.thrown);
  for (size_t t = 0; t < got.tiles.size(); ++t) {
    ASSERT_EQ(std::memcmp(&got.tiles[t], &expected.tiles[t], sizeof(shared::FilmTile)), 0)
        << "tile " << t << " step " << got.step << ": " << told(got.tiles[t]) << ", not "
        << told(expected.tiles[t]);
  }
}

// GLSL lets a GPU round a quotient otherwise in its last bits (2.5 ulp, GLSL 4.50 section 4.7.1), which a
// film that ruptures here or there makes more of: all of it may differ by a thousandth, and texels by a
// hundredth but for a few.
template <typename T>
void expectAlike(const std::vector<T>& got, const std::vector<T>& expected, const char* what) {
  ASSERT_EQ(got.size(), expected.size());
  double got_pl = 0.0, expected_pl = 0.0;
  int others = 0;
  for (size_t i = 0; i < got.size(); ++i) {
    const auto a = static_cast<double>(got[i]), b = static_cast<double>(expected[i]);
    got_pl += a;
    expected_pl += b;
    others += std::abs(a - b) > 0.01 * std::abs(b) + 100.0 ? 1 : 0;
  }
  std::printf("%s: %.6g of %.6g, %d of %zu texels differ\n", what, got_pl, expected_pl, others, got.size());
  EXPECT_NEAR(got_pl, expected_pl, 1e-3 * expected_pl) << what;
  EXPECT_LT(others, static_cast<int>(got.size()) / 50) << what;
}

// Shared out among invocations as software GL and as a GPU likes it.
std::vector<std::unique_ptr<glass::FilmGl>> filmsOf(const GladGLContext& gl, const glass::PaneSim& sim) {
  std::vector<std::unique_ptr<glass::FilmGl>> films;
  for (const bool software : {true, false}) {
    const auto programs = std::make_shared<glass::FilmPrograms>(gl, glass::FilmKernel::none, software);
    films.push_back(std::make_unique<glass::FilmGl>(gl, programs, sim.map(), sim.unevenness()));
  }
  return films;
}

glass::FilmReport reportOf(glass::FilmGl& film, const glass::FilmOrder& order) {
  film.run({order});
  std::vector<glass::FilmReport> reports = film.collect(true);
  EXPECT_EQ(reports.size(), 1u);
  return std::move(reports.at(0));
}

// The GPU and the CPU run one text; on a GL that rounds as the CPU does their integers agree to the last one,
// orders of all kinds included.
TEST_F(Film, isTheSameOnGpuAndCpu) {
  const bool exact = rg::gl::isSoftwareRenderer(reinterpret_cast<const char*>(gl.GetString(GL_RENDERER)));
  const Mesh mesh = windscreen(0.5, 0.4, rad(30), 0.03);
  glass::PaneInfo info = paneInfo(mesh);
  info.max_drops = 3000;
  glass::PaneSim sim(info, 1, 7);
  glass::WiperInfo worn = wiper(rad(30), 0.4);
  worn.wear = 0.7;
  sim.setWiper(3, worn);
  const WiperMotor motor(3, rad(20), rad(150), 70.0);
  sim.attachFilm();
  FilmReference reference(sim.map(), sim.unevenness());
  const auto films = filmsOf(gl, sim);
  int64_t took = 0, swept = 0, left = 0, wiped = 0, events = 0;
  for (int64_t index = 1; index <= 480; ++index) {
    glass::PaneTick tick = weather(100.0, 20.0, 0.5);
    tick.index = index;
    tick.wiper_count = index > 120 ? 1 : 0;
    tick.wipers[0] = motor.stroke(static_cast<double>(index - 1) * kTickSeconds,
                                  static_cast<double>(index) * kTickSeconds);
    sim.submit(tick);
    for (const glass::FilmOrder& order : sim.fetchOrders()) {
      glass::FilmReport expected = reference.run(order);
      for (const auto& film : films) {
        const glass::FilmReport got = reportOf(*film, order);
        if (exact) expectSame(got, expected);
      }
      for (const shared::FilmTile& tile : expected.tiles) events += tile.event_texel >= 0 ? 1 : 0;
      for (const int v : expected.taken_pl) took += v;
      for (const shared::SweptRange& range : order.sweep_ranges) swept += range.count;
      left += static_cast<int64_t>(order.leaves.size());
      for (const glass::ThrownOff& thrown : expected.thrown) wiped += thrown.volume_pl;
      sim.deliver(std::move(expected));
    }
  }
  for (const auto& film : films) {
    if (exact) {
      EXPECT_EQ(film->readFilm(), reference.film);
      EXPECT_EQ(film->readBeads(), reference.beads);
    }
    expectAlike(film->readFilm(), reference.film, "film");
  }
  // All kinds of orders were there.
  EXPECT_GT(took, 0);
  EXPECT_GT(swept, 0);
  EXPECT_GT(left, 0);
  EXPECT_GT(wiped, 0);
  EXPECT_GT(events, 0);
}

// Tiles fall asleep and wake, after odd and even numbers of steps, each of which reads one copy of the film
// and writes the other: nothing old may come back.
TEST_F(Film, fallsAsleepAndWakesTheSameOnGpuAndCpu) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  glass::PaneSim sim(filmOnly(mesh), 1, 7);
  FilmReference reference(sim.map(), sim.unevenness());
  const auto films = filmsOf(gl, sim);
  shared::FilmStepInfo info{};
  info.columns = sim.map().grid().size.x;
  info.rows = sim.map().grid().size.y;
  info.up_y = 1.0f;
  info.pin_m = 3e-6f;
  info.front_m = 40e-6f;
  info.evaporation_mps = 1e-7f;
  const int middle = info.rows / 2 * info.columns + info.columns / 2;
  for (int step = 0; step < 120; ++step) {
    glass::FilmOrder order;
    order.step = step;
    order.info = info;
    order.info.step = static_cast<uint32_t>(2 * step);
    order.drive.assign(sim.map().nodes().size(), {0.0f, -4.9f, 0.0f, 0.0f});
    // Now and then a little that lies still, or much that runs; between, all lies still for a while.
    const uint32_t h = shared::pcg(static_cast<uint32_t>(step));
    if (h % 9 == 0) {
      order.takes.push_back({middle, 32768});
      order.adds.push_back({middle, 10'000});
      order.adds.push_back({middle + static_cast<int>(h >> 8) % 40, h % 2 == 0 ? 2'000'000 : 20'000});
      if (order.adds[1].texel == middle) order.adds.pop_back();
    }
    reference.run(order);
    for (const auto& film : films) {
      reportOf(*film, order);
      ASSERT_EQ(film->readFilm(), reference.film) << "step " << step;
      ASSERT_EQ(film->readBeads(), reference.beads) << "step " << step;
    }
  }
}

// Many fast drops on a fine grid ask for many texels in one step: all of them get what lies there.
TEST_F(Film, anyNumberOfTexelsIsTakenInAStep) {
  constexpr int kEach_pl = 1000, kTakes = 6000;
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  glass::PaneInfo pane = filmOnly(mesh);
  pane.texel_m = 2e-3;
  glass::PaneSim sim(pane, 1, 7);
  glass::Ledger ledger;
  glass::FilmLink link(sim.map(), ledger);
  link.attach();
  glass::FilmGl film(gl, glass::makeFilmPrograms(gl), sim.map(), sim.unevenness());
  std::vector<int> texels;
  for (int i = 0; i < sim.map().texelCount() && texels.size() < kTakes; ++i) {
    if (sim.map().inside(i)) texels.push_back(i);
  }
  ASSERT_EQ(texels.size(), kTakes);
  shared::FilmStepInfo info{};
  info.columns = sim.map().grid().size.x;
  info.rows = sim.map().grid().size.y;
  info.pin_m = 3e-6f;  // thicker than what lies there
  for (int64_t step = 0; step < 2; ++step) {
    for (const int texel : texels) {
      if (step == 0) link.add(texel, kEach_pl);
      if (step == 1) link.take(texel, 1.0, 0, 0);
    }
    link.close(step, std::vector<shared::vec4>(sim.map().nodes().size()), info);
    film.run(link.fetch());
  }
  const std::vector<glass::FilmReport> first = film.collect(true), second = film.collect(true);
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].taken_pl, std::vector<int>(kTakes, kEach_pl));
}

// Films that lie still on both sides of a texel take it between them by no more than their own thickness: a
// tile may dry while the next one looks at it.
TEST(FilmLaw, filmsThatLieStillCloseNoFront) {
  for (const glass::Glass glass :
       {glass::Glass::uncoated, glass::Glass::dirty, glass::Glass::coated, glass::Glass::new_coating}) {
    const glass::Surface surface = glass::surfaceOf(glass);
    const auto pin_m = static_cast<float>(surface.pin_m);
    shared::FilmStepInfo info{};
    info.pin_m = pin_m;
    info.front_m = static_cast<float>(surface.front_m);
    const shared::vec4 metric = squareTexel(3e-3f);
    const int still_pl = static_cast<int>(0.999 * surface.pin_m * 9e-6 * 1e15);
    for (int level = 0; level <= shared::kMostUneven; ++level) {
      const shared::FilmAround around = shared::filmAround(0, still_pl, still_pl, still_pl, still_pl);
      EXPECT_GT(shared::filmCell(0, around, level, shared::vec4(0.0f), metric, info).entry_m, 0.0f)
          << "glass " << static_cast<int>(glass) << ", level " << level;
    }
  }
}

// tau > (2/3) rho g h sin a turns the net flow of a film round (physics.md 4).
TEST(FilmLaw, windShearTurnsTheFlowRound) {
  const float h = 100e-6f, g = 9.81f * 0.5f;
  const float turning = 2.0f / 3.0f * 1000.0f * g * h;
  EXPECT_LT(shared::filmVelocity(h, {0.0f, -g, 0.0f, 0.99f * turning}).y, 0.0f);
  EXPECT_GT(shared::filmVelocity(h, {0.0f, -g, 0.0f, 1.01f * turning}).y, 0.0f);
}

TEST(FilmLaw, giveAndTakeAgreeAtEveryFace) {
  shared::FilmStepInfo info{};
  info.pin_m = 3e-6f;
  info.front_m = 40e-6f;
  const shared::vec4 metric = squareTexel(3e-3f);
  for (uint32_t i = 0; i < 10000; ++i) {
    const glm::uvec3 h = shared::pcg3d({i, 1u, 2u});
    const shared::vec4 drive(shared::unitFloat(h.x) * 20.0f - 10.0f, 3.0f, shared::unitFloat(h.y) - 0.5f,
                             0.1f);
    const auto volume = static_cast<int>(shared::unitFloat(h.z) * shared::unitFloat(h.z) * 2e7f);
    const shared::FilmCell cell = shared::filmCell(volume, {0, volume, volume}, 0, drive, metric, info);
    // Half of what is there at most, so that surface tension's four eighths leave nothing negative; one for
    // rounding.
    ASSERT_LE(std::abs(cell.x_pl) + std::abs(cell.y_pl) + 2 * (cell.x_both_pl + cell.y_both_pl),
              volume / 2 + 2);
  }
}

}  // namespace
}  // namespace rg::test
