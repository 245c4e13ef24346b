// A pane as a whole: the same water however time is cut, bounded without a GPU, back to dry by reset.
#include <gtest/gtest.h>

#include "gl_fixture.h"
#include "glass/film_order.h"
#include "glass/film_state.h"
#include "saved/archive.h"
#include "scene.h"

namespace rg::test {
namespace {

class Pane : public GlTest {
 protected:
  struct Hashes {
    uint64_t drops, film;
    bool operator==(const Hashes&) const = default;
  };
  // Two seconds of wiped downpour in updates of these lengths in ticks, over and over, each followed by a
  // step and, if asked, snapshots.
  Hashes run(const std::vector<int>& cuts, bool look_often = false) {
    const Mesh mesh = windscreen(0.6, 0.4, rad(30), 0.03);
    Simulation sim(gl, paneInfo(mesh));
    sim.sim->setWiper(3, wiper(rad(30), 0.4));
    const WiperMotor motor(3, rad(20), rad(150), 70.0);
    glass::PaneTick rain = weather(60.0, 15.0, 0.8);
    int64_t done = 0;
    for (size_t k = 0; done < 240; ++k) {
      const int64_t until = std::min<int64_t>(240, done + cuts[k % cuts.size()]);
      for (; done < until; ++done) {
        rain.acceleration_mps2.x = 3.0 * std::sin(static_cast<double>(done) * 0.05);
        sim.tick(rain, &motor);
      }
      sim.pane.step();
      if (look_often) (void)sim.sim->snapshot();
    }
    const uint64_t film = sim.pane.hash();
    EXPECT_GT(sim.stats().film_pl, 0);
    EXPECT_GT(sim.stats().drops, 100u);
    EXPECT_EQ(sim.stats().caught_pl, sumOf(sim.stats()));
    return {sim.sim->hash(), film};
  }
};

TEST_F(Pane, waterIsTheSameHoweverTimeIsCut) {
  const Hashes each_tick = run({1});
  EXPECT_EQ(run({2}), each_tick);
  EXPECT_EQ(run({10}), each_tick) << "12 pictures a second";
  EXPECT_EQ(run({4, 1, 7, 2, 31, 3}), each_tick) << "irregular";
  EXPECT_EQ(run({120}, true), each_tick) << "one picture a second";
}

// A saved pane whose ticks are not those of its film would wait for reports that never come, or keep them.
TEST(PaneSaved, isRefusedWhereItsClocksDiffer) {
  const Mesh mesh = windscreen(0.3, 0.2);
  glass::PaneSim sim(paneInfo(mesh), 1, 7);
  glass::PaneTick rain = weather(30.0);
  // Resets in the middle of a film's step leave the film's clock behind.
  for (rain.index = 1; rain.index <= 21; ++rain.index) {
    sim.submit(rain);
    if (rain.index % 7 == 0) sim.reset();
  }
  saved::Writer written;
  sim.write(written, nullptr);
  const auto read = [&](int64_t ticks) {
    for (size_t i = 0; i < 8 && ticks >= 0; ++i)
      written.bytes[8 + i] = static_cast<unsigned char>(ticks >> (8 * i));  // after the fingerprint
    saved::Reader a(written.bytes, true);
    sim.read(a);
  };
  EXPECT_NO_THROW(read(-1)) << "as it was";
  EXPECT_THROW(read(1000), saved::Refused);
  EXPECT_THROW(read(0), saved::Refused);
  EXPECT_NO_THROW(read(24));
}

// Each cuts a film's step short: those never come, and nobody may wait for them.
TEST_F(Pane, goesOnAfterManyResetsInTheMiddleOfAFilmsStep) {
  const Mesh mesh = windscreen(0.3, 0.2);
  Simulation sim(gl, paneInfo(mesh));
  for (int i = 0; i < 24; ++i) {
    sim.tick(weather(10.0));
    sim.pane.step();
    sim.sim->reset();
  }
  sim.run(weather(10.0), 0.5);
  sim.pane.finish();
  EXPECT_FALSE(sim.sim->waiting());
  EXPECT_GT(sim.stats().caught_pl, 0);
}

TEST_F(Pane, growsNoFurtherWhenTheGpuIsNotStepped) {
  const Mesh mesh = windscreen(0.3, 0.2);
  Simulation sim(gl, paneInfo(mesh));
  for (int i = 0; i < 2000; ++i) sim.tick(weather(10.0));
  EXPECT_GT(sim.sim->stats().dropped_ticks, 1000u);
  const glass::PaneStats s = sim.stats();
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

TEST_F(Pane, ledgerClosesWhenTheFilmIsLost) {
  const Mesh mesh = windscreen(0.4, 0.3);
  glass::PaneInfo info = paneInfo(mesh);
  const auto sim = std::make_shared<glass::PaneSim>(info, 1, 7);
  const auto programs = glass::makeFilmPrograms(gl);
  int64_t index = 0;
  for (int attached = 0; attached < 3; ++attached) {
    glass::PaneGl pane(gl, programs, sim);
    for (int i = 0; i < 61; ++i) {  // odd: in the middle of a film step
      glass::PaneTick tick = weather(100.0);
      tick.index = ++index;
      sim->submit(tick);
      if (i % 5 == 0) pane.step();
    }
  }
  const glass::PaneStats s = sim->stats();
  EXPECT_EQ(s.film_pl, 0);
  EXPECT_EQ(s.caught_pl, sumOf(s));
}

// Panes of other sizes, weather and numbers of steps, one with a wiper: no kernel touches another's film.
TEST_F(Pane, panesSteppedSideBySideAreAsEachAlone) {
  const Mesh large = windscreen(0.4, 0.3), small = windscreen(0.2, 0.15);
  const auto hashes = [&](bool together) {
    Simulation a(gl, paneInfo(large)), b(gl, paneInfo(small));
    a.sim->setWiper(3, wiper(rad(30), 0.3));
    const WiperMotor motor(3, rad(20), rad(150), 70.0);
    for (int i = 0; i < 90; ++i) {
      a.tick(weather(100.0, 20.0), &motor);
      if (i >= 40) b.tick(weather(60.0));
      if (i % 7 != 0) continue;
      glass::PaneGl* const both[] = {&a.pane, &b.pane};
      if (together) {
        glass::PaneGl::step(both);
      } else {
        for (glass::PaneGl* pane : both) pane->step();
      }
    }
    return std::array{a.pane.hash(), b.pane.hash(), a.sim->hash(), b.sim->hash()};
  };
  EXPECT_EQ(hashes(true), hashes(false));
}

TEST(PaneAlone, runsWithoutGl) {
  const Mesh mesh = windscreen(0.4, 0.3);
  glass::PaneSim sim(paneInfo(mesh), 1, 7);
  glass::PaneTick tick = weather(30.0, 10.0);
  for (tick.index = 1; tick.index <= 600; ++tick.index) sim.submit(tick);
  const glass::PaneStats s = sim.stats();
  EXPECT_GT(s.drops, 100u);
  EXPECT_EQ(s.caught_pl, sumOf(s));
  EXPECT_EQ(s.dropped_ticks, 0u);
  EXPECT_TRUE(sim.fetchOrders().empty());
}

TEST_F(Pane, resetIsAFreshPane) {
  const Mesh mesh = windscreen(0.3, 0.2);
  const auto wet = [](Simulation& sim) {
    sim.index = 0;
    sim.run(weather(80.0, 10.0, 0.7), 1.0);
    const uint64_t film = sim.pane.hash();
    return std::pair(sim.sim->hash(), film);
  };
  Simulation sim(gl, paneInfo(mesh));
  const auto first = wet(sim);
  sim.tick(weather(20.0));
  sim.sim->reset();
  const glass::PaneStats s = sim.stats();
  EXPECT_EQ(s.caught_pl, 0);
  EXPECT_EQ(sumOf(s), 0);
  EXPECT_EQ(wet(sim), first);
}

}  // namespace
}  // namespace rg::test
