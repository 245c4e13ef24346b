// What runs off one pane at a pillar comes onto the pane behind it: where, how much, and whatever the ticks
// of both have come to.
#include "glass/pillar.h"

#include <gtest/gtest.h>

#include "film_reference.h"
#include "glass/film_order.h"
#include "scene.h"

namespace rg::test {
namespace {

using glass::PaneSim;
using glass::Pillar;

constexpr double kGap_m = 0.1;
constexpr uint32_t kDrops = 12;

Mesh moved(Mesh mesh, double turn_rad, const glm::dvec3& to_m) {
  const glm::dvec3 from_m(1.5, 0.0, 1.2);
  for (glm::vec3& p : mesh.positions) {
    const glm::dvec3 way = glm::dvec3(p) - from_m;
    p = to_m + glm::dvec3(std::cos(turn_rad) * way.x - std::sin(turn_rad) * way.y,
                          std::sin(turn_rad) * way.x + std::cos(turn_rad) * way.y, way.z);
  }
  return mesh;
}

// An upright pane ahead and one along the car's left flank, which begins `gap_m` behind the corner.
struct Corner {
  Mesh front = windscreen(0.3, 0.2, rad(90));
  Mesh side;
  std::shared_ptr<PaneSim> ahead, beside;
  explicit Corner(double gap_m = kGap_m)
      : side(moved(windscreen(0.3, 0.2, rad(90)), rad(90), {1.5 - gap_m - 0.15, 0.15, 1.2})),
        ahead(std::make_shared<PaneSim>(paneInfo(front), 1, 7)),
        beside(std::make_shared<PaneSim>(paneInfo(side), 2, 7)) {}
  std::shared_ptr<Pillar> pillar() const { return std::make_shared<Pillar>(ahead->map(), beside->map()); }
  void join() const {
    const auto between = pillar();
    ahead->setPillars({between}, {});
    beside->setPillars({}, {between});
  }
  void place() const {
    std::vector<glass::PlacedDrop> drops;
    for (uint32_t i = 0; i < kDrops; ++i)
      drops.push_back({-0.1 + 0.01 * (i % 3), -0.05 + 0.008 * i, 3e-3, 0.5});
    ahead->placeDrops(drops);
  }
};

// All is pulled to a side; on the flank that is into the glass.
glass::PaneTick pulled(int64_t moment, double to_left_mps2, double share = 1.0) {
  glass::PaneTick tick;
  tick.index = moment + 1;
  tick.moment = moment;
  tick.acceleration_mps2 = {0.0, to_left_mps2, 0.0};
  tick.humidity = 1.0;
  tick.run_off = share;
  return tick;
}

TEST(Pillar, whatRunsOffComesOntoThePaneBehindItLater) {
  for (const double share : {1.0, 0.5}) {
    const Corner corner;
    corner.join();
    corner.place();
    const int64_t placed_pl = corner.ahead->stats().caught_pl;
    int64_t first_off = -1, first_on = -1;
    for (int64_t i = 0; i < 400; ++i) {
      corner.ahead->submit(pulled(i, 60.0, share));
      corner.beside->submit(pulled(i, 60.0, share));
      if (first_off < 0 && corner.ahead->stats().drained_pl > 0) first_off = i;
      if (first_on < 0 && corner.beside->stats().caught_pl > 0) first_on = i;
    }
    const glass::PaneStats off = corner.ahead->stats(), on = corner.beside->stats();
    EXPECT_GT(off.drained_pl, placed_pl / 2);
    // Less than a trickle may still hang on the pillar beside each tile that a drop came from.
    EXPECT_LE(on.caught_pl, static_cast<int64_t>(share * static_cast<double>(off.drained_pl)));
    EXPECT_GT(on.caught_pl, static_cast<int64_t>(share * static_cast<double>(off.drained_pl)) -
                                kDrops * glass::kTrickle_pl);
    EXPECT_EQ(first_on - first_off, glass::kPillarTicks);
    EXPECT_EQ(on.caught_pl, sumOf(on));
    EXPECT_EQ(on.run_on_pl, on.caught_pl);
    EXPECT_EQ(off.caught_pl, sumOf(off)) << "that it goes on elsewhere takes nothing from this pane's ledger";
    EXPECT_GT(on.drops, 0u);
  }
}

TEST(Pillar, itLiesAtTheNearEdgeAtTheHeightItCameFrom) {
  const Corner corner;
  corner.join();
  corner.ahead->placeDrops(std::vector<glass::PlacedDrop>{{-0.13, 0.06, 3.5e-3, 0.6}});
  for (int64_t i = 0; i < 200; ++i) {
    corner.ahead->submit(pulled(i, 60.0));
    corner.beside->submit(pulled(i, 60.0));
  }
  const auto seen = corner.beside->snapshot();
  ASSERT_EQ(seen->drops.size(), 1u);
  const auto place_m = corner.beside->map().vehicleFromGrid(glm::dvec2(seen->drops[0].position_m));
  ASSERT_TRUE(place_m);
  EXPECT_NEAR(place_m->x, 1.5 - kGap_m, 5e-3);
  EXPECT_NEAR(place_m->z, 1.26, 0.03) << "within a tile and a half of 16 texels of 3 mm";
}

TEST(Pillar, nothingCrossesToWhereTheEdgeDoesNotLook) {
  EXPECT_TRUE(Corner().pillar()->joins());
  EXPECT_FALSE(Corner(0.25).pillar()->joins()) << "too far apart";
  // Down over the lower edge, a tile away from the corner beside the pillar.
  const Corner corner;
  corner.join();
  corner.ahead->placeDrops(
      std::vector<glass::PlacedDrop>{{-0.08, -0.08, 3.5e-3, 0.6}, {-0.06, -0.08, 3.5e-3, 0.6}});
  for (int64_t i = 0; i < 200; ++i) {
    glass::PaneTick down = pulled(i, 0.0);
    down.acceleration_mps2.z = -60.0;
    corner.ahead->submit(down);
    corner.beside->submit(down);
  }
  EXPECT_GT(corner.ahead->stats().drained_pl, 2 * glass::kTrickle_pl);
  EXPECT_EQ(corner.beside->stats().caught_pl, 0);
}

TEST(Pillar, nothingOfBeforeAResetArrivesAfterIt) {
  const Corner corner;
  corner.join();
  corner.place();
  int64_t i = 0;
  for (; corner.ahead->stats().drained_pl == 0 && i < 400; ++i) corner.ahead->submit(pulled(i, 60.0));
  ASSERT_GT(corner.ahead->stats().drained_pl, 0);
  corner.ahead->reset();
  corner.beside->reset();
  for (i = 0; i < 100; ++i) {
    corner.ahead->submit(pulled(i, 60.0));
    corner.beside->submit(pulled(i, 60.0));
  }
  EXPECT_EQ(corner.beside->stats().caught_pl, 0);
}

// A blade sweeps towards the pillar, over drops that lie along circles about its pivot which leave the pane
// there, and on beyond the edge.
struct Thrown {
  Corner corner;
  static constexpr double kArm_m = 0.15, kBlade_m = 0.2, kFrom_rad = 1.6, kTo_rad = 0.1, kStroke_s = 0.5;
  static constexpr int64_t kTicks = 200;
  explicit Thrown(double share) {
    corner.join();
    glass::WiperInfo info = wiper(rad(90), 0.2);
    info.arm_m = kArm_m;
    info.blade_m = kBlade_m;
    corner.ahead->setWiper(3, info);
    corner.ahead->attachFilm();
    FilmReference film(corner.ahead->map(), corner.ahead->unevenness());
    std::vector<glass::PlacedDrop> drops;
    for (int i = 0; i < 12; ++i) {
      const double r_m = 0.165 + 0.002 * i, angle_rad = 0.75 + 0.1 * (i % 3);
      drops.push_back({-r_m * std::cos(angle_rad), r_m * std::sin(angle_rad) - 0.1, 3e-3, 0.5});
    }
    corner.ahead->placeDrops(drops);
    for (int64_t i = 0; i < kTicks; ++i) {
      glass::PaneTick tick = pulled(i, 0.0, share);
      corner.beside->submit(tick);
      tick.wiper_count = 1;
      tick.wipers[0] = {3, angleAt(i), angleAt(i + 1), angleAt(i + 1)};
      corner.ahead->submit(tick);
      for (const glass::FilmOrder& order : corner.ahead->fetchOrders())
        corner.ahead->deliver(film.run(order));
    }
  }
  static double angleAt(int64_t tick) {
    const double t = std::min(1.0, static_cast<double>(tick) * kTickSeconds / kStroke_s);
    return kFrom_rad + (kTo_rad - kFrom_rad) * t;
  }
};

TEST(Pillar, whatABladeThrowsOverTheEdgeThereGoesThatWayToo) {
  for (const double share : {1.0, 0.5}) {
    const Thrown thrown(share);
    const glass::PaneStats off = thrown.corner.ahead->stats(), on = thrown.corner.beside->stats();
    EXPECT_GT(off.wiped_pl, off.caught_pl / 2);
    EXPECT_LT(off.drained_pl, off.wiped_pl / 10) << "of which this tells nothing";
    const double most_pl = share * static_cast<double>(off.wiped_pl + off.drained_pl + off.blown_pl);
    EXPECT_LE(on.run_on_pl, static_cast<int64_t>(most_pl));
    // Its ends meet tiles at corners, whose edges look elsewhere in part.
    EXPECT_GT(on.run_on_pl, static_cast<int64_t>(0.8 * share * static_cast<double>(off.wiped_pl)));
    EXPECT_EQ(off.caught_pl, sumOf(off));
    EXPECT_EQ(on.caught_pl, sumOf(on));
  }
}

// The pane ahead waits for answers of its film, played here, of which each comes so many ticks late.
uint64_t besideAfter(int64_t late_ticks) {
  const Corner corner;
  corner.join();
  corner.ahead->attachFilm();
  corner.place();
  std::vector<int64_t> ordered;
  const size_t tiles = corner.ahead->map().tileArea_m2().size();
  bool waited = false;
  for (int64_t i = 0; i < 500; ++i) {
    if (i < 400) {
      corner.beside->submit(pulled(i, 60.0));
      corner.ahead->submit(pulled(i, 60.0));
    }
    waited |= corner.beside->waiting();
    for (glass::FilmOrder& order : corner.ahead->fetchOrders()) {
      if (order.clear) continue;
      ordered.push_back(order.step);
    }
    while (!ordered.empty() && (ordered.front() + 1) * glass::kTicksPerFilmStep + late_ticks < i) {
      glass::FilmReport report;
      report.step = ordered.front();
      report.tiles.resize(tiles);
      for (shared::FilmTile& tile : report.tiles) tile.event_texel = -1;
      ordered.erase(ordered.begin());
      corner.ahead->deliver(std::move(report));
      corner.beside->resume();
    }
  }
  EXPECT_EQ(waited, late_ticks > glass::kReportLatency_ticks + glass::kPillarTicks) << late_ticks;
  EXPECT_FALSE(corner.beside->waiting());
  EXPECT_GT(corner.beside->stats().caught_pl, 0);
  return corner.beside->hash();
}

TEST(Pillar, whatArrivesWhenDoesNotDependOnHowLateThePaneBeforeItIs) {
  const uint64_t at_once = besideAfter(0);
  EXPECT_EQ(besideAfter(20), at_once);
  EXPECT_EQ(besideAfter(60), at_once);
}

}  // namespace
}  // namespace rg::test
