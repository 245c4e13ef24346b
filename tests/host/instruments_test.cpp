// Needles and digits: what the driver reads at a speed, on any car and on the one that comes with the
// project.
#include "drive/instruments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

#include "image/decode.h"
#include "loaded.h"
#include "render/mesh_merge.h"
#include "support/run_host.h"

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

// The project's car. All in its file's axes.
struct Cockpit : testing::Test {
  const Scene scene = loadScene(std::string(RG_SOURCE_DIR) + "/models/car.glb");
  const CarView car = carView(scene);
  const Primitive* face = nullptr;  // the painted one, of two triangles
  glm::mat4 from_face{1.0F};

  Cockpit() {
    for (const int i : scene.order) {
      const Node& node = scene.nodes[static_cast<std::size_t>(i)];
      if (node.mesh < 0) continue;
      for (const Primitive& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
        if (materialOf(p).name == "dials") face = &p, from_face = node.scene_from_node;
      }
    }
    if (face == nullptr) throw std::runtime_error("no painted dials");
  }

  const Material& materialOf(const Primitive& p) const {
    return scene.materials[static_cast<std::size_t>(p.material)];
  }
  glm::vec3 faceCorner(std::size_t i) const {
    return glm::vec3(from_face * glm::vec4(face->positions_m[face->indices[i]], 1.0F));
  }
  glm::vec3 outOfFace() const {
    return glm::normalize(glm::cross(faceCorner(1) - faceCorner(0), faceCorner(2) - faceCorner(0)));
  }
  // How red the face is painted behind a point, 0 .. 255: white scales and red ones are.
  int redBehind(glm::vec3 point) const {
    const glm::vec3 a = faceCorner(1) - faceCorner(0), b = faceCorner(2) - faceCorner(0),
                    d = point - faceCorner(0);
    const glm::mat2 gram{{glm::dot(a, a), glm::dot(a, b)}, {glm::dot(a, b), glm::dot(b, b)}};
    const glm::vec2 share = glm::inverse(gram) * glm::vec2(glm::dot(a, d), glm::dot(b, d));
    const auto uv = [&](std::size_t i) { return face->uv0[face->indices[i]]; };
    const glm::vec2 at = uv(0) + share.x * (uv(1) - uv(0)) + share.y * (uv(2) - uv(0));
    const Image& picture = scene.images.at(static_cast<std::size_t>(materialOf(*face).base_colour_map.image));
    const int x = static_cast<int>(at.x * static_cast<float>(picture.width_px));
    const int y = static_cast<int>(at.y * static_cast<float>(picture.height_px));
    return picture.rgba.at(static_cast<std::size_t>(4 * (y * picture.width_px + x)));
  }
  const Primitive& meshOf(int node) const {
    const int mesh = scene.nodes[static_cast<std::size_t>(node)].mesh;
    return scene.meshes.at(static_cast<std::size_t>(mesh)).primitives.at(0);
  }
  // A little before its end, which short ticks come near.
  glm::vec3 tip(const NeedleView& needle, float angle_rad) const {
    std::vector<Pose> poses = scene.restPoses();
    turnNode(scene, needle.node, {0.0F, 1.0F, 0.0F}, angle_rad, poses);
    float length_m = 0.0F;
    for (const glm::vec3& p : meshOf(needle.node).positions_m) length_m = std::max(length_m, glm::length(p));
    glm::vec4 sum(0.0F);  // of the corners that make it
    for (const glm::vec3& p : meshOf(needle.node).positions_m)
      if (glm::length(p) > 0.99F * length_m) sum += glm::vec4(p, 1.0F);
    const glm::mat4 from_needle = scene.sceneFromNode(poses)[static_cast<std::size_t>(needle.node)];
    return glm::vec3(from_needle * glm::vec4(0.97F * glm::vec3(sum) / sum.w, 1.0F));
  }
};

TEST_F(Cockpit, needlesPointToTheValuesThatTheDialsArePaintedWith) {
  ASSERT_EQ(car.needles.size(), 2U);
  for (const NeedleView& needle : car.needles) {
    const float step = needle.scale.shows == Reading::Speed_kmh ? 40.0F : 1000.0F;
    constexpr int kBright = 180, kTurns = 1440;
    for (float value = 0.0F; value <= needle.scale.full; value += step)
      EXPECT_GT(redBehind(tip(needle, needleAngle_rad(needle.scale, double{value}))), kBright) << value;
    int ticks = 0;
    const auto bright = [&](int i) {
      return redBehind(tip(needle, glm::two_pi<float>() * static_cast<float>(i) / kTurns)) > kBright;
    };
    for (int i = 0; i < kTurns; ++i) ticks += bright(i) && !bright(i - 1) ? 1 : 0;
    EXPECT_EQ(ticks, 1 + static_cast<int>(needle.scale.full / step)) << "one for each value";
  }
}

