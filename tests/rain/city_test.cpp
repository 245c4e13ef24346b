// The field in a city of thousands of volumes, at rest and driving about, some of them changed while it
// rains: when each drop will end, and which ones are missing, against brute force.
#include <gtest/gtest.h>

#include <set>

#include "city_oracle.h"
#include "measure.h"
#include "rain/shelter.h"
#include "standing_drops.h"

namespace rg::rain::test {
namespace {

// As the shelter's own oracle, and the 8 us of the clock by which ends are told.
constexpr double kEndStep_s = kTickSeconds / 1024.0;

struct City {
  std::mt19937_64 random{41};
  std::vector<Building> all;    // by id - 1
  std::vector<Building> gone;   // were there once
  std::vector<Course> courses;  // of vehicles, at time 0
  const Course& courseOf(const Building& b) const {
    static const Course kAtRest;
    return b.vehicle == 0 ? kAtRest : courses[b.vehicle - 1];
  }
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
  Building house() { return {randomShape(random, 2.0), dvec3(draw(-60, 80), draw(-40, 40), draw(0, 9)), 0}; }
};

// The first time from now at which the drop is in any building as it stands, each larger by its doubt when
// sign is 1, smaller when it is -1.
double endByTheOracle(const City& city, const LiveDrop& d, double now_s, double sign) {
  double first = kNever_s;
  for (const Building& b : city.all) {
    const bool turns = b.vehicle != 0;
    // At p + v t, t from time 0.
    const Stretch way{d.place_m - d.velocity_mps * now_s, d.velocity_mps, now_s,
                      now_s + (turns ? BodyPath::kAhead_s : Shelter::kPath_m / glm::length(d.velocity_mps))};
    first = std::min(first,
                     firstEntry(b, city.courseOf(b), way, sign * (turns ? kTurning_m : kRounding_m)) - now_s);
  }
  return first;
}

bool cameThroughAny(const City& city, const LiveDrop& d, double now_s, double sign) {
  const Stretch way{d.place_m - d.velocity_mps * now_s, d.velocity_mps, now_s - 6.0, now_s};
  const auto meets = [&](const Building& b) {
    return firstEntry(b, city.courseOf(b), way, sign * (b.vehicle != 0 ? kTurning_m : kRounding_m)) <
           kNever_s;
  };
  return std::ranges::any_of(city.all, meets) || std::ranges::any_of(city.gone, meets);
}

class CityField : public ::testing::Test {
 protected:
  static constexpr uint64_t kSeed = 43;
  static constexpr double kRate_mm_h = 10.0, kSpeed_mps = 20.0;

  void SetUp() override {
    for (int i = 0; i < 2500; ++i) city.all.push_back(city.house());
    for (uint32_t i = 1; i <= 20; ++i) {
      city.courses.push_back({{city.draw(-20, 20), city.draw(-15, 15), city.draw(0, 1)},
                              {city.draw(0, 30), city.draw(-5, 5), 0},
                              city.draw(0, 6.28),
                              i % 2 == 0 ? 0.0 : city.draw(-1, 1)});
      city.all.emplace_back(randomShape(city.random, 2.0), dvec3(0, 0, 1), i);
    }
    uint32_t id = 0;
    for (const Building& b : city.all) ASSERT_EQ(b.tell(field, ++id), "");
    scene = sceneWithView(kRate_mm_h);
    scene.weather.wind_mps = {-3, 4, 0};
  }
  double time_s() const { return static_cast<double>(scene.index) * kTickSeconds; }
  void tick() {
    scene.vehicles.clear();
    for (size_t i = 0; i < city.courses.size(); ++i) {
      VehicleState& state = scene.vehicles.emplace_back();
      state.id = static_cast<uint32_t>(i + 1);
      state.pose = city.courses[i].pose(time_s());
    }
    place(scene, kSpeed_mps, 0.0);
    field.tick(scene.tick());
  }
  // Some houses go, others take their ids.
  void rebuild(int houses) {
    for (int i = 0; i < houses; ++i) {
      const auto at = std::uniform_int_distribution<size_t>(0, 2499)(city.random);
      city.gone.push_back(city.all[at]);
      city.all[at] = city.house();
      ASSERT_EQ(city.all[at].tell(field, static_cast<uint32_t>(at + 1)), "");
    }
  }

