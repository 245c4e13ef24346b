// The shelter's answers, tree and birth test and all, against brute force: every drop's way, straight through
// past and future, cut with every volume in turn.
#include "rain/shelter.h"

#include <gtest/gtest.h>

#include "city_oracle.h"

namespace rg::rain::test {
namespace {

constexpr double kClock_s = 1e-7;

struct City {
  City(uint64_t seed, int buildings, int vehicles, double side_m, double size_m) : random(seed) {
    uint32_t id = 0;
    for (int i = 0; i < buildings; ++i)
      all.emplace_back(randomShape(random, size_m),
                       dvec3(draw(-side_m, side_m), draw(-side_m, side_m), draw(0, 12)), 0);
    for (int i = 0; i < vehicles; ++i) {
      const auto vehicle = static_cast<uint32_t>(i + 1);
      Course course{{draw(-side_m, side_m), draw(-side_m, side_m), draw(0, 2)},
                    {draw(-40, 40), draw(-40, 40), draw(-1, 1)},
                    draw(0, 6.28),
                    i % 3 == 0 ? 0.0 : draw(-1.5, 1.5)};
      courses.push_back(course);
      all.emplace_back(randomShape(random, 2.0), dvec3(draw(-1, 1), 0, 1), vehicle);
      all.emplace_back(randomShape(random, 1.0), dvec3(4, 0, 2), vehicle);  // a trailer
      VehicleState state;
      state.id = vehicle;
      state.pose = course.pose(0.0);
      states.push_back(state);
    }
    for (const Building& b : all) {
      VolumeInfo info;
      info.vehicle = b.vehicle;
      info.vertices = b.points;
      EXPECT_EQ(shelter.set(++id, info), "");
    }
    shelter.advance(0.0, states);
  }
  double draw(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }
  const Course& courseOf(const Building& b) const {
    static const Course kNone;
    return b.vehicle == 0 ? kNone : courses[b.vehicle - 1];
  }

  std::mt19937_64 random;
  std::vector<Building> all;
  std::vector<Course> courses;
  std::vector<VehicleState> states;
  Shelter shelter;
};

// A way through winds that changed: falls at one speed, and came by up to four winds.
ClassPath randomPath(City& city) {
  ClassPath path;
  const double fall = city.draw(2.0, 9.4);
  const auto wind = [&] { return dvec3(city.draw(-20, 20), city.draw(-20, 20), -fall); };
  const double longest = Shelter::kPath_m / fall;
  path.pieces[0] = {0.0, longest, dvec3(0.0), wind()};
  path.count = 1;
  double until = 0.0;
  dvec3 to_m(0.0);
  const int winds = std::uniform_int_distribution<int>(1, 4)(city.random);
  for (int i = 0; i < winds; ++i) {
    const double begin = i + 1 == winds ? -longest : until - city.draw(0.1, 1.0);
    const dvec3 v = i == 0 ? path.pieces[0].velocity_mps : wind();
    to_m += v * (begin - until);
    path.pieces[path.count++] = {begin, until, to_m, v};
    until = begin;
  }
  path.straight = winds == 1;
  return path;
}

// As the plugin foresees: bodies for 3 s either way.
Passage verdictOf(const City& city, const dvec3& place, const ClassPath& path, double sign) {
  Passage verdict;
  for (uint32_t k = 0; k < path.count; ++k) {
    const PathPiece& piece = path.pieces[k];
    const Stretch whole{place + piece.from_m - piece.velocity_mps * piece.from_s, piece.velocity_mps,
                        piece.from_s, piece.to_s};
    for (const Building& b : city.all) {
      Stretch s = whole;
      if (b.vehicle != 0) {
        s.from = std::max(s.from, -BodyPath::kBehind_s);
        s.to = std::min(s.to, BodyPath::kAhead_s);
        if (s.from >= s.to) continue;
      }
      const double more_m = sign * (b.vehicle != 0 ? kTurning_m : kRounding_m);
      const double entry = firstEntry(b, city.courseOf(b), s, more_m);
      if (k == 0)
        verdict.enters_s = std::min(verdict.enters_s, entry);
      else
        verdict.came_through = verdict.came_through || entry < kNever_s;
    }
  }
  return verdict;
}

void expectTheOraclesAnswers(City& city, int drops, double side_m) {
  int entered = 0, went_through = 0, open = 0;
  for (int i = 0; i < drops; ++i) {
    const ClassPath path = randomPath(city);
    const dvec3 place(city.draw(-side_m, side_m), city.draw(-side_m, side_m), city.draw(-2, 16));
    const dvec3 half(city.draw(0.1, 1.0)), off(city.draw(-1, 1), city.draw(-1, 1), city.draw(-1, 1));
    Passage told;
    if (city.shelter.lookAround(place + off * half, half, path, 0.0, true))
      told = city.shelter.passage(place, path, 0.0);
    const Passage larger = verdictOf(city, place, path, 1.0), smaller = verdictOf(city, place, path, -1.0);
    ASSERT_FALSE(told.came_through && !larger.came_through) << "drop " << i << " is lost";
    ASSERT_FALSE(!told.came_through && smaller.came_through) << "drop " << i << " came through";
    ASSERT_GE(told.enters_s, larger.enters_s - kClock_s) << "drop " << i << " ends too early";
    ASSERT_LE(told.enters_s, smaller.enters_s + kClock_s) << "drop " << i << " ends too late";
    entered += told.enters_s < kNever_s ? 1 : 0;
    went_through += told.came_through ? 1 : 0;
    open += told.enters_s == kNever_s && !told.came_through ? 1 : 0;
  }
  EXPECT_GT(entered, drops / 20);
  EXPECT_GT(went_through, drops / 20);
  EXPECT_GT(open, drops / 20);
}

TEST(ShelterOracle, bothEndsOfLifeInACityOfThousands) {
  City city(1, 3000, 60, 150.0, 3.0);
  expectTheOraclesAnswers(city, 2500, 150.0);
}

TEST(ShelterOracle, bothEndsOfLifeAmongTurningBodies) {
  City city(2, 10, 60, 30.0, 2.0);
  expectTheOraclesAnswers(city, 6000, 30.0);
}

// A million drops, each of a wind's past of its own.
TEST(LongShelterOracle, bothEndsOfLifeOfAMillionDrops) {
  City city(3, 150, 12, 30.0, 2.5);
  expectTheOraclesAnswers(city, 1'000'000, 30.0);
}

}  // namespace
}  // namespace rg::rain::test
