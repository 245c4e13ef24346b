// The cap's geometry and Fresnel's equations, as CPU and GPU both use them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shared/optics_drop.glsl"

namespace rg::test {
namespace {

using namespace rg::shared;

TEST(Fresnel, isTwoPercentForWaterHeadOnAndWholeBeyondTheCriticalAngle) {
  EXPECT_NEAR(fresnel(1.0f, kWaterIndex), 0.0204, 1e-4);  // ((n - 1) / (n + 1))^2
  const float critical = std::sqrt(1.0f - 1.0f / (kWaterIndex * kWaterIndex));
  EXPECT_EQ(fresnel(critical * 0.999f, 1.0f / kWaterIndex), 1.0f);
  EXPECT_LT(fresnel(critical * 1.02f, 1.0f / kWaterIndex), 0.9f);
}

TEST(Fresnel, isTheSameFromBothSidesOfAFace) {
  for (float cosine = 0.05f; cosine <= 1.0f; cosine += 0.05f) {
    const float inner = std::sqrt(1.0f - (1.0f - cosine * cosine) / (kWaterIndex * kWaterIndex));
    EXPECT_NEAR(fresnel(cosine, kWaterIndex), fresnel(inner, 1.0f / kWaterIndex), 1e-5);  // Stokes' relations
  }
}

TEST(DropLens, focusesAtRadiusOverIndexLessOne) {
  for (const double angle_deg : {20.0, 40.0, 70.0, 90.0}) {
    const Cap cap = capOf(static_cast<float>(glm::radians(angle_deg)), 1.0f);
    const float aside = 0.01f;  // near the axis, where the lens is ideal
    const InnerHit hit = nextFace(cap, vec3(aside, 0.0f, 0.0f), vec3(0.0f, 0.0f, 1.0f));
    const vec3 out = glm::refract(vec3(0.0f, 0.0f, 1.0f), -hit.normal, kWaterIndex);
    const float focus = aside / (-out.x / out.z);
    EXPECT_NEAR(focus / cap.radius, 1.0 / 0.333, 0.02) << angle_deg;
  }
}

TEST(DropLens, meetsTheGlassInItsContactCircleAtTheContactAngle) {
  for (const double angle_deg : {10.0, 60.0, 90.0, 130.0}) {
    const Cap cap = capOf(static_cast<float>(glm::radians(angle_deg)), 1.0f);
    const vec3 normal = capNormal(cap, vec3(1.0f, 0.0f, 0.0f));
    EXPECT_NEAR(static_cast<double>(normal.z), std::cos(glm::radians(angle_deg)), 1e-5) << angle_deg;
  }
}

// What is 0 on a cap's surface, less within.
float surfaceAt(const Cap& cap, const vec3& p) {
  const vec3 o(p.x / cap.stretch, p.y, p.z - cap.centre_z);
  const float behind = std::min(o.x - cap.tail_from, 0.0f);
  return glm::dot(o, o) - cap.radius * cap.radius - cap.tail_grows * behind * behind;
}

TEST(DropLens, aRayInsideStaysInside) {
  for (const Cap& cap : {capOf(1.4f, 1.0f), capOf(1.4f, 2.5f), capOfDrop(0.5f, 1.5f, 1.0f),
                         capOfDrop(0.7f, 1.8f, 1.0f), capOfDrop(0.2f, 1.3f, 0.5f)}) {
    vec3 p(0.1f, -0.2f, 0.0f);
    vec3 d = glm::normalize(vec3(-0.4f, 0.7f, 0.6f));
    for (int k = 0; k < 200; ++k) {
      const InnerHit hit = nextFace(cap, p, d);
      p = hit.position;
      d = glm::reflect(d, hit.normal);
      ASSERT_GE(p.z, 0.0f);
      ASSERT_LE(surfaceAt(cap, p), 2e-3f * cap.radius * cap.radius) << k;
      if (p.z > 0.0f) {
        ASSERT_GE(surfaceAt(cap, p), -2e-3f * cap.radius * cap.radius) << k;
      }
      ASSERT_GT(p.x, -1.001f * cap.stretch * cap.tail);
    }
  }
}

// From all sides, also where it meets the tail's ellipsoid ahead of the tail only.
TEST(DropLens, aLineMeetsTheCapWhereItsSurfaceIs) {
  for (const Cap& cap :
       {capOfDrop(0.3f, 1.5f, 1.0f), capOfDrop(0.7f, 1.8f, 1.0f), capOfDrop(0.4f, 1.4f, 0.5f)}) {
    int hits = 0, in_tail = 0;
    for (int k = 0; k < 4000; ++k) {
      const float turn = 2.399963f * static_cast<float>(k),
                  rise = (static_cast<float>(k % 97) + 0.5f) / 97.0f;
      const float flat = std::sqrt(1.0f - rise * rise);
      const vec3 d(flat * std::cos(turn), flat * std::sin(turn), -rise);  // from outside, down to the glass
      const vec3 p(cap.stretch * (-0.5f * (cap.tail - 1.0f) +
                                  0.6f * (1.0f + cap.tail) * std::sin(0.37f * static_cast<float>(k))),
                   1.1f * std::sin(1.7f * static_cast<float>(k)), 0.0f);
      // The first place along the line above the glass that is inside.
      float first = 1.0f;
      for (float t = -4.0f; t < 0.0f; t += 0.01f) {
        const vec3 at = p + t * d;
        if (surfaceAt(cap, at) > 0.0f) continue;
        first = t;
        break;
      }
      const vec3 meet = meetCap(cap, p, d);
      const bool met = meet.z > 0.0f && meet.x < 0.0f;
      if (first < -0.05f || met) {
        if (met) {
          EXPECT_NEAR(surfaceAt(cap, p + meet.x * d), 0.0f, 5e-3f) << k;
        }
        if (met && first > 0.0f) continue;  // by less than a step
        ASSERT_TRUE(met) << k << " at " << first;
        EXPECT_NEAR(meet.x, first, 0.011f) << k;
        ++hits;
        in_tail += (p + meet.x * d).x < cap.stretch * cap.tail_from ? 1 : 0;
      }
    }
    EXPECT_GT(hits, 500);
    EXPECT_GT(in_tail, 200);
  }
}

// Along its ridge and beside it: where the head goes over into the tail they stand hardly otherwise than the
// surface, and nowhere does what is seen through it have a bend.
TEST(DropLens, normalsOfADropWithATailAreItsSurfacesAndTurnByAndBy) {
  const Cap cap = capOfDrop(0.4f, 1.5f, 1.0f);
  constexpr float kStep = 0.02f;
  for (const float aside : {0.0f, 0.3f}) {
    vec3 before(0.0f), turn_before(0.0f);
    int places = 0;
    for (float x = -0.9f * cap.tail; x < 0.9f; x += kStep) {
      const vec3 above(cap.stretch * x, aside, 2.0f), down(0.0f, 0.0f, -1.0f);
      const vec3 meet = meetCap(cap, above, down);
      const vec3 at = above + meet.x * down;
      if (meet.z < 0.0f || at.z < 0.02f) continue;
      const auto slope = [&](const vec3& way) {
        return surfaceAt(cap, at + 1e-2f * way) - surfaceAt(cap, at - 1e-2f * way);
      };
      const vec3 surface = glm::normalize(
          vec3(slope({1.0f, 0.0f, 0.0f}), slope({0.0f, 1.0f, 0.0f}), slope({0.0f, 0.0f, 1.0f})));
      const vec3 normal = capNormal(cap, at);
      const float from_tail = std::abs(x - cap.tail_from);
      EXPECT_LT(glm::distance(normal, surface), from_tail > kBlend ? 2e-3f : 0.16f) << x;
      const vec3 turn = normal - before;
      if (places > 1) {
        EXPECT_LT(glm::distance(turn, turn_before), 2e-3f) << x;
      }
      before = normal, turn_before = turn;
      ++places;
    }
    EXPECT_GT(places, 80);
  }
}

}  // namespace
}  // namespace rg::test
