// How long and how pointed drops become, at rest and as they run, and what they leave behind.
#include "glass/drop_shape.h"

#include <gtest/gtest.h>

#include "drop_scene.h"
#include "glass/water.h"
#include "shared/optics_drop.glsl"

namespace rg::test {
namespace {

// A drop as it is drawn: of a base that has the area of a circle of radius 1.
struct Drawn {
  Drawn(double volume, double elongation, double corner) {
    const double across = 1.0 / std::sqrt(elongation);
    cap = shared::capOfDrop(static_cast<float>(glass::capHeight(volume, 1.0, elongation) / across),
                            static_cast<float>(elongation), static_cast<float>(corner));
    half_width = across / std::sqrt(static_cast<double>(shared::tailedArea(cap.tail)));
    tail = static_cast<double>(cap.tail);
  }
  // Half of how wide it is there, and x from its tail's end to its head: 0 .. 1 at even angles, as its
  // outline comes in steeply at its ends.
  double halfAt(double x) const {
    const double outline =
        static_cast<double>(shared::outlineAt(cap, glm::vec2(static_cast<float>(x), 0.0f)));
    return std::sqrt(std::max(1.0 - outline * outline, 0.0));
  }
  double along(double share) const { return 0.5 * (1.0 - tail) - 0.5 * (1.0 + tail) * std::cos(kPi * share); }

