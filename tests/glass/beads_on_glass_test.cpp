// Beads on a pane: they dry as drops do, join films and are left by them, are taken by drops and blades.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <vector>

#include "beads.h"
#include "drop_scene.h"
#include "film_reference.h"
#include "gl_fixture.h"
#include "glass/film_gl.h"
#include "glass/water.h"
#include "glass/wiper.h"
#include "scene.h"

namespace rg::test {
namespace {

using shared::Beads;

class BeadsOnGlass : public GlTest {
 protected:
  // A film of which a test says what comes to it, on a pane that lies level.
  struct Bench {
    Bench(const GladGLContext& gl, double width_m, double height_m)
        : mesh(windscreen(width_m, height_m, 1e-4)),
          sim(paneInfo(mesh), 1, 7),
          gpu(gl, glass::makeFilmPrograms(gl), sim.map(), sim.unevenness()),
          info(uncoated()) {
      info.columns = sim.map().grid().size.x;
      info.rows = sim.map().grid().size.y;
      info.up_y = 1.0f;
    }
    glass::FilmReport step(const std::function<void(glass::FilmOrder&)>& fill = {}) {
      glass::FilmOrder order;
      order.step = steps;
      order.info = info;
      order.info.step = static_cast<uint32_t>(2 * steps++);
      order.drive.assign(sim.map().nodes().size(), {0.0f, 0.0f, 0.0f, 0.0f});
      if (fill) fill(order);
      std::vector<glass::FilmOrder> orders;
      orders.push_back(std::move(order));
      gpu.run(std::move(orders));
      return gpu.collect(true).at(0);
    }
    int at(int dx, int dy) const { return (info.rows / 2 + dy) * info.columns + info.columns / 2 + dx; }
    Mesh mesh;
    glass::PaneSim sim;
    glass::FilmGl gpu;
    shared::FilmStepInfo info;
    int64_t steps = 0;
  };
};

// Hu & Larson with a constant contact angle: -dV/dt = k R and V = R^3 shape, so V^(2/3) falls linearly and
// the time to the end is 3 V0^(2/3) shape^(1/3) / (2 k), for many of one size as for one. The tile sleeps
// meanwhile.
TEST_F(BeadsOnGlass, dryInTheTimeOfTheClosedForm) {
  Bench bench(gl, 0.1, 0.1);
  const glass::Surface s = glass::surfaceOf(glass::Glass::uncoated);
  const double k_m2_s = glass::evaporation_kg_s(1.0, glass::meanAngle(s), 0.3, 0.0173) / 1000.0;
  bench.info.bead_drying_pl_mm =
      static_cast<float>(k_m2_s * 1e12 * shared::kDryingSteps * static_cast<double>(shared::kFilmStep_s));
  const double bead_m3 = 4e-12, shape = glass::capShape(glass::meanAngle(s));
  const double time_s = 1.5 * std::pow(bead_m3, 2.0 / 3.0) * std::cbrt(shape) / k_m2_s;
  const int one = bench.at(0, 0), many = bench.at(3, 1);
  const int pl = static_cast<int>(std::llround(bead_m3 * 1e15));
  glass::FilmReport report = bench.step([&](glass::FilmOrder& order) {
    order.bead_adds.push_back({one, pl, 1});
    order.bead_adds.push_back({many, 12 * pl, 12});
  });
  int64_t dried = 0;
  std::array<double, 2> gone_s{};
  const auto half = [&](int texel) {
    return shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]);
  };
  bool halfway = false;
  for (int step = 1; step < 60 * 120 && (gone_s[0] == 0.0 || gone_s[1] == 0.0); ++step) {
    report = bench.step();
    for (const shared::FilmTile& tile : report.tiles) dried += tile.evaporated_pl;
    const double now_s = step * static_cast<double>(shared::kFilmStep_s);
    if (step % static_cast<int>(shared::kDryingSteps) == 0) {
      const Beads a = half(one), b = half(many);
      if (a.number == 0 && gone_s[0] == 0.0) gone_s[0] = now_s;
      if (b.number == 0 && gone_s[1] == 0.0) gone_s[1] = now_s;
      if (!halfway && now_s > 0.5 * time_s) {
        halfway = true;
        const double law = std::pow(1.0 - now_s / time_s, 1.5);
        EXPECT_NEAR(static_cast<double>(a.volume_pl) / pl, law, 0.03);
        EXPECT_NEAR(static_cast<double>(b.volume_pl) / (12 * pl), law, 0.03);
      }
    }
  }
  std::printf("dry after %.2f s and %.2f s, law %.2f s\n", gone_s[0], gone_s[1], time_s);
  // Quarters of a second, whole picolitres by chance, and an end by 50 pl instead of 0, which is 5 % of the
  // radius' square.
  for (const double gone : gone_s) EXPECT_NEAR(gone / time_s, 1.0, 0.06);
  EXPECT_EQ(dried, 13 * pl);
}

