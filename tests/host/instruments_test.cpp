// Needles and digits: what the driver reads at a speed.
#include "drive/instruments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "loaded.h"

namespace host {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(Needle, turnsInProportionAndStopsAtTheEndsOfItsScale) {
  const auto angle_deg = [](double value) {
    const NeedleMeaning speedometer{Reading::Speed_kmh, 240.0F, glm::radians(-264.0F)};
    return glm::degrees(needleAngle_rad(speedometer, value));
  };
  EXPECT_NEAR(angle_deg(0.0), 0.0F, 1e-4F);
  EXPECT_NEAR(angle_deg(50.0), -55.0F, 1e-4F);
  EXPECT_NEAR(angle_deg(80.0), -88.0F, 1e-4F);
  EXPECT_NEAR(angle_deg(130.0), -143.0F, 1e-4F);
  EXPECT_NEAR(angle_deg(240.0), -264.0F, 1e-4F);
  EXPECT_NEAR(angle_deg(300.0), -264.0F, 1e-4F);
  EXPECT_NEAR(angle_deg(-5.0), 0.0F, 1e-4F);
  EXPECT_NEAR(angle_deg(kNotANumber), 0.0F, 1e-4F);
}

// Three of them, a space where the empty side is in front.
std::string digitsShowing(double value) {
  std::string text;
  for (const int place : {2, 1, 0}) {
    const double turned = double{digitAngle_rad({Reading::Speed_kmh, place}, value)} / glm::two_pi<double>();
    const double side = turned * kDigitSides;
    EXPECT_NEAR(side, std::round(side), 1e-5) << "a side is in front, not an edge";
    text += side < 0.5 ? ' ' : static_cast<char>('0' + std::lround(side) - 1);
  }
  return text;
}

TEST(Digits, showTheNearestWholeNumberWithoutNoughtsBeforeIt) {
  EXPECT_EQ(digitsShowing(0.0), "  0");
  EXPECT_EQ(digitsShowing(50.0), " 50");
  EXPECT_EQ(digitsShowing(80.0), " 80");
  EXPECT_EQ(digitsShowing(130.0), "130");
  EXPECT_EQ(digitsShowing(49.6), " 50");
  EXPECT_EQ(digitsShowing(49.4), " 49");
  EXPECT_EQ(digitsShowing(9.0), "  9");
  EXPECT_EQ(digitsShowing(99.7), "100");
  EXPECT_EQ(digitsShowing(207.0), "207");
  EXPECT_EQ(digitsShowing(-3.0), "  0");
  EXPECT_EQ(digitsShowing(kNotANumber), "  0");
}

TEST(Engine, idlesInACarThatStands) {
  EXPECT_EQ(engineSpeed_rpm(0.0), 800.0);
  EXPECT_EQ(engineSpeed_rpm(5.0 / 3.6), 800.0);
  EXPECT_EQ(engineSpeed_rpm(kNotANumber), 800.0);
}

TEST(Engine, turnsAsACalmDriversDoesAndShiftsWithoutAJump) {
  EXPECT_NEAR(engineSpeed_rpm(50.0 / 3.6), 1667.0, 1.0);
  EXPECT_NEAR(engineSpeed_rpm(80.0 / 3.6), 1702.0, 1.0);
  EXPECT_NEAR(engineSpeed_rpm(130.0 / 3.6), 2766.0, 1.0);
  int shifts = 0;
  bool falls = false;
  double before_rpm = engineSpeed_rpm(0.0);
  for (int i = 1; i <= 2160; ++i) {
    const double rpm = engineSpeed_rpm(0.1 * i / 3.6);
    EXPECT_LT(std::abs(rpm - before_rpm), 100.0) << 0.1 * i << " km/h";
    EXPECT_LT(rpm, i < 700 ? 2800.0 : 5000.0) << 0.1 * i << " km/h";
    if (rpm < before_rpm && !falls) ++shifts;
    falls = rpm < before_rpm;
    before_rpm = rpm;
  }
  EXPECT_EQ(shifts, 5) << "six gears";
}

TEST(Instruments, carWithoutAnyIsPosedAsItWas) {
  const Scene scene = files::load(files::wholeCar());
  std::vector<Pose> poses = scene.restPoses();
  poseInstruments(scene, carView(scene), 20.0, poses);
  ASSERT_EQ(poses.size(), scene.nodes.size());
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_EQ(poses[i].rotation, scene.nodes[i].pose.rotation);
}

}  // namespace
}  // namespace host