TEST_F(Cockpit, needlesAreTurnedToWhatEachShows) {
  std::vector<Pose> poses = scene.restPoses();
  poseInstruments(scene, car, 80.0 / 3.6, poses);
  for (const NeedleView& needle : car.needles) {
    const double value = needle.scale.shows == Reading::Speed_kmh ? 80.0 : engineSpeed_rpm(80.0 / 3.6);
    std::vector<Pose> expected = scene.restPoses();
    turnNode(scene, needle.node, {0.0F, 1.0F, 0.0F}, needleAngle_rad(needle.scale, value), expected);
    const auto i = static_cast<std::size_t>(needle.node);
    EXPECT_NEAR(std::abs(glm::dot(poses[i].rotation, expected[i].rotation)), 1.0F, 1e-6F);
  }
}

TEST_F(Cockpit, digitsStandInTheirOrder) {
  ASSERT_EQ(car.digits.size(), 3U);
  std::array<float, 3> left_m{};
  for (const DigitView& digit : car.digits)
    left_m.at(static_cast<std::size_t>(digit.drum.place)) =
        scene.nodes[static_cast<std::size_t>(digit.node)].scene_from_node[3].x;
  EXPECT_LT(left_m[0], left_m[1]);
  EXPECT_LT(left_m[1], left_m[2]) << "hundreds on the left";
}

TEST_F(Cockpit, digitInFrontIsTheOneToBeShownAndAloneComesThroughTheFace) {
  ASSERT_EQ(car.digits.size(), 3U);
  for (const DigitView& digit : car.digits) {
    for (int k = -1; k < 10; ++k) {  // -1: empty
      const double value =
          k < 0 ? 0.0 : (k == 0 && digit.drum.place > 0 ? 10 : k) * std::pow(10.0, digit.drum.place);
      if (k < 0 && digit.drum.place == 0) continue;  // the ones are always shown
      std::vector<Pose> poses = scene.restPoses();
      poseInstruments(scene, car, value / 3.6, poses);
      const glm::mat4 from_drum = scene.sceneFromNode(poses)[static_cast<std::size_t>(digit.node)];
      const Primitive& drum = meshOf(digit.node);
      int in_front = 0;
      float u = 0.0F;
      for (std::size_t i = 0; i < drum.positions_m.size(); ++i) {
        const glm::vec3 p(from_drum * glm::vec4(drum.positions_m[i], 1.0F));
        const float before_m = glm::dot(p - faceCorner(0), outOfFace());
        EXPECT_LT(before_m, 1e-3F);
        if (before_m > 0.0F) ++in_front, u += drum.uv0[i].x;
      }
      EXPECT_EQ(in_front, k < 0 ? 0 : 4) << "the corners of one side";
      if (k >= 0) {
        EXPECT_EQ(static_cast<int>(10.0F * u / 4.0F), k) << "place " << digit.drum.place;
      }
    }
  }
}

TEST_F(Cockpit, eachNeedleAndDigitIsOneDraw) {
  const MergedScene merged = mergeScene(scene, 0.0F);
  std::vector<int> nodes;
  for (const NeedleView& needle : car.needles) nodes.push_back(needle.node);
  for (const DigitView& digit : car.digits) nodes.push_back(digit.node);
  for (const int node : nodes) {
    EXPECT_EQ(std::ranges::count(merged.bodies, node), 1) << "it turns by itself";
    EXPECT_EQ(std::ranges::count_if(merged.draws,
                                    [&](const MergedDraw& d) {
                                      return merged.bodies[static_cast<std::size_t>(d.body)] == node;
                                    }),
              1);
  }
}

// Without rain and road nothing else moves.
Pixels seenAt(const std::string& speed_kmh) {
  const auto folder = testing_host::freshFolder("cockpit");
  const testing_host::Outcome run = testing_host::runHost(
      "--headless --scenario parked --set models.road= --set weather.rain_mm_h=0 --set prewarm_s=0 "
      "--size 320x180 --seconds 0 --shots 0 --set drive.speed_kmh=" +
      speed_kmh + " --out " + folder.string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string png = testing_host::slurp(folder / "shot_0.00.png");
  std::filesystem::remove_all(folder);
  return decodePixels({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()});
}

TEST(Instruments, picturesOfACarThatStandsAndOfOneThatDrivesDifferInThemAlone) {
  const Pixels standing = seenAt("0"), driving = seenAt("130");
  ASSERT_EQ(standing.rgba.size(), driving.rgba.size());
  int among_instruments = 0, worst_elsewhere = 0;
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 320; ++x) {
      const auto i = static_cast<std::size_t>(4 * (320 * y + x));
      const int change = std::abs(int{standing.rgba[i]} - int{driving.rgba[i]});
      const bool there = x >= 110 && x < 210 && y >= 135;  // within the steering wheel's rim
      if (there && change > 30) ++among_instruments;
      if (!there) worst_elsewhere = std::max(worst_elsewhere, change);
    }
  }
  EXPECT_GT(among_instruments, 40);
  EXPECT_LE(worst_elsewhere, 3);
}

}  // namespace
}  // namespace host