// A film that flows over them takes them in; one that breaks up leaves them.
TEST_F(BeadsOnGlass, joinAFilmThatFlowsAndAreWhatABrokenOneLeaves) {
  Bench bench(gl, 0.1, 0.1);
  const int texel = bench.at(0, 0);
  bench.step([&](glass::FilmOrder& order) { order.bead_adds.push_back({texel, 50'000, 2}); });
  EXPECT_EQ(shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]).volume_pl, 50'000);
  EXPECT_EQ(bench.gpu.readFilm()[static_cast<size_t>(texel)], 0);
  bench.step([&](glass::FilmOrder& order) { order.adds.push_back({texel, 90'000}); });  // 10 um
  EXPECT_EQ(bench.gpu.readBeads()[static_cast<size_t>(texel)], 0u);
  EXPECT_EQ(bench.gpu.readFilm()[static_cast<size_t>(texel)], 140'000);
  bench.info.rupture_chance = 1.0f;
  for (uint32_t k = 0; k <= shared::kDryingSteps; ++k) bench.step();
  const Beads left = shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]);
  EXPECT_EQ(left.volume_pl, 140'000);
  EXPECT_GT(left.number, 1);
  EXPECT_EQ(bench.gpu.readFilm()[static_cast<size_t>(texel)], 0);
}

// A drop that runs over half a texel takes half of what lies there.
TEST_F(BeadsOnGlass, aDropTakesItsShare) {
  Bench bench(gl, 0.1, 0.1);
  const int texel = bench.at(0, 0);
  bench.step([&](glass::FilmOrder& order) { order.bead_adds.push_back({texel, 80'000, 8}); });
  const glass::FilmReport report = bench.step([&](glass::FilmOrder& order) {
    order.takes.push_back({texel, 32768});
  });
  EXPECT_EQ(report.taken_pl.at(0), 40'000);
  const Beads left = shared::beadsOf(bench.gpu.readBeads()[static_cast<size_t>(texel)]);
  EXPECT_EQ(left.volume_pl, 40'000);
  EXPECT_EQ(left.number, 4);
}

// A blade leaves no bead on its way, and touches none beside it.
TEST_F(BeadsOnGlass, aBladeTakesAll) {
  const Mesh mesh = windscreen(0.9, 0.6, 1e-4);
  Simulation sim(gl, paneInfo(mesh));
  sim.sim->setWiper(3, wiper(1e-4, 0.6));
  glass::PaneTick drizzle = weather(0.0);
  drizzle.class_count = 1;
  drizzle.classes[0] = {0.5e-3, 4000.0, 2.0};
  sim.run(drizzle, 2.0);
  sim.run(weather(0.0), 0.5);
  const std::vector<uint32_t> before = sim.pane.readBeads();
  const glass::Sweep sweep{rad(40), rad(100)};
  glass::PaneTick tick = weather(0.0);
  tick.wiper_count = 1;
  constexpr int kTicks = 40;
  for (int k = 0; k < kTicks; ++k) {
    const double a = rad(40 + 60.0 * k / kTicks), b = rad(40 + 60.0 * (k + 1) / kTicks);
    tick.wipers[0] = {3, a, b, b};
    sim.tick(tick);
  }
  const std::vector<uint32_t> after = sim.pane.readBeads();
  const glass::Wiper blade(wiper(1e-4, 0.6), sim.sim->map(), 0);
  int wiped = 0, kept = 0;
  for (int i = 0; i < sim.sim->map().texelCount(); ++i) {
    if (!sim.sim->map().inside(i)) continue;
    const auto t = static_cast<size_t>(i);
    const glass::Crossings c = blade.crossingsAt(glm::dvec3(sim.sim->map().texel(i).position_m));
    if (c.count > 0 && sweep.covers(c.angle_rad[0])) {
      EXPECT_EQ(after[t], 0u) << "texel " << i;
      wiped += before[t] != 0 ? 1 : 0;
    } else if (before[t] != 0) {
      ASSERT_EQ(after[t], before[t]) << "texel " << i;
      ++kept;
    }
  }
  EXPECT_GT(wiped, 1000);
  EXPECT_GT(kept, 1000);
  const glass::PaneStats s = sim.stats();
  EXPECT_GT(s.ridge_pl, 0);
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

// Small impacts lie as beads and take no slot; placed drops are drops however small.
TEST_F(BeadsOnGlass, drizzleIsBeadsAndPlacedDropsAreNot) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  Simulation sim(gl, paneInfo(mesh));
  glass::PaneTick drizzle = weather(0.0);
  drizzle.class_count = 1;
  drizzle.classes[0] = {0.6e-3, 500.0, 2.0};
  sim.run(drizzle, 0.5);
  const glass::PaneStats s = sim.stats();
  EXPECT_EQ(s.drops, 0u);
  EXPECT_GT(s.beads_pl, 0);
  EXPECT_EQ(s.caught_pl, sumOf(s));
  int64_t lying = 0;
  for (const uint32_t packed : sim.pane.readBeads()) lying += shared::beadsOf(packed).volume_pl;
  EXPECT_EQ(lying, s.beads_pl);
  const glass::PlacedDrop drop{0.0, 0.0, 0.2e-3, 0.5};
  sim.sim->placeDrops({&drop, 1});
  EXPECT_EQ(sim.stats().drops, 1u);
}

// However coarse the texels are, an impact of more water than a bead may hold is a drop.
TEST_F(BeadsOnGlass, noImpactThatWindMayMoveLiesAsABead) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  glass::PaneInfo info = paneInfo(mesh);
  info.texel_m = 5e-3;
  struct Case {
    glass::Glass glass;
    double diameter_m;
    bool lies;
  };
  for (const Case c : {Case{glass::Glass::uncoated, 0.9e-3, true},         // a bead of 1.03 mm
                       Case{glass::Glass::uncoated, 1.05e-3, false},       // of 1.20 mm
                       Case{glass::Glass::new_coating, 1.1e-3, true},      // of 0.62 mm; 0.67 rest
                       Case{glass::Glass::new_coating, 1.3e-3, false}}) {  // of 0.74 mm
    info.glass = c.glass;
    Simulation sim(gl, info);
    glass::PaneTick rain = weather(0.0);
    rain.class_count = 1;
    rain.classes[0] = {c.diameter_m, 100.0, 2.0};
    sim.run(rain, 0.5);
    EXPECT_EQ(sim.stats().beads_pl > 0, c.lies) << c.diameter_m;
    EXPECT_EQ(sim.stats().drops > 0, !c.lies) << c.diameter_m;
  }
}

// Nor is it one until the film's step finds that it is too large.
TEST(Beads, anImpactThatAnUprightPaneWouldNotHoldIsADropAtOnce) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(30));
  glass::PaneInfo info = paneInfo(mesh);
  info.texel_m = 5e-3;
  info.glass = glass::Glass::new_coating;
  for (const double diameter_m : {1.1e-3, 1.3e-3}) {  // as above
    glass::PaneSim sim(info, 1, 7);
    sim.attachFilm();
    glass::PaneTick rain = weather(0.0);
    rain.class_count = 1;
    rain.classes[0] = {diameter_m, 1000.0, 2.0};
    for (; rain.index < glass::kReportLatency_ticks; ++rain.index) sim.submit(rain);
    size_t lying = 0;
    for (const glass::FilmOrder& order : sim.fetchOrders()) lying += order.bead_adds.size();
    EXPECT_EQ(lying > 0, diameter_m < 1.2e-3) << lying;
    EXPECT_EQ(sim.stats().drops > 0, diameter_m > 1.2e-3) << diameter_m;
  }
}

// What lies in its way a drop takes up, as wide as it is and no wider.
TEST_F(BeadsOnGlass, aDropThatSlidesClearsItsWholeWidth) {
  const Mesh mesh = windscreen(0.3, 0.2, rad(50));
  glass::PaneInfo info = paneInfo(mesh);
  info.unevenness = 0.0;              // it runs straight ...
  info.glass = glass::Glass::coated;  // ... and leaves no film, which would break into beads behind it
  Simulation sim(gl, info);
  glass::PaneTick drizzle = weather(0.0);
  drizzle.class_count = 1;
  drizzle.classes[0] = {0.3e-3, 1e5, 2.0};
  sim.run(drizzle, 2.0);
  const glass::PaneMap& map = sim.sim->map();
  const double column_m = map.glassFromGrid(map.middleOf(map.texelAt(map.gridFromGlass({0.0, 0.08})))).x;
  // How many in the columns of texels that lie so far to both sides of the drop's. (It leaves pearls, few and
  // large.)
  const auto lyingBy = [&](double from_m, double to_m) {
    const std::vector<uint32_t> beads = sim.pane.readBeads();
    double sum = 0.0;
    for (int i = 0; i < map.texelCount(); ++i) {
      const glm::dvec2 place = map.glassFromGrid(map.middleOf(i));
      const bool asked = std::abs(place.x - column_m) >= from_m && std::abs(place.x - column_m) < to_m &&
                         std::abs(place.y) < 0.05;
      if (asked) sum += shared::beadsOf(beads[static_cast<size_t>(i)]).number;
    }
    return sum;
  };
  const double beside_before = lyingBy(1.6e-3, 4.6e-3), far_before = lyingBy(12e-3, 30e-3);
  const glass::PlacedDrop drop{column_m, 0.08, 6e-3, 1.5};
  sim.sim->placeDrops({&drop, 1});
  sim.run(weather(0.0), 0.55);  // it has come by, and its pearls have not run together yet
  EXPECT_LT(lyingBy(1.6e-3, 4.6e-3), 0.1 * beside_before) << "under it, beside its middle";
  EXPECT_NEAR(lyingBy(12e-3, 30e-3) / far_before, 1.0, 0.02);
}

// At 100 mm/h and 100 km/h slots suffice: most are wanted in the second before the water is a film.
TEST_F(BeadsOnGlass, slotsSufficeInADownpourAtSpeed) {
  const Mesh mesh = windscreen(0.75, 0.8, rad(30), 0.03);
  glass::PaneInfo info = paneInfo(mesh);
  info.max_drops = 10000;  // half a windscreen, half the slots
  Simulation sim(gl, info);
  uint32_t most = 0;
  for (int look = 0; look < 32; ++look) {
    sim.run(weather(100.0, 27.8, 0.9), 0.25);
    most = std::max(most, sim.stats().drops);
  }
  const glass::PaneStats s = sim.stats();
  std::printf("drops %u, once %u\n", s.drops, most);
  // Where they run short all but a hundredth are taken.
  EXPECT_LT(most, 97 * info.max_drops / 100);
  EXPECT_GT(most, 70 * info.max_drops / 100) << "there are more than it takes";
  EXPECT_LT(s.drops, 20 * info.max_drops / 100) << "no film";
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

// Lamellae that come before the last have drawn back into drops keep glass wet from which water recedes
// slowly: a downpour is a sheet there. Not where it recedes 40 times as fast, nor on coated glass, nor in
// rain that brings few.
TEST_F(BeadsOnGlass, areNotWhatADownpourLeavesOnGlassThatStaysWet) {
  const auto filmsShare = [&](const std::function<void(glass::PaneInfo&)>& change, double rate_mm_h,
                              double speed_mps, double seconds) {
    const Mesh mesh = windscreen(0.4, 0.4, rad(30));
    glass::PaneInfo info = paneInfo(mesh);
    change(info);
    Simulation sim(gl, info);
    sim.run(weather(rate_mm_h, speed_mps), seconds);
    const glass::PaneStats s = sim.stats();
    EXPECT_EQ(s.caught_pl, sumOf(s));
    return static_cast<double>(s.film_pl) / static_cast<double>(s.on_glass_pl);
  };
  const auto plain = [](glass::PaneInfo&) {};
  const double downpour = filmsShare(plain, 100.0, 11.0, 4.0), parked = filmsShare(plain, 10.0, 0.0, 25.0);
  const double fast =
      filmsShare([](glass::PaneInfo& info) { info.receding_rad = rad(35); }, 100.0, 11.0, 4.0);
  const double coated =
      filmsShare([](glass::PaneInfo& info) { info.glass = glass::Glass::coated; }, 100.0, 11.0, 4.0);
  std::printf(
      "film: %.2f of the water in a downpour, %.2f where it recedes fast, %.2f on coated glass, %.2f "
      "parked\n",
      downpour, fast, coated, parked);
  // Nearly all of it, and little.
  EXPECT_GT(downpour, 0.8);
  EXPECT_LT(fast, 0.4);
  EXPECT_LT(coated, 0.1);
  EXPECT_LT(parked, 0.3);
}

}  // namespace
}  // namespace rg::test
