// Rays, and what they measure: how much sky is seen from a shelter.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "render/ray_tree.h"
#include "render/sky.h"
#include "render/sky_visibility.h"

namespace host {
namespace {

using Corners = std::vector<glm::vec3>;

void addQuad(Corners& corners, glm::vec3 a, glm::vec3 u, glm::vec3 v) {
  for (glm::vec3 p : {a, a + u, a + u + v, a, a + u + v, a + v}) corners.push_back(p);
}

/// Ground of 400 m and, above x in 0..60, a tube 8 m wide and 5 m high along x.
Corners tunnel() {
  Corners corners;
  addQuad(corners, {-200, -200, 0}, {400, 0, 0}, {0, 400, 0});
  addQuad(corners, {0, -4, 5}, {60, 0, 0}, {0, 8, 0});
  addQuad(corners, {0, -4, 0}, {60, 0, 0}, {0, 0, 5});
  addQuad(corners, {0, 4, 0}, {60, 0, 0}, {0, 0, 5});
  return corners;
}

std::vector<glm::vec3> boxPoints(glm::vec3 min, glm::vec3 max) {
  std::vector<glm::vec3> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
  return points;
}

TEST(RayTree, agreesWithTryingEveryTriangle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> at(-10.0F, 10.0F), step(-1.5F, 1.5F);
  Corners corners;
  for (int i = 0; i < 400; ++i) {
    const glm::vec3 a(at(random), at(random), at(random));
    for (glm::vec3 d : {glm::vec3(0.0F), glm::vec3(step(random), step(random), step(random)),
                        glm::vec3(step(random), step(random), step(random))}) {
      corners.push_back(a + d);
    }
  }
  const RayTree tree(corners);
  int hits = 0;
  for (int ray = 0; ray < 1000; ++ray) {
    const glm::vec3 from(at(random), at(random), at(random));
    const glm::vec3 to = glm::normalize(glm::vec3(step(random), step(random), step(random)));
    float nearest = 30.0F;
    for (std::size_t i = 0; i < corners.size(); i += 3)
      nearest = RayTree({corners[i], corners[i + 1], corners[i + 2]}).nearest(from, to, nearest);
    EXPECT_FLOAT_EQ(tree.nearest(from, to, 30.0F), nearest);
    hits += nearest < 30.0F;
  }
  EXPECT_GT(hits, 100);  // else nothing was tested
}

TEST(SkyGrid, isTheOpenSkyAboveLevelGround) {
  Corners ground;
  addQuad(ground, {-200, -200, 0}, {400, 0, 0}, {0, 400, 0});
  const SkyGrid grid = measureSky(RayTree(ground), boxPoints({-5, -3, 3}, {5, 3, 8}), 3.0F, 1.0F);
  const glm::vec4 light = grid.at({0, 0, 5});
  // The CIE overcast sky's mean and gradient over the upper half; the ground below sends up 0.12 * 7/9 / 2 of
  // the zenith.
  EXPECT_NEAR(light.x, kOpenSky.x + 0.047F, 0.03F);
  EXPECT_NEAR(light.w, kOpenSky.w - 0.07F, 0.04F);
  EXPECT_NEAR(light.y, 0.0F, 0.02F);
}

TEST(SkyGrid, isDarkDeepInATunnelAndBrightAtItsMouth) {
  const SkyGrid grid = measureSky(RayTree(tunnel()), boxPoints({0, -4, 0.05F}, {60, 4, 4.95F}), 3.0F, 3.0F);
  const float deep = grid.at({30, 0, 1.5F}).x, near_mouth = grid.at({2, 0, 1.5F}).x;
  EXPECT_LT(deep, 0.1F * kOpenSky.x);
  EXPECT_GT(near_mouth, 4.0F * deep);
  EXPECT_LT(grid.at({2, 0, 1.5F}).y, 0.0F);  // the light comes from the mouth, which is at lesser x
  EXPECT_FLOAT_EQ(grid.share({30, 0, 2}), 1.0F);
  EXPECT_FLOAT_EQ(grid.share({30, 20, 2}), 0.0F);
}

TEST(SkyGrid, followsAShelterThatLiesAskew) {
  std::vector<glm::vec3> points = boxPoints({0, -4, 0}, {60, 4, 5});
  const float c = std::cos(0.6F), s = std::sin(0.6F);
  for (glm::vec3& p : points) p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
  const SkyGrid grid = measureSky(RayTree({}), points, 3.0F, 1.0F);
  EXPECT_FLOAT_EQ(grid.share({30 * c, 30 * s, 2}), 1.0F);
  EXPECT_FLOAT_EQ(grid.share({30 * c + 8 * s, 30 * s - 8 * c, 2}),
                  0.0F);  // 8 m to its side: an upright box along the axes would hold it
}

TEST(Sky, extinctionIsKoschmiedersAndLeavesTheRainsToThePlugin) {
  Sky sky;
  sky.visibility_m = 3912.0;
  EXPECT_NEAR(extinction(sky), 1e-3, 1e-12);
  sky.rain_mm_h = 100.0;
  EXPECT_NEAR(extinction(sky), 1e-3, 1e-12);
}

TEST(Sky, rainHidesTheSunAndDarkensTheSky) {
  Sky fair, drizzle, downpour;
  drizzle.rain_mm_h = 1.0;
  downpour.rain_mm_h = 50.0;
  EXPECT_GT(sunIrradiance(fair).y, 50.0F);
  EXPECT_EQ(sunIrradiance(drizzle).y, 0.0F);
  EXPECT_GT(overcastZenith(drizzle), 2.0 * overcastZenith(downpour));
}

Sky withSunAt(double elevation_deg) {
  Sky sky;
  const auto up = static_cast<float>(elevation_deg * 3.14159265 / 180.0);
  sky.to_sun = {std::cos(up), 0.0F, std::sin(up)};
  return sky;
}

// Against the almanac's own figures for level ground: 3.4 lx at the end of civil twilight, 759 lx when the
// sun is on the horizon, 129 klx when it stands overhead.
TEST(Sky, isAsBrightAsTheSunIsHigh) {
  const double at35 = daylight(withSunAt(90.0)) / 129e3;
  EXPECT_NEAR(daylight(withSunAt(0.0)) / at35, 759.0, 10.0);
  EXPECT_NEAR(daylight(withSunAt(-6.0)) / at35, 3.4, 0.2);
  EXPECT_NEAR(daylight(withSunAt(35.0)), 1.0, 1e-4);
  double higher = daylight(withSunAt(90.0));
  for (double elevation_deg = 89.0; elevation_deg >= -40.0; elevation_deg -= 0.5) {
    const double here = daylight(withSunAt(elevation_deg));
    EXPECT_LE(here, higher * 1.03) << elevation_deg;  // ranges of the law meet within 3 %
    higher = here;
  }
  EXPECT_GT(higher, 0.0);
}

TEST(Sky, hasNoSunOnceItHasSet) {
  EXPECT_GT(sunIrradiance(withSunAt(5.0)).x, 0.0F);
  EXPECT_LT(sunIrradiance(withSunAt(5.0)).x, sunIrradiance(withSunAt(35.0)).x);
  EXPECT_EQ(sunIrradiance(withSunAt(-1.0)).x, 0.0F);
}

TEST(Sky, letsStreetLampsShineAsTheyAreByNight) {
  EXPECT_NEAR(streetLampGain(withSunAt(35.0)), 10.0F, 1e-3F);
  EXPECT_NEAR(streetLampGain(withSunAt(-20.0)), 1.0F, 0.15F);
}

}  // namespace
}  // namespace host