  shared::Cap cap;
  double half_width, tail;
};

const std::vector<std::pair<double, double>> kShapes = {{1.0, 0.0},  {1.3, 0.0}, {2.4, 0.0}, {1.1, 1.0},
                                                        {1.25, 1.0}, {1.5, 1.0}, {1.5, 0.6}, {1.7, 0.3}};

// What is drawn over a base of any length and tail, summed up slice by slice, is the drop's volume.
TEST(DropShape, anyOutlineHoldsTheSameVolumeOnTheSameArea) {
  for (const double angle : {rad(15), rad(40), rad(60)}) {
    for (const auto& [elongation, corner] : kShapes) {
      const double volume = glass::capShape(angle);
      const Drawn drawn(volume, elongation, corner);
      constexpr int kSlices = 400;
      const double centre = static_cast<double>(drawn.cap.centre_z);
      double sum = 0.0, base = 0.0;
      for (int i = 0; i < kSlices; ++i) {
        const double dx = drawn.along((i + 1.0) / kSlices) - drawn.along(i / static_cast<double>(kSlices));
        const double half = drawn.halfAt(drawn.along((i + 0.5) / kSlices));
        // Of a circle that is so wide at the glass, what is above it.
        const double r = std::hypot(half, centre), at_glass = std::acos(std::clamp(-centre / r, -1.0, 1.0));
        sum += r * r * (at_glass - std::sin(at_glass) * std::cos(at_glass)) * dx;
        base += 2.0 * half * dx;
      }
      const double scale = static_cast<double>(drawn.cap.stretch) * drawn.half_width * drawn.half_width;
      SCOPED_TRACE(std::to_string(angle) + " rad, " + std::to_string(elongation) + " long, corner " +
                   std::to_string(corner));
      EXPECT_NEAR(base * scale / kPi, 1.0, 2e-3);
      EXPECT_NEAR(sum * scale * drawn.half_width / volume, 1.0, corner > 0.0 ? 1.2e-2 : 1e-3);
    }
  }
}

TEST(DropShape, oneThatOverhangsItsBaseHoldsItsVolumeWithoutATail) {
  for (const double elongation : {1.0, 1.5, 2.4}) {
    const double volume = glass::capShape(rad(100));
    const Drawn drawn(volume, elongation, 1.0);
    EXPECT_EQ(drawn.cap.tail, 1.0f);
    const double angle = std::acos(-static_cast<double>(drawn.cap.centre_z / drawn.cap.radius));
    EXPECT_NEAR(elongation * std::pow(drawn.half_width, 3.0) * glass::capShape(angle) / volume, 1.0, 1e-4);
  }
}

// Broadest in its front half, round there, and narrower and narrower behind; its outline turns nowhere at
// once, not even where the tail begins or ends.
TEST(DropShape, oneThatRunsIsRoundAheadAndTapersSmoothlyBehind) {
  for (const auto& [elongation, corner] : kShapes) {
    if (corner == 0.0) continue;
    SCOPED_TRACE(std::to_string(elongation) + " long, corner " + std::to_string(corner));
    const Drawn drawn(glass::capShape(rad(40)), elongation, corner);
    const double head = static_cast<double>(drawn.cap.stretch), middle = 0.5 * (1.0 - drawn.tail);
    EXPECT_LE(head, 1.0 + (1.0 - corner) * (elongation - 1.0)) << "as long as it is broad";
    EXPECT_GT(drawn.tail, 1.0);
    constexpr int kSteps = 200;
    double broadest = 0.0, broadest_at = 0.0, front = 0.0, rear = 0.0, turned = 0.0;
    glm::dvec2 before(0.0, 1.0);  // at the tail's end it goes straight aside
    for (int i = 1; i <= kSteps; ++i) {
      const double from = drawn.along((i - 1.0) / kSteps), to = drawn.along(i / static_cast<double>(kSteps));
      const double half = drawn.halfAt(to);
      (0.5 * (from + to) > middle ? front : rear) += 0.5 * (half + drawn.halfAt(from)) * (to - from);
      if (half > broadest) broadest = half, broadest_at = to;
      const glm::dvec2 now = glm::normalize(glm::dvec2(head * (to - from), half - drawn.halfAt(from)));
      const double turn = std::atan2(before.x * now.y - before.y * now.x, glm::dot(before, now));
      EXPECT_LT(turn, 1e-3) << "hollow at " << to;
      EXPECT_GT(turn, rad(-9)) << "an edge at " << to;
      turned += turn;
      before = now;
    }
    EXPECT_NEAR(turned, -kPi, rad(9));
    EXPECT_GT(broadest_at, middle);
    EXPECT_GT(front, rear * (1.0 + 0.1 * corner * (drawn.tail - 1.0)));
    for (double x = 0.0; x < 1.0; x += 0.1) EXPECT_NEAR(drawn.halfAt(x), std::sqrt(1.0 - x * x), 1e-3);
  }
}

// Sides that leave the head as obliquely as the law of corners asks, sin phi = U_c / U, meet where the tail
// ends: of those that run it is as long as their speed says.
TEST(DropShape, theTailReachesAsFarAsTheCornerOfItsSpeed) {
  const glass::Surface surface = glass::surfaceOf(glass::Glass::dirty);
  const double receding_mps = glass::lineSpeed_mps(surface.receding_rad);
  int between = 0;
  for (const double pull_mps2 : {4.0, 6.8, 7.3, 7.6, 7.8, 9.0}) {
    DropScene scene(1e-6, glass::Glass::dirty);
    scene.place(0.0, 0.0, 3.5e-3, glass::meanAngle(surface) + 0.05);
    glass::PaneTick tick = weather(0.0);
    tick.acceleration_mps2 = {0.0, pull_mps2, -9.81};
    scene.run(tick, 0.3);
    const shared::GlassDropRecord drop = scene.sim->snapshot()->drops.at(0);
    const double faster = static_cast<double>(glm::length(drop.velocity_mps)) / receding_mps;
    const double height = static_cast<double>(drop.height_m / drop.base_radius_m) *
                          std::sqrt(static_cast<double>(drop.elongation));
    const shared::Cap cap =
        shared::capOfDrop(static_cast<float>(height), drop.elongation, std::abs(drop.corner));
    EXPECT_NEAR(static_cast<double>(cap.tail), std::clamp(faster, 1.0, 2.0), 0.08) << faster;
    if (cap.tail > 1.0f) {
      EXPECT_GT(drop.corner * glm::dot(drop.heading, drop.velocity_mps), 0.0f) << "its head is ahead";
    }
    between += faster > 1.1 && faster < 1.9 ? 1 : 0;
  }
  EXPECT_GE(between, 2);
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
  EXPECT_GT(one.elongation, 1.4);
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
  EXPECT_GT(before, 1.4);
  EXPECT_GT(corner_before, 0.8);
}

}  // namespace
}  // namespace rg::test
