// How long and how pointed drops become, at rest and as they run, and what they leave behind.
#include "glass/drop_shape.h"

#include <gtest/gtest.h>

#include "drop_scene.h"
#include "glass/water.h"
#include "shared/optics_drop.glsl"

namespace rg::test {
namespace {

// What is drawn over a base of any length and tail, summed up column by column, is the drop's volume.
TEST(DropShape, anyOutlineHoldsTheSameVolume) {
  for (const double angle : {rad(25), rad(55), rad(100)}) {
    const double round = glass::capHeight(glass::capShape(angle), 1.0, 2.4), across = 1.0 / std::sqrt(2.4);
    EXPECT_NEAR(2.4 * std::pow(across, 3.0) * glass::capShape(2.0 * std::atan(round / across)),
                glass::capShape(angle), 1e-9);
    if (angle > rad(90)) continue;  // it overhangs its base; no corner forms on such glass
    for (const double elongation : {1.0, 1.3, 2.4}) {
      for (const double corner : {0.0, 0.6, 1.0, -1.0}) {
        const double volume = glass::capShape(angle);  // base's area that of radius 1
        const double height = glass::capHeight(volume, 1.0, elongation),
                     half_width = 1.0 / std::sqrt(elongation);
        const shared::Cap cap = shared::capOf(static_cast<float>(2.0 * std::atan(height / half_width)),
                                              static_cast<float>(elongation));
        constexpr int kColumns = 400;
        double sum = 0.0, base = 0.0;
        for (int i = 0; i < kColumns; ++i) {
          // Where the outline comes in steeply columns are thin: x = sin(a).
          const double a = kPi * ((i + 0.5) / kColumns - 0.5), x = std::sin(a);
          const double wider =
              static_cast<double>(shared::cornered(static_cast<float>(x), static_cast<float>(corner)));
          const double dx = elongation * std::cos(a) * kPi / kColumns;
          // A cut across a cap: of a circle of radius r about z0, what is above the glass.
          const double z0 = static_cast<double>(cap.centre_z), big = static_cast<double>(cap.radius);
          const double r = std::sqrt(big * big - x * x), at_glass = std::acos(std::clamp(-z0 / r, -1.0, 1.0));
          sum += wider * r * r * (at_glass - std::sin(at_glass) * std::cos(at_glass)) * dx;
          base += wider * 2.0 * std::sqrt(1.0 - x * x) * dx;
        }
        const double scale = half_width * half_width;
        SCOPED_TRACE(std::to_string(angle) + " rad, " + std::to_string(elongation) + " long, corner " +
                     std::to_string(corner));
        EXPECT_NEAR(base * scale / kPi, 1.0, 1e-4);
        EXPECT_NEAR(sum * scale * half_width / volume, 1.0, 1e-3);  // floats, and as many columns
      }
    }
  }
}

// At its tip the drawn outline has the angle that the law of corners asks for: sin phi = U_c / U.
TEST(DropShape, theTailsAngleIsThatOfItsSpeed) {
  constexpr double kReceding_mps = 0.02;
  for (const double faster : {1.3, 1.6, 1.9, 2.0, 5.0}) {
    const double elongation = glass::lengthWithCorner(faster * kReceding_mps, kReceding_mps);
    const double back = 1e-4, x = back - 1.0;  // of the half length, from the tip
    const double half_width =
        static_cast<double>(shared::cornered(static_cast<float>(x), 1.0f)) * std::sqrt(1.0 - x * x);
    const double half_angle = std::atan(half_width / (elongation * back));
    EXPECT_NEAR(std::sin(half_angle), 1.0 / std::min(faster, 2.0), 5e-3) << faster;
  }
  EXPECT_EQ(glass::lengthWithCorner(0.99 * kReceding_mps, kReceding_mps), 0.0);
}

// ElSherbini & Jacobi 2004: 1 + 0.096 rho g sin a D^2 / gamma, for drops that hardly stay.
TEST(DropShape, restingDropsAreAsLongAsTheirBondNumberSays) {
  for (const glass::Glass glass : {glass::Glass::uncoated, glass::Glass::dirty, glass::Glass::coated}) {
    const glass::Surface surface = glass::surfaceOf(glass);
    const double critical_m = glass == glass::Glass::coated ? 3.4e-3 : 7.5e-3, diameter_m = 0.94 * critical_m;
    DropScene scene(rad(30), glass);
    scene.place(0.0, 0.0, 0.5 * diameter_m, glass::meanAngle(surface));
    scene.run(weather(0.0), 0.5);
    const shared::GlassDropRecord drop = scene.sim->snapshot()->drops.at(0);
    const double bond = 1000.0 * 9.81 * 0.5 * diameter_m * diameter_m / glass::kGamma_n_m;
    EXPECT_NEAR(static_cast<double>(drop.elongation), 1.0 + 0.096 * bond,
                0.012);  // within 0.01 it is at rest
    EXPECT_EQ(drop.corner, 0.0f);
    const glm::dvec2 down(scene.sim->map().gridFromGlass({0.0, -1.0}) -
                          scene.sim->map().gridFromGlass({0.0, 0.0}));
    EXPECT_GT(std::abs(glm::dot(glm::normalize(down), glm::dvec2(drop.heading))), 0.999);
  }
}

// Wind that comes up in air that dries nothing makes them as long as wind that was there from the first.
TEST(DropShape, restingDropsFollowTheWind) {
  const auto longAfter = [](double calm_s) {
    DropScene scene(1e-6, glass::Glass::dirty);
    scene.place(0.0, 0.0, 2.5e-3, rad(40));
    const glm::vec2 start = scene.sim->snapshot()->drops.at(0).position_m;
    scene.run(weather(0.0), calm_s);
    scene.run(weather(0.0, 7.0), 0.5);
    const shared::GlassDropRecord drop = scene.sim->snapshot()->drops.at(0);
    EXPECT_EQ(drop.position_m, start);
    return static_cast<double>(drop.elongation);
  };
  const double at_once = longAfter(0.0);
  EXPECT_GT(at_once, 1.15);
  EXPECT_NEAR(longAfter(0.5), at_once, 0.02);  // within 0.01 each is at rest
}

// A wind as strong as before from elsewhere turns what rests: it lies along the new one, as long as if there
// had been no other.
TEST(DropShape, restingDropsTurnWithTheWind) {
  const auto lies = [](std::initializer_list<glm::dvec3> winds_mps) {
    DropScene scene(1e-6, glass::Glass::dirty);
    scene.place(0.0, 0.0, 2.5e-3, rad(40));
    const glm::vec2 start = scene.sim->snapshot()->drops.at(0).position_m;
    glass::PaneTick tick = weather(0.0);
    for (const glm::dvec3& wind_mps : winds_mps) {
      tick.air_mps = wind_mps;
      scene.run(tick, 0.5);
    }
    const shared::GlassDropRecord drop = scene.sim->snapshot()->drops.at(0);
    EXPECT_EQ(drop.position_m, start);
    return drop;
  };
  constexpr glm::dvec3 kAhead_mps{-7.0, 0.0, 0.0}, kAside_mps{0.0, 7.0, 0.0};
  const shared::GlassDropRecord ahead = lies({kAhead_mps}), aside = lies({kAside_mps}),
                                turned = lies({kAhead_mps, kAside_mps});
  EXPECT_GT(aside.elongation, 1.15f);
  EXPECT_LT(std::abs(glm::dot(ahead.heading, aside.heading)), 0.1f);
  EXPECT_GT(std::abs(glm::dot(turned.heading, aside.heading)), 0.99f);
  // Within 0.01 each is at rest; as it turned it stood more broadly in the wind, and it is pinned.
  EXPECT_NEAR(turned.elongation, aside.elongation, 0.04);
}

struct Shape {
  double elongation, corner, way_m;
  glm::dvec2 heading;  // of its head
};

// A drop on a level pane that is pulled along it for some time.
Shape pulled(glass::Glass glass, glm::dvec2 along_mps2, double seconds) {
  DropScene scene(1e-6, glass);
  scene.place(0.0, 0.0, 3.5e-3, glass::meanAngle(glass::surfaceOf(glass)) + 0.05);
  const glm::vec2 start = scene.sim->snapshot()->drops.at(0).position_m;
  glass::PaneTick tick = weather(0.0);
  tick.acceleration_mps2 = {along_mps2.x, along_mps2.y, -9.81};
  scene.run(tick, seconds);
  const shared::GlassDropRecord drop = scene.sim->snapshot()->drops.at(0);
  const float sign = drop.corner < 0.0f ? -1.0f : 1.0f;
  return {static_cast<double>(drop.elongation), static_cast<double>(sign * drop.corner),
          static_cast<double>(glm::distance(drop.position_m, start)), glm::dvec2(sign * drop.heading)};
}

TEST(DropShape, isTheSameWhicheverWayItRuns) {
  const Shape one = pulled(glass::Glass::dirty, {9.0, 0.0}, 0.1);
  EXPECT_GT(one.corner, 0.5);
  EXPECT_GT(one.elongation, 1.5);
  for (const glm::dvec2 way :
       {glm::dvec2(-1.0, 0.0), glm::dvec2(0.0, 1.0), glm::dvec2(0.0, -1.0), glm::dvec2(0.6, 0.8)}) {
    const Shape other = pulled(glass::Glass::dirty, 9.0 * way, 0.1);
    EXPECT_NEAR(other.elongation, one.elongation, 1e-4);
    EXPECT_NEAR(other.corner, one.corner, 1e-4);
    EXPECT_NEAR(other.way_m, one.way_m, 1e-5);
    EXPECT_NEAR(glm::dot(other.heading, one.heading), way.x,
                1e-3);  // grid axes are the pane's, perhaps swapped
  }
}

// Its tail recedes faster on coated glass than it ever runs: no corner there.
TEST(DropShape, onlyTailsThatAreLeftBehindArePointed) {
  EXPECT_GT(pulled(glass::Glass::uncoated, {9.0, 0.0}, 0.15).corner, 0.9);
  const Shape coated = pulled(glass::Glass::coated, {9.0, 0.0}, 0.05);
  EXPECT_GT(coated.way_m, 1e-3);
  EXPECT_EQ(coated.corner, 0.0);
}

// Pearls lie behind the drop that sheds them, whichever end of its base's axis the heading points to.
TEST(DropShape, pearlsLieBehindTheTail) {
  float headings = 0.0f;
  for (const double way : {1.0, -1.0}) {
    DropScene scene(1e-6, glass::Glass::dirty);
    scene.place(0.0, 0.0, 5e-3, rad(45));
    glass::PaneTick tick = weather(0.0);
    tick.acceleration_mps2 = {0.0, way * 9.0, -9.81};
    size_t pearls = 0;
    while (scene.index < 60) {
      scene.run(tick, kTickSeconds);
      const std::vector<shared::GlassDropRecord> seen = scene.sim->snapshot()->drops;
      const shared::GlassDropRecord& head = seen.at(0);
      for (size_t i = 1; i < seen.size(); ++i)
        EXPECT_LT(glm::dot(seen[i].position_m - head.position_m, head.velocity_mps), 0.0f) << scene.index;
      EXPECT_GE(seen.size(), pearls + 1) << "ran over one of its own";
      pearls = seen.size() - 1;
      if (scene.index == 60) headings += glm::dot(head.heading, glm::normalize(head.velocity_mps));
    }
    EXPECT_GT(pearls, 3u);
  }
  EXPECT_NEAR(headings, 0.0f, 1e-3f) << "both senses are to be tried";
}

// No step of a tick is greater than what a contact line that runs ahead at its own speed and the drop's does
// in it.
TEST(DropShape, comesByAndBy) {
  double before = 1.0, corner_before = 0.0;
  const glass::Surface surface = glass::surfaceOf(glass::Glass::dirty);
  DropScene scene(rad(60), glass::Glass::dirty);
  scene.place(0.0, 0.15, 5e-3, rad(45));
  for (int i = 0; i < 40; ++i) {
    scene.run(weather(0.0), kTickSeconds);
    const shared::GlassDropRecord drop = scene.sim->snapshot()->drops.at(0);
    const double speed =
        static_cast<double>(glm::length(drop.velocity_mps)) + glass::lineSpeed_mps(surface.advancing_rad);
    const double most =
        1.0 - std::exp(-kTickSeconds * speed / static_cast<double>(drop.base_radius_m)) + 1e-3;
    EXPECT_LE(std::abs(static_cast<double>(drop.elongation) - before),
              most * 2.0);  // of a way of less than 2
    EXPECT_LE(std::abs(std::abs(static_cast<double>(drop.corner)) - corner_before), most);
    before = static_cast<double>(drop.elongation);
    corner_before = std::abs(static_cast<double>(drop.corner));
  }
  EXPECT_GT(before, 1.8);
  EXPECT_GT(corner_before, 0.8);
}

}  // namespace
}  // namespace rg::test
