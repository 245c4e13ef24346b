#include "gl/loader.h"

#include <gtest/gtest.h>

#include <cstring>

#include "gl_fixture.h"

namespace rg::gl {
namespace {

using test::GlContext;
using test::Profile;

std::string refusal(GetProc getProc, void* user) {
  try {
    loadContext(getProc, user);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::kVersion);
    return error.what();
  }
  return "(it was loaded)";
}

class Loader : public test::GlProfileTest {};
INSTANTIATE_TEST_SUITE_P(Profiles, Loader, test::bothProfiles(), test::profileName);

TEST_P(Loader, loadsBothProfilesAndTellsThemApart) {
  const auto loaded = loadContext(GlContext::getProc, nullptr);
  EXPECT_EQ(loaded->compatibility, GetParam() == Profile::kCompatibility);
  EXPECT_FALSE(loaded->renderer.empty());
  EXPECT_EQ(loaded->software, isSoftwareRenderer(loaded->renderer));
}

TEST_P(Loader, handsTheHostItsUserPointer) {
  int user = 0;
  const auto counting = [](void* counter, const char* name) -> void* {
    ++*static_cast<int*>(counter);
    return GlContext::getProc(nullptr, name);
  };
  loadContext(counting, &user);
  EXPECT_GT(user, 500);  // GL 4.5 has more functions than that
}

TEST_P(Loader, refusesALoaderThatLacksAFunction) {
  const auto lacking = [](void*, const char* name) -> void* {
    return std::strcmp(name, "glClipControl") == 0 ? nullptr : GlContext::getProc(nullptr, name);
  };
  EXPECT_NE(refusal(lacking, nullptr).find("get_proc gives null"), std::string::npos);
}

TEST(LoaderVersion, saysWhatWasFoundInsteadOf45) {
  const GlContext old(Profile::kCore, 3, 3);
  const auto claimed = [](void*, const char* name) -> void* {
    // Mesa gives its newest version whatever was asked for, so the test answers for an older driver.
    static constexpr auto kAnswer = [](GLenum what) -> const GLubyte* {
      static const GladGLContext& gl = [&]() -> const GladGLContext& {
        static GladGLContext real{};
        gladLoadGLContextUserPtr(
            &real,
            [](void*, const char* n) {
              return reinterpret_cast<GLADapiproc>(GlContext::getProc(nullptr, n));
            },
            nullptr);
        return real;
      }();
      return what == GL_VERSION ? reinterpret_cast<const GLubyte*>("3.3.0 Old Driver 1.0")
                                : gl.GetString(what);
    };
    if (std::strcmp(name, "glGetString") == 0) {
      return reinterpret_cast<void*>(static_cast<const GLubyte* (*)(GLenum)>(kAnswer));
    }
    return GlContext::getProc(nullptr, name);
  };
  const std::string text = refusal(claimed, nullptr);
  EXPECT_NE(text.find("OpenGL 4.5 is needed; found OpenGL 3.3.0 Old Driver 1.0"), std::string::npos) << text;
}

TEST(LoaderVersion, refusesALoaderThatKnowsNothing) {
  const auto nothing = [](void*, const char*) -> void* { return nullptr; };
  EXPECT_NE(refusal(nothing, nullptr).find("glGetString"), std::string::npos);
}

TEST(LoaderVersion, knowsSoftwareRenderersByName) {
  EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(isSoftwareRenderer("softpipe"));
  EXPECT_TRUE(isSoftwareRenderer("Google SwiftShader"));
  EXPECT_FALSE(isSoftwareRenderer("NVIDIA GeForce RTX 4090/PCIe/SSE2"));
  EXPECT_FALSE(isSoftwareRenderer("AMD Radeon RX 7900 XT (radeonsi, navi31, LLVM 15.0.6)"));
}

}  // namespace
}  // namespace rg::gl
