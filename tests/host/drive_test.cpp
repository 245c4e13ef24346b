// The driver, the wiper motor, scenarios and the schedule of a run.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "drive/driver.h"
#include "drive/rain_sensor.h"
#include "drive/ticks.h"
#include "drive/wiper_control.h"
#include "scenario.h"
#include "schedule.h"

namespace host {
namespace {

std::vector<glm::dvec3> circle(double radius_m, int points) {
  std::vector<glm::dvec3> line;
  for (int i = 0; i <= points; ++i) {
    const double a = 1.5 * i / points;
    line.emplace_back(radius_m * std::sin(a), radius_m * (1.0 - std::cos(a)), 0.0);
  }
  return line;
}

TEST(Route, keepsLengthAndCurvatureOfACircle) {
  const Route route(circle(80.0, 24));
  EXPECT_NEAR(route.length_m(), 120.0, 0.6);  // the table's step is half a metre
  for (double way = 15.0; way < 100.0; way += 5.0)
    EXPECT_NEAR(route.curvature_per_m(way), 1.0 / 80.0, 0.02 / 80.0);
}

TEST(Route, findsTheNearestWay) {
  const Route route(circle(80.0, 24));
  EXPECT_NEAR(route.nearestWay(route.position(42.0) + glm::dvec3(0.0, 0.0, 1.0), -1.0), 42.0, 0.5);
}

TEST(Driver, brakesSmoothlyToAStopWaitsAndGoesOn) {
  const Route route({{0, 0, 0}, {300, 0, 0}, {600, 0, 0}});
  DrivePlan plan;
  plan.speed_mps = Curve(20.0);
  plan.stops = {{200.0, 2.0}};
  Driver driver(route, plan);
  double hardest = 0.0, stood_s = 0.0, stood_at_m = 0.0;
  for (int i = 0; i < 120 * 30; ++i) {
    driver.tick();
    hardest = std::max(hardest, std::abs(driver.state().acceleration_mps2));
    if (driver.state().speed_mps == 0.0) {
      stood_s += kHostTickSeconds;
      stood_at_m = driver.state().way_m;
    }
  }
  EXPECT_NEAR(stood_at_m, 200.0, 0.3);
  EXPECT_NEAR(stood_s, 2.0, 0.1);
  EXPECT_LT(hardest, 3.6);  // 1.6 times the calm braking it plans with
  EXPECT_GT(driver.state().way_m, 300.0);
}

TEST(Driver, slowsForABend) {
  const Route route(circle(40.0, 40));
  DrivePlan plan;
  plan.speed_mps = Curve(40.0);
  Driver driver(route, plan);
  for (int i = 0; i < 240; ++i) {
    driver.tick();
    const double sideways = driver.state().speed_mps * driver.state().speed_mps / 40.0;
    if (driver.state().way_m < 12.0) continue;
    EXPECT_LT(sideways, 2.8);  // plans with 2.4 m/s^2; the speed lags a little
  }
}

TEST(Driver, velocityIsTheChangeOfPosition) {
  const Route route(circle(60.0, 30));
  DrivePlan plan;
  plan.speed_mps = Curve(10.0);
  Driver driver(route, plan);
  for (int i = 0; i < 100; ++i) {
    const glm::dvec3 before = driver.state().position_m;
    driver.tick();
    EXPECT_LT(
        glm::length((driver.state().position_m - before) / kHostTickSeconds - driver.state().velocity_mps),
        1e-9);
  }
}

TEST(WiperMotor, makesItsCyclesPerMinuteAndParksAfterwards) {
  for (const auto& [mode, cycles_per_min] :
       {std::pair{WiperMode::slow, kSlowCycles_per_min}, std::pair{WiperMode::fast, kFastCycles_per_min}}) {
    WiperMotor motor;
    motor.setMode(mode);
    int reversals = 0;
    for (int i = 0; i < 120 * 60; ++i) {
      for (const WiperKnotShare& k : motor.tick())
        reversals += k.share == 1.0 && k.seconds_into_tick < kHostTickSeconds ? 1 : 0;
    }
    EXPECT_NEAR(reversals, cycles_per_min, 1.0);
    motor.setMode(WiperMode::off);
    for (int i = 0; i < 240; ++i) motor.tick();
    EXPECT_EQ(motor.share(), 0.0);
  }
  // FMVSS 104: the fast one 45 a minute or more, the slow one 20 or more, 15 or more apart.
  EXPECT_GE(kFastCycles_per_min, 45.0);
  EXPECT_GE(kSlowCycles_per_min, 20.0);
  EXPECT_GE(kFastCycles_per_min - kSlowCycles_per_min, 15.0);
}

int cyclesIn(WiperMotor& motor, double seconds) {
  int reversals = 0;
  for (int i = 0; i < 120 * seconds; ++i) {
    for (const WiperKnotShare& k : motor.tick()) reversals += k.share == 1.0 ? 1 : 0;
  }
  return reversals;
}

TEST(WiperMotor, pausesAsLongAsTold) {
  for (const double pause_s : {1.0, 4.0, 13.0}) {
    WiperMotor motor;
    motor.setMode(WiperMode::intermittent, pause_s);
    const double cycle_s = 60.0 / kSlowCycles_per_min + pause_s;
    EXPECT_NEAR(cyclesIn(motor, 20.0 * cycle_s), 20.0, 1.0) << pause_s;
  }
  // A shorter pause, told in the pause, begins with the pause.
  WiperMotor motor;
  motor.setMode(WiperMode::intermittent, 30.0);
  EXPECT_EQ(cyclesIn(motor, 10.0), 1);
  motor.setMode(WiperMode::intermittent, 2.0);
  EXPECT_EQ(cyclesIn(motor, 1.0), 1);
}

TEST(WiperMotor, wipesThreeTimesAfterAWash) {
  WiperMotor motor;
  EXPECT_EQ(cyclesIn(motor, 5.0), 0);
  motor.wipe(kWashCycles);
  EXPECT_EQ(cyclesIn(motor, 20.0), kWashCycles);
}

// Steady rain of a rate on the glass, sensed four times a second.
WiperMode sensedAt(RainSensor& sensor, double rate_mm_h, double& time_s, double& caught_m3,
                   double seconds = 20.0) {
  for (const double end_s = time_s + seconds; time_s < end_s; time_s += 0.25) {
    sensor.sense(caught_m3, 1.3, time_s);
    caught_m3 += rate_mm_h / 3.6e6 * 1.3 * 0.25;
  }
  return sensor.mode();
}

TEST(RainSensor, wipesTheMoreTheMoreIsCaught) {
  RainSensor sensor;
  double time_s = -3.0, caught_m3 = 1.0;
  EXPECT_EQ(sensedAt(sensor, 0.0, time_s, caught_m3), WiperMode::off);
  EXPECT_EQ(sensedAt(sensor, 2.0, time_s, caught_m3), WiperMode::intermittent);
  EXPECT_NEAR(sensor.rate_mm_h(), 2.0, 0.01);
  const double drizzle_s = sensor.pause_s();
  EXPECT_EQ(sensedAt(sensor, 8.0, time_s, caught_m3), WiperMode::intermittent);
  EXPECT_LT(sensor.pause_s(), 0.5 * drizzle_s);
  EXPECT_EQ(sensedAt(sensor, 30.0, time_s, caught_m3), WiperMode::slow);
  EXPECT_EQ(sensedAt(sensor, 100.0, time_s, caught_m3), WiperMode::fast);
  EXPECT_EQ(sensedAt(sensor, 0.0, time_s, caught_m3), WiperMode::off);
}

TEST(RainSensor, doesNotWaverAboutAStep) {
  RainSensor sensor;
  double time_s = 0.0, caught_m3 = 0.0;
  EXPECT_EQ(sensedAt(sensor, 13.0, time_s, caught_m3), WiperMode::slow);
  EXPECT_EQ(sensedAt(sensor, 10.0, time_s, caught_m3), WiperMode::slow);
  EXPECT_EQ(sensedAt(sensor, 6.0, time_s, caught_m3), WiperMode::intermittent);
  EXPECT_EQ(sensedAt(sensor, 10.0, time_s, caught_m3), WiperMode::intermittent);
}

TEST(Ticks, lieWhereTheClockSays) {
  EXPECT_EQ(hostTickNs(120), 1'000'000'000);
  for (const int64_t t : {INT64_C(0), INT64_C(8'333'332), INT64_C(8'333'333), INT64_C(999'999'999),
                          INT64_C(1'000'000'000), INT64_C(123'456'789'012)}) {
    EXPECT_LE(hostTickNs(hostTickAt(t)), t);
    EXPECT_GT(hostTickNs(hostTickAt(t) + 1), t);
  }
}

TEST(Scenario, allThatAreShippedLoad) {
  int loaded = 0;
  for (const auto& entry : std::filesystem::directory_iterator(RG_SOURCE_DIR "/scenarios")) {
    if (entry.path().extension() != ".toml") continue;  // the list of keys lies beside them
    EXPECT_NO_THROW(loadScenario(entry.path().string(), {}, RG_SOURCE_DIR)) << entry.path();
    ++loaded;
  }
  EXPECT_GE(loaded, 5);
}

TEST(Scenario, changesFromTheCommandLineReachIt) {
  const Scenario s = loadScenario(
      "drive",
      {"weather.rain_mm_h=12.5", "seconds=3", "camera=outside", "wipers=off", "plugin.rain.gain=2",
       "glass=new_coating", "white_cd_m2=5000", "shelter=false", "windows.rear=[[1, 0], [3, 0.2]]"},
      RG_SOURCE_DIR);
  EXPECT_EQ(s.rain_mm_h.at(0.0), 12.5);
  EXPECT_EQ(s.seconds, 3.0);
  EXPECT_EQ(s.camera, "outside");
  EXPECT_EQ(s.glass, GlassSurface::NewCoating);
  EXPECT_EQ(s.white_cd_m2, 5000.0);
  EXPECT_FALSE(s.shelter);
  EXPECT_EQ(wiperModeAt(s, 30.0), WiperMode::off);
  ASSERT_EQ(s.parameters.size(), 1U);
  EXPECT_EQ(s.parameters[0].first, "rain.gain");
  ASSERT_EQ(s.windows.size(), 1U);
  EXPECT_EQ(s.windows[0].first, "rear");
  EXPECT_EQ(s.windows[0].second.at(2.0), 0.1);
}

TEST(Scenario, wrongInputIsNamedInOneLine) {
  const auto message = [](const std::vector<std::string>& changes) -> std::string {
    try {
      loadScenario("drive", changes, RG_SOURCE_DIR);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  for (const auto& [change, named] :
       std::vector<std::pair<std::string, std::string>>{{"weather.rain_mm_h=-1", "rain_mm_h"},
                                                        {"weather.rain_mm_h=nan", "rain_mm_h"},
                                                        {"weather.rain_mm_h=1e9", "rain_mm_h"},
                                                        {"weather.rain_mm_h=[[1,2],[1,3]]", "rain_mm_h"},
                                                        {"weather.snow_mm_h=-1", "snow_mm_h"},
                                                        {"weather.hail_mm_h=nan", "hail_mm_h"},
                                                        {"weather.reign=1", "reign"},
                                                        {"wipers=3", "wipers"},
                                                        {"glass=jam", "glass"},
                                                        {"seconds=-4", "seconds"},
                                                        {"windows.rear=2", "windows.rear"},
                                                        {"windows=1", "windows"},
                                                        {"white_cd_m2=0", "white_cd_m2"},
                                                        {"drive=5", "drive"},
                                                        {"drive.stops=[[1]]", "stops"},
                                                        {"nonsense", "nonsense"},
                                                        {".x=1", ".x"},
                                                        {"drive.=1", "drive."}}) {
    const std::string text = message({change});
    EXPECT_NE(text.find(named), std::string::npos) << change << " -> " << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  EXPECT_THROW(loadScenario("no-such-scenario", {}, RG_SOURCE_DIR), InputError);
}

TEST(Schedule, updatesAndPicturesFallWhereAskedAndTheEndIsAlwaysUpdated) {
  Options o;
  o.fps = 10.0;
  o.update_hz = 30.0;
  o.shots_s = {0.25};
  const std::vector<Event> events = schedule(o, 1.0);
  int updates = 0, draws = 0;
  for (const Event& e : events) {
    updates += e.update ? 1 : 0;
    draws += e.draw ? 1 : 0;
  }
  EXPECT_EQ(updates, 31);
  EXPECT_EQ(draws, 1);
  EXPECT_EQ(events.back().time_ns, 1'000'000'000);
  EXPECT_TRUE(events.back().update);
}

TEST(Schedule, irregularUpdatesNeverRepeatTheirStep) {
  Options o;
  o.irregular_updates = true;
  o.shots_s = {0.5};
  int64_t before = -1, step_before = -1;
  for (const Event& e : schedule(o, 2.0)) {
    if (!e.update) continue;
    if (before >= 0) {
      EXPECT_NE(e.time_ns - before, step_before);
    }
    step_before = before >= 0 ? e.time_ns - before : -1;
    before = e.time_ns;
  }
}

}  // namespace
}  // namespace host
