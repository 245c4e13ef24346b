// GoogleTest fixtures that give each test a fresh context and fail it when the driver had something to
// complain about.
#pragma once

#include <gtest/gtest.h>

#include "gl_context.h"

namespace rg::test {

inline std::string describe(const std::vector<GlMessage>& messages) {
  std::string all;
  for (const GlMessage& message : messages) all += message.text + "\n";
  return all;
}

class GlTest : public ::testing::Test {
 protected:
  void TearDown() override { EXPECT_EQ(describe(context.takeMessages()), ""); }
  GlContext context;
  GladGLContext& gl = context.gl;
};

// The same in core and compatibility: INSTANTIATE_TEST_SUITE_P(Profiles, MyTest, bothProfiles(),
// profileName).
class GlProfileTest : public ::testing::TestWithParam<Profile> {
 protected:
  void TearDown() override { EXPECT_EQ(describe(context.takeMessages()), ""); }
  GlContext context{GetParam()};
  GladGLContext& gl = context.gl;
};

inline auto bothProfiles() { return ::testing::Values(Profile::kCore, Profile::kCompatibility); }
inline std::string profileName(const ::testing::TestParamInfo<Profile>& info) {
  return info.param == Profile::kCore ? "Core" : "Compatibility";
}

}  // namespace rg::test
