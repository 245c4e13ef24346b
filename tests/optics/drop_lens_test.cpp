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

TEST(DropLens, aRayInsideStaysInside) {
  for (const float stretch : {1.0f, 2.5f}) {
    const Cap cap = capOf(1.4f, stretch);
    vec3 p(0.1f, -0.2f, 0.0f);
    vec3 d = glm::normalize(vec3(0.4f, 0.7f, 0.6f));
    for (int k = 0; k < 50; ++k) {
      const InnerHit hit = nextFace(cap, p, d);
      p = hit.position;
      d = glm::reflect(d, hit.normal);
      const vec3 o(p.x / stretch, p.y, p.z - cap.centre_z);
      ASSERT_GE(p.z, 0.0f);
      ASSERT_LE(glm::length(o), cap.radius * 1.001f);
    }
  }
}

}  // namespace
}  // namespace rg::test
