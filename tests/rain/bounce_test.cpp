// A hailstone comes down once more: off the ground, off roofs at rest and in motion, with less energy, and
// into nothing.
#include "rain/bounce.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "gravity.h"
#include "measure.h"
#include "rain/hail_law.h"

namespace rg::rain::test {
namespace {

constexpr double kVelocityStep_mps = 0.15;  // of a record: half of it an axis is rounding

void setShelterBox(Shelter& shelter, uint32_t id, const dvec3& low, const dvec3& high, uint32_t vehicle = 0) {
  const auto corners = boxCorners(low, high);
  VolumeInfo info;
  info.vertices = corners;
  info.vehicle = vehicle;
  ASSERT_EQ(shelter.set(id, info), "");
}

dvec3 placeOf(const Flight& f, double t) {
  return f.place_m + f.velocity_mps * t - dvec3(0, 0, 0.5 * kGravity_mps2 * t * t);
}

Impact impactAt(const dvec3& place, uint32_t id, double mm = 10.0) {
  return {place, {1.0, -2.0, -stoneSpeed_mps(mm)}, 1e-3 * mm, 0.0, id};
}

TEST(Bounce, offTheGroundRisesAndComesDownToItAgain) {
  Shelter shelter;
  shelter.advance(0.0, {});
  for (uint32_t id = 1; id < 200; ++id) {
    const Impact impact = impactAt({3, 4, 7.005}, id * 2654435761u);
    const Flight f = flightAfter(impact, 7.0, shelter, 0.0);
    ASSERT_GT(f.lasts_s, 0.0);
    ASSERT_LE(f.lasts_s, kLongestFlight_s);
    EXPECT_NEAR(placeOf(f, f.lasts_s).z, 7.005, 1e-9);
    EXPECT_GT(placeOf(f, 0.5 * f.lasts_s).z, 7.1);
    EXPECT_LT(glm::length(f.velocity_mps), glm::length(impact.velocity_mps));
  }
}

TEST(Bounce, offNothingIsNone) {
  Shelter shelter;
  shelter.advance(0.0, {});
  EXPECT_EQ(flightAfter(impactAt({3, 4, 7.0}, 1), 0.0, shelter, 0.0).lasts_s, 0.0);
  EXPECT_EQ(flightAfter(impactAt({3, 4, 7.0}, 1), kNoGround_m, shelter, 0.0).lasts_s, 0.0);
}

TEST(Bounce, offARoofEndsOnTheGroundBesideIt) {
  Shelter shelter;
  setShelterBox(shelter, 1, {-1, -1, 2}, {1, 1, 2.2});
  shelter.advance(0.0, {});
  Impact impact = impactAt({0.98, -0.98, 2.2}, 7);
  impact.velocity_mps.x = 10.0;
  const Flight f = flightAfter(impact, 0.0, shelter, 0.0);
  EXPECT_NEAR(placeOf(f, f.lasts_s).z, 0.005, 1e-9);
  EXPECT_GT(f.lasts_s, 0.5);
}

// Seen from a car at 20 m/s the rain of stones comes from ahead: they leave its roof with less energy as its
// driver sees it.
TEST(Bounce, offAMovingBodyLosesEnergyInItsFrame) {
  Shelter shelter;
  setShelterBox(shelter, 1, {-2, -0.8, 0.2}, {2, 0.8, 1.5}, 7);
  VehicleState car;
  car.id = 7;
  car.pose.velocity_mps = {20, 0, 0};
  shelter.advance(0.0, std::span(&car, 1));
  for (uint32_t id = 1; id < 100; ++id) {
    const Impact impact = impactAt({0, 0, 1.5}, id * 2654435761u);
    const Flight f = flightAfter(impact, 0.0, shelter, 0.0);
    ASSERT_GT(f.lasts_s, 0.0);
    EXPECT_GT(f.velocity_mps.z, 0.3 * stoneSpeed_mps(10.0) - kVelocityStep_mps);
    EXPECT_LT(glm::length(f.velocity_mps - car.pose.velocity_mps),
              glm::length(impact.velocity_mps - car.pose.velocity_mps));
  }
}

// Many stones between walls and under a ceiling: the arc, walked in small steps, is never inside of a box. 5
// mm: chords leave an arc of 3 s by g / 8 (3/12)^2 = 8 cm, and what they cut off is below, so that boxes are
// met early, and from below late by no more than that.
TEST(Bounce, entersNoVolume) {
  Shelter shelter;
  const std::vector<std::pair<dvec3, dvec3>> boxes = {
      {{-3, -3, 0}, {-1, 3, 3}}, {{1, -3, 0}, {3, 3, 1}}, {{-1, -3, 2.5}, {1, 3, 3}}};
  for (uint32_t i = 0; i < boxes.size(); ++i) setShelterBox(shelter, i + 1, boxes[i].first, boxes[i].second);
  shelter.advance(0.0, {});
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  int stopped = 0;
  for (uint32_t id = 0; id < 3000; ++id) {
    Impact impact = impactAt({0.9 * one(random), 2.5 * one(random), 0.005}, id * 2654435761u);
    impact.velocity_mps = {20 * one(random), 20 * one(random), -stoneSpeed_mps(30.0)};
    const Flight f = flightAfter(impact, 0.0, shelter, 0.0);
    if (f.lasts_s == 0.0) continue;
    const bool short_of_ground = placeOf(f, f.lasts_s).z > 0.02;
    stopped += short_of_ground ? 1 : 0;
    for (int k = 0; k <= 100; ++k) {
      const dvec3 p = placeOf(f, f.lasts_s * k / 100.0);
      for (const auto& [low, high] : boxes) {
        constexpr double kCut_m = 0.085;
        ASSERT_FALSE(glm::all(glm::greaterThan(p, low + kCut_m)) && glm::all(glm::lessThan(p, high - kCut_m)))
            << p.x << " " << p.y << " " << p.z;
      }
    }
  }
  EXPECT_GT(stopped, 300);
}

Scene hailScene() {
  Scene scene = sceneWithView(0.0);
  scene.weather.hail_mm_h = 20.0;
  scene.weather.ground_height_m = 0.0;
  return scene;
}

// Each stone that came down gives one record, where and when it came down; none gives a second.
TEST(Bounce, happensOnceForEachStoneThatComesDown) {
  Field field({.capacity = 20000, .seed = 3});
  Scene scene = hailScene();
  Upload upload;
  std::map<DropKey, LiveDrop> falling;
  std::set<std::tuple<int32_t, int32_t, int32_t>> bounced;
  uint64_t came_down = 0, gone = 0;
  std::set<std::tuple<int32_t, int32_t, int32_t>> before;
  for (; scene.index < 180; ++scene.index) {
    field.tick(scene.tick());
    field.publishAll(upload);
    std::map<DropKey, LiveDrop> now;
    std::set<std::tuple<int32_t, int32_t, int32_t>> flying;
    for (const RainDrop& d : upload.records) {
      if (shared::rainClassOf(d) == kBouncedClass) {
        flying.insert({d.cell_x, d.cell_y, d.cell_z});
        const LiveDrop where = liveDropOf(d, upload.picture);
        EXPECT_NEAR(where.place_m.z, 0.5 * where.diameter_m + 1e-3, 1e-3);
        EXPECT_GT(shared::rainBounceVelocity(d.id).z, 0.0f);
        continue;
      }
      const LiveDrop drop = liveDropOf(d, upload.picture);
      EXPECT_GT(drop.place_m.z, 0.0);
      now[drop.key] = drop;
    }
    for (const auto& [key, drop] : falling) {
      if (now.contains(key)) continue;
      const double bottom_m = drop.place_m.z + drop.velocity_mps.z * kTickSeconds - 0.5 * drop.diameter_m;
      came_down += bottom_m <= 0.0 ? 1u : 0u;
    }
    for (const auto& one : flying) bounced.insert(one);
    for (const auto& one : before) gone += flying.contains(one) ? 0u : 1u;
    before = flying;
    falling = std::move(now);
  }
  EXPECT_GT(came_down, 100u);
  EXPECT_EQ(bounced.size(), field.stats().bounced);
  // All but those that went out of sight in the same tick.
  EXPECT_LE(field.stats().bounced, came_down);
  EXPECT_GT(static_cast<double>(field.stats().bounced), 0.99 * static_cast<double>(came_down));
  EXPECT_GT(gone, 50u);
}

// The chord of each picture lies on the arc: it starts on the ground, rises, and what is drawn of one stone
// never jumps.
TEST(Bounce, isDrawnAlongItsArcFromWhereItHit) {
  Field field({.capacity = 100000, .seed = 3});
  Scene scene = hailScene();
  std::vector<Streak> streaks;
  std::map<uint32_t, Streak> last;
  uint64_t seen = 0;
  for (; scene.index < 180; ++scene.index) {
    field.tick(scene.tick());
    field.streaks(scene.views[0], tickTimeNs(scene.index), streaks);
    std::map<uint32_t, Streak> now;
    for (const Streak& s : streaks) {
      if (s.kind != kBouncedClass) continue;
      ++seen;
      EXPECT_GT(std::min(s.from_m.z, s.to_m.z), 0.0);
      const auto found = last.find(s.slot);
      if (found != last.end() && found->second.diameter_m == s.diameter_m) {
        // At most 10 m/s between two ticks, beside the chord's own length.
        EXPECT_LT(glm::distance(found->second.drop_m, s.drop_m), 0.2);
      }
      now[s.slot] = s;
    }
    last = std::move(now);
  }
  EXPECT_GT(seen, 1000u);
}

}  // namespace
}  // namespace rg::rain::test
