// The wind's way so far, as few straight stretches, against the way itself.
#include "rain/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace rg::rain {
namespace {

using glm::dvec3;

struct Weather {
  const char* name;
  std::function<dvec3(double)> wind_mps;
  double known_s;  // so far back at least
};
std::ostream& operator<<(std::ostream& out, const Weather& w) { return out << w.name; }

class WindsPast : public ::testing::TestWithParam<Weather> {};

// By a centimetre and 4 cm for each second back, and the centimetre by which a piece leaves the way itself.
TEST_P(WindsPast, staysByTheWay) {
  const Weather& weather = GetParam();
  WindPath path;
  std::vector<dvec3> carried_m;
  path.start(0.0, dvec3(0.0), weather.wind_mps(0.0));
  carried_m.push_back(path.carried_m());
  for (int tick = 1; tick <= 1800; ++tick) {
    const double t = tick * kTickSeconds;
    path.advance(t, weather.wind_mps(t));
    carried_m.push_back(path.carried_m());
  }
  WindPath::Past past;
  path.trace(past);
  ASSERT_GT(past.count, 0U);
  double until_s = 1800 * kTickSeconds;
  for (uint32_t i = 0; i < past.count; ++i) {
    const WindPath::Piece& stretch = past.stretches[i];
    ASSERT_TRUE(i == 0 ? stretch.from_s <= until_s : stretch.from_s < until_s);
    for (int tick = static_cast<int>(std::ceil(stretch.from_s / kTickSeconds));
         tick * kTickSeconds <= until_s; ++tick) {
      const dvec3 at = stretch.carried_m + stretch.wind_mps * (tick * kTickSeconds - stretch.from_s);
      const double ago_s = (1800 - tick) * kTickSeconds;
      ASSERT_LT(glm::distance(at, carried_m[static_cast<size_t>(tick)]), kDeparture_m * (2.0 + 4.0 * ago_s))
          << ago_s << " s ago, stretch " << i << " of " << past.count;
    }
    until_s = stretch.from_s;
  }
  EXPECT_LE(until_s, 1800 * kTickSeconds - weather.known_s) << past.count << " stretches";
}

// The way itself leaves one place to the newest: so many and no more may be read.
TEST(WindsPastSaved, leavesRoomForTheNewest) {
  WindPath path;
  path.start(0.0, dvec3(0.0), dvec3(1.0, 0.0, 0.0));
  saved::Writer newest, saved;
  newest(std::as_const(path));
  const size_t count_at = 4 + 7 * 8;  // after one piece
  for (const uint8_t count : {uint8_t{30}, uint8_t{31}}) {
    saved.bytes.assign(newest.bytes.begin(), newest.bytes.begin() + count_at);
    saved.bytes.insert(saved.bytes.end(), {count, 0, 0, 0});
    saved.bytes.resize(saved.bytes.size() + size_t{count} * 7 * 8);  // zeros
    saved.bytes.insert(saved.bytes.end(), newest.bytes.begin() + count_at + 4, newest.bytes.end());
    saved::Reader a(saved.bytes, false);
    WindPath read;
    if (count == 31) {
      EXPECT_THROW(a(read), saved::Refused);
      continue;
    }
    a(read);
    WindPath::Past past;
    read.trace(past);
    EXPECT_EQ(past.count, WindPath::Past::kMost);
  }
}

dvec3 steady(double) { return {3, 1, 0}; }
// A step is over within a tick, and leaves a corner of half a tick.
dvec3 stepped(double t) { return t < 5.0 ? dvec3(4, 0, 0) : t < 14.9 ? dvec3(0, -2, 0) : dvec3(2, 1, 0); }
dvec3 squally(double t) { return {4 + 5 * std::sin(3.0 * t), 3 * std::sin(4.1 * t), 0}; }
dvec3 backing(double t) { return {8 * std::cos(0.1 * t), 8 * std::sin(0.1 * t), 0}; }

INSTANTIATE_TEST_SUITE_P(Winds, WindsPast,
                         ::testing::Values(Weather{"steady", steady, 15}, Weather{"stepped", stepped, 15},
                                           Weather{"squally", squally, 5}, Weather{"backing", backing, 15}),
                         [](const auto& given) { return given.param.name; });

}  // namespace
}  // namespace rg::rain