  City city;
  Field field{{.capacity = 200000, .seed = kSeed}};
  Scene scene;
};

TEST_F(CityField, endsAndMissingDropsAreTheOracles) {
  Upload upload;
  const InTheAir air = InTheAir::of(ratesOf(scene.weather));
  int compared = 0, end = 0, missing = 0;
  for (; scene.index <= 120; ++scene.index) {
    if (scene.index % 40 == 20) rebuild(60);
    tick();
    if (scene.index % 20 != 0) continue;
    field.publishAll(upload);
    std::set<DropKey> alive;
    for (const RainDrop& record : upload.records) {
      const LiveDrop d = liveDropOf(record, upload.picture);
      alive.insert(d.key);
      if (record.id % 4 != 0) continue;  // enough of them
      const double left_s =
          static_cast<double>(static_cast<int32_t>(record.end - upload.picture.epoch_ticks * 1024u)) *
          kEndStep_s;
      const double ends_s = left_s < 8000.0 ? left_s : kNever_s;
      ASSERT_GE(ends_s, endByTheOracle(city, d, time_s(), 1.0) - kEndStep_s) << "tick " << scene.index;
      ASSERT_LE(ends_s, endByTheOracle(city, d, time_s(), -1.0)) << "tick " << scene.index;
      ++compared;
      end += ends_s < kNever_s ? 1 : 0;
    }
    for (const LiveDrop& d : standingDrops(kSeed, upload.picture, coneOf(scene.views[0]), air)) {
      if (alive.contains(d.key)) continue;
      ++missing;
      ASSERT_TRUE(cameThroughAny(city, d, time_s(), 1.0)) << "tick " << scene.index;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_GT(end, 300);
  EXPECT_GT(missing, 300);
}

// More volumes about the eye than a view can be told of: streaks are drawn less far, but none in the dry.
TEST(NearVolumes, moreThanFitDrawRainLessFarAndNeverInside) {
  constexpr int kAlong = 16, kAcross = 12;
  Field field({.capacity = 200000, .seed = 44});
  std::vector<std::pair<dvec3, dvec3>> stalls;
  for (int i = 0; i < kAlong; ++i) {
    for (int k = 0; k < kAcross; ++k) {
      const dvec3 low(1.0 * i + 2.0, 1.0 * k - 6.0, 0.5 + 0.1 * (k % 4));
      stalls.emplace_back(low, low + dvec3(0.5, 0.5, 1.0));
      ASSERT_EQ(
          setBox(field, static_cast<uint32_t>(stalls.size()), stalls.back().first, stalls.back().second), "");
    }
  }
  Scene scene = sceneWithView(50);
  scene.views[0].exposure_s = 0.1;
  std::vector<Streak> streaks;
  Upload upload;
  for (; scene.index < 40; ++scene.index) {
    place(scene, 20, 0.0, -6.0);
    field.tick(scene.tick());
    if (scene.index % 5 != 4) continue;
    field.streaks(scene.views[0], tickTimeNs(scene.index), streaks);
    for (const Streak& s : streaks) {
      for (int k = 0; k <= 8; ++k) {
        const dvec3 p = s.from_m + (s.to_m - s.from_m) * (k / 8.0);
        for (const auto& [low, high] : stalls) {
          ASSERT_FALSE(glm::all(glm::greaterThan(p, low + 2e-4)) && glm::all(glm::lessThan(p, high - 2e-4)))
              << "tick " << scene.index;
        }
      }
    }
  }
  field.publishAll(upload);
  EXPECT_FALSE(upload.picture.volumesFit());
  EXPECT_GT(streaks.size(), 200u);  // before the first stall that finds no room it rains as ever
}

}  // namespace
}  // namespace rg::rain::test
