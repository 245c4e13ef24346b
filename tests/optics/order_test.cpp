// In what order panes are drawn, and when what lies behind one has to be looked at anew.
#include <gtest/gtest.h>

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "glass/look_order.h"

namespace rg::test {
namespace {

glass::LookPane paneAt(glm::vec3 centre_m, float radius_m) {
  glass::LookPane pane;
  pane.centre_m = centre_m;
  pane.radius_m = radius_m;
  return pane;
}

glass::LookView lookingAlongX(const glm::dvec3& eye_m) {
  glass::LookView view;
  view.eyeFromWorld = glm::lookAt(eye_m, eye_m + glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 1.0));
  view.clipFromEye = glm::perspective(0.8, 1.6, 0.1, 100.0);
  return view;
}

TEST(PaneOrder, leavesOutPanesBehindTheEyeAndBeside) {
  const std::array panes{paneAt({1.0f, 0.0f, 0.0f}, 0.5f), paneAt({-3.0f, 0.0f, 0.0f}, 0.5f),
                         paneAt({2.0f, 9.0f, 0.0f}, 0.5f)};
  const auto seen = glass::seenPanes(panes, lookingAlongX({0.0, 0.0, 0.0}));
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_EQ(seen[0].pane, &panes[0]);
}

TEST(PaneOrder, drawsTheFarPaneFirstAndLooksAnewBehindTheNear) {
  // Through the windscreen of a car seen from its front: its rear window.
  const std::array panes{paneAt({3.0f, 0.0f, 0.0f}, 0.8f), paneAt({6.0f, 0.0f, 0.2f}, 0.7f)};
  const auto seen = glass::seenPanes(panes, lookingAlongX({0.0, 0.0, 0.0}));
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].pane, &panes[1]);
  EXPECT_TRUE(glass::liesBehind(seen[0], seen[1]));
  EXPECT_FALSE(glass::liesBehind(seen[1], seen[0]));
}

TEST(PaneOrder, onePictureDoesForPanesAroundTheDriver) {
  const std::array panes{paneAt({0.7f, 0.0f, 0.2f}, 0.85f), paneAt({0.3f, 0.6f, 0.0f}, 0.5f)};
  const auto seen = glass::seenPanes(panes, lookingAlongX({0.0, 0.0, 0.0}));
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_FALSE(glass::liesBehind(seen[0], seen[1]));
}

TEST(PaneOrder, panesSideBySideAreNotBehindEachOther) {
  const std::array panes{paneAt({20.0f, 6.0f, 0.0f}, 0.5f), paneAt({10.0f, -3.0f, 0.0f}, 0.5f)};
  const auto seen = glass::seenPanes(panes, lookingAlongX({0.0, 0.0, 0.0}));
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_FALSE(glass::liesBehind(seen[0], seen[1]));
}

}  // namespace
}  // namespace rg::test
