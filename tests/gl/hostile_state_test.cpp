// The host's state survives the plugin, whatever it was; and this test would notice each single thing that
// did not.
#include <gtest/gtest.h>

#include <functional>

#include "gl/objects.h"
#include "gl/pending_error.h"
#include "gl/program.h"
#include "gl/state_guard.h"
#include "gl_fixture.h"
#include "odd_state.h"
#include "picture.h"
#include "state_snapshot.h"

namespace rg::gl {
namespace {

using test::OddState;
using test::takeSnapshot;

constexpr uint32_t kAll = (RG_TOUCHED_PIXEL_STORE << 1) - 1;
// What the plugin has to itself inside a guard.
constexpr test::OddScope kOurs{false,        kTextureUnits, kImageUnits, kUniformBindings, kStorageBindings,
                               kDrawBuffers, kViewports};

class HostileState : public test::GlProfileTest {
 protected:
  HostileState() : loaded(loadContext(test::GlContext::getProc, nullptr)), odd(gl, GetParam()) {}

  // The host's variant, the guard, all the mess the plugin may make, and what differs after.
  std::string differenceAfterGuard(
      size_t host_variant, const std::function<void()>& before_restoring = [] {}) {
    odd.resetDrawBuffers();
    odd.apply(host_variant);
    const test::Snapshot before = takeSnapshot(gl, GetParam());
    {
      StateGuard guard(*loaded, kAll);
      guard.drawInto(odd.framebuffer(host_variant));
      guard.readFrom(odd.framebuffer(1 - host_variant));
      odd.apply(1 - host_variant, kOurs);
      before_restoring();
    }
    return test::difference(before, takeSnapshot(gl, GetParam()));
  }

  std::unique_ptr<Context> loaded;
  OddState odd;
};
INSTANTIATE_TEST_SUITE_P(Profiles, HostileState, test::bothProfiles(), test::profileName);

TEST_P(HostileState, isLeftAsFound) {
  EXPECT_EQ(differenceAfterGuard(0), "");
  EXPECT_EQ(differenceAfterGuard(1), "");
}

TEST_P(HostileState, ofAFreshContextIsLeftAsFound) {
  const test::Snapshot before = takeSnapshot(gl, GetParam());
  for (size_t variant = 0; variant < 2; ++variant) {
    const StateGuard guard(*loaded, kAll);
    odd.apply(variant, kOurs);
  }
  EXPECT_EQ(test::difference(before, takeSnapshot(gl, GetParam())), "");
}

TEST_P(HostileState, isAsSetInTheFirstPlace) {
  // Were the two variants alike anywhere, the comparison there would prove nothing. What only the host may
  // touch is left out.
  odd.apply(0);
  const test::Snapshot first = takeSnapshot(gl, GetParam());
  odd.apply(1);
  const std::string changed = test::difference(first, takeSnapshot(gl, GetParam()));
  for (const char* name : {"GL_CURRENT_PROGRAM", "GL_TEXTURE_BINDING_3D[7]", "GL_IMAGE_BINDING_LAYERED[3]",
                           "BLEND[0]", "GL_CLIP_ORIGIN", "GL_UNIFORM_BUFFER_START[1]", "GL_VIEWPORT[0]",
                           "GL_DEPTH_RANGE[0]", "GL_PACK_SKIP_IMAGES", "GL_SAMPLE_MASK:"}) {
    EXPECT_NE(changed.find(name), std::string::npos) << name;
  }
}

TEST_P(HostileState, isNotReadOrSetWhereTheHostResetsIt) {
  odd.apply(0);
  StateGuard guard(*loaded, kAll, true);
  EXPECT_EQ(guard.touched(), kAll);
  EXPECT_FALSE(gl.IsEnabled(GL_CULL_FACE));
}

TEST_P(HostileState, outsideTheMaskIsNotTouched) {
  odd.apply(0);
  const test::Snapshot before = takeSnapshot(gl, GetParam());
  const StateGuard guard(*loaded, 0);
  EXPECT_EQ(test::difference(before, takeSnapshot(gl, GetParam())), "");
}

// ---- the picture: in our state a draw comes out right whatever the host had set ----

std::string_view drawFiles(std::string_view path) {
  if (path == "all.vert") {
    return "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.5, 1.0); "
           "}\n";
  }
  if (path == "all.frag")
    return "layout(location = 0) out vec4 color;\nvoid main() { color = vec4(2.0, 0.25, -1.0, 0.5); }\n";
  return {};
}

TEST_P(HostileState, doesNotShowInWhatIsDrawn) {
  for (size_t variant = 0; variant < 2; ++variant) {
    odd.resetDrawBuffers();
    const Texture2D color(gl, GL_RGBA16F, 16, 16);
    const Framebuffer target(gl, {&color});
    const Program program(gl, {"all.vert", "all.frag"}, {}, drawFiles);
    const VertexArray empty(gl);
    odd.apply(variant);
    {
      StateGuard guard(*loaded, kAll);
      guard.drawInto(target.name());
      gl.ViewportIndexedf(0, 0.0f, 0.0f, 16.0f, 16.0f);
      gl.BindVertexArray(empty.name());
      program.use();
      gl.DrawArrays(GL_TRIANGLES, 0, 3);
      const test::Picture picture = test::readTexture(gl, color.name());
      for (const glm::vec4& pixel : picture.pixels)
        ASSERT_EQ(pixel, glm::vec4(2.0f, 0.25f, -1.0f, 0.5f)) << "variant " << variant;
    }
  }
}

// ---- pending errors ----

TEST_P(HostileState, ofErrorsIsGivenBackAfter) {
  for (const GLenum error : {GLenum{GL_INVALID_ENUM}, GLenum{GL_INVALID_VALUE}, GLenum{GL_INVALID_OPERATION},
                             GLenum{GL_INVALID_FRAMEBUFFER_OPERATION}, GLenum{GL_STACK_OVERFLOW},
                             GLenum{GL_STACK_UNDERFLOW}, GLenum{GL_OUT_OF_MEMORY}}) {
    const test::Snapshot before = takeSnapshot(gl, GetParam());
    raiseError(*loaded, error);
    {
      const StateGuard guard(*loaded, kAll);
      EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR))
          << "the plugin would take the host's error for its own";
    }
    EXPECT_EQ(gl.GetError(), error) << errorName(error);
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(test::difference(before, takeSnapshot(gl, GetParam())), "") << errorName(error);
    EXPECT_EQ(test::describe(context.takeMessages()), "")
        << "raising an error again must not show in the host's debug output";
  }
}

TEST_P(HostileState, withoutErrorsStaysWithout) {
  { const StateGuard guard(*loaded, kAll); }
  EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// ---- what cannot be worked in ----

TEST_P(HostileState, withACountingQueryIsRefusedUnchanged) {
  GLuint query = 0;
  gl.GenQueries(1, &query);
  for (const int target : {GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED_CONSERVATIVE,
                           GL_PRIMITIVES_GENERATED, GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN}) {
    gl.DeleteQueries(1, &query);
    gl.GenQueries(1, &query);
    gl.BeginQuery(static_cast<GLenum>(target), query);
    EXPECT_NE(findObstacle(*loaded).find("query"), std::string::npos) << target;
    EXPECT_THROW(StateGuard(*loaded, kAll), Error);
    gl.EndQuery(static_cast<GLenum>(target));
    EXPECT_EQ(findObstacle(*loaded), "");
  }
  gl.DeleteQueries(1, &query);
}

TEST_P(HostileState, withATimeQueryIsNoObstacle) {
  GLuint query = 0;
  gl.GenQueries(1, &query);
  gl.BeginQuery(GL_TIME_ELAPSED, query);
  EXPECT_EQ(findObstacle(*loaded), "");
  gl.EndQuery(GL_TIME_ELAPSED);
  gl.DeleteQueries(1, &query);
}

// A program whose position is captured, in the middle of capturing.
struct Feedback {
  const GladGLContext& gl;
  GLuint program = 0, buffer = 0;
  explicit Feedback(const GladGLContext& context) : gl(context), program(gl.CreateProgram()) {
    const char* text =
        "#version 450\nout vec4 captured;\nvoid main() { captured = vec4(1); gl_Position = vec4(0); }";
    const GLuint shader = gl.CreateShader(GL_VERTEX_SHADER);
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    gl.AttachShader(program, shader);
    const char* varying = "captured";
    gl.TransformFeedbackVaryings(program, 1, &varying, GL_INTERLEAVED_ATTRIBS);
    gl.LinkProgram(program);
    gl.DeleteShader(shader);
    gl.CreateBuffers(1, &buffer);
    gl.NamedBufferStorage(buffer, 1024, nullptr, 0);
    gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    gl.UseProgram(program);
    gl.BeginTransformFeedback(GL_POINTS);
  }
  Feedback(const Feedback&) = delete;
  Feedback& operator=(const Feedback&) = delete;
  ~Feedback() {
    gl.EndTransformFeedback();
    gl.UseProgram(0);
    gl.DeleteProgram(program);
    gl.DeleteBuffers(1, &buffer);
  }
};

TEST_P(HostileState, withRunningTransformFeedbackIsRefusedAndPausedIsKept) {
  const Feedback feedback(gl);
  EXPECT_NE(findObstacle(*loaded).find("transform feedback"), std::string::npos);
  EXPECT_THROW(StateGuard(*loaded, kAll), Error);
  gl.PauseTransformFeedback();
  const test::Snapshot before = takeSnapshot(gl, GetParam());
  {
    const StateGuard guard(*loaded, kAll);
    odd.apply(1, kOurs);
  }
  EXPECT_EQ(test::difference(before, takeSnapshot(gl, GetParam())), "");
  gl.ResumeTransformFeedback();
}

TEST_P(HostileState, withAnIncompleteFramebufferIsRefusedWithAReason) {
  const Framebuffer empty(gl);
  const auto reason = [&](GLuint framebuffer) -> std::string {
    try {
      requireDrawable(*loaded, framebuffer);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(reason(empty.name()).find("is not complete"), std::string::npos);
  EXPECT_NE(reason(4711).find("does not exist"), std::string::npos);
  EXPECT_EQ(reason(odd.framebuffer(0)), "");
  GLuint multisampled = 0, renderbuffer = 0;
  gl.CreateRenderbuffers(1, &renderbuffer);
  gl.NamedRenderbufferStorageMultisample(renderbuffer, 4, GL_RGBA8, 16, 16);
  gl.CreateFramebuffers(1, &multisampled);
  gl.NamedFramebufferRenderbuffer(multisampled, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer);
  EXPECT_NE(reason(multisampled).find("multisampled"), std::string::npos);
  gl.DeleteFramebuffers(1, &multisampled);
  gl.DeleteRenderbuffers(1, &renderbuffer);
}

// ---- the test of the test: leave out each call that restores, one after the other ----

// Puts itself before a function of the context; while armed it counts calls, and leaves one of them out.
struct Dropping {
  static inline bool armed = false;
  static inline int seen = 0;
  static inline int dropped = -1;
  static inline std::string dropped_name;
  static bool drops(const char* name) {
    if (!armed || seen++ != dropped) return false;
    dropped_name = name;
    return true;
  }
};

template <auto Member>
struct Interposer;
template <class... Arguments, void (*GladGLContext::*Member)(Arguments...)>
struct Interposer<Member> {
  static inline void (*original)(Arguments...) = nullptr;
  static inline const char* name = "";
  static void call(Arguments... arguments) {
    if (!Dropping::drops(name)) original(arguments...);
  }
  static void install(GladGLContext& gl, const char* function) {
    name = function;
    original = gl.*Member;
    gl.*Member = call;
  }
};

void interpose(GladGLContext& gl) {
#define RG_INTERPOSE(function) Interposer<&GladGLContext::function>::install(gl, #function)
  RG_INTERPOSE(UseProgram);
  RG_INTERPOSE(BindVertexArray);
  RG_INTERPOSE(BindBuffer);
  RG_INTERPOSE(BindBufferBase);
  RG_INTERPOSE(BindBufferRange);
  RG_INTERPOSE(ActiveTexture);
  RG_INTERPOSE(BindTexture);
  RG_INTERPOSE(BindSampler);
  RG_INTERPOSE(BindImageTexture);
  RG_INTERPOSE(BindFramebuffer);
  RG_INTERPOSE(NamedFramebufferDrawBuffers);
  RG_INTERPOSE(NamedFramebufferReadBuffer);
  RG_INTERPOSE(ViewportIndexedfv);
  RG_INTERPOSE(DepthRangeIndexed);
  RG_INTERPOSE(ScissorIndexedv);
  RG_INTERPOSE(ClipControl);
  RG_INTERPOSE(Enable);
  RG_INTERPOSE(Disable);
  RG_INTERPOSE(Enablei);
  RG_INTERPOSE(Disablei);
  RG_INTERPOSE(BlendFuncSeparatei);
  RG_INTERPOSE(BlendEquationSeparatei);
  RG_INTERPOSE(ColorMaski);
  RG_INTERPOSE(BlendColor);
  RG_INTERPOSE(DepthFunc);
  RG_INTERPOSE(DepthMask);
  RG_INTERPOSE(CullFace);
  RG_INTERPOSE(FrontFace);
  RG_INTERPOSE(PolygonMode);
  RG_INTERPOSE(ProvokingVertex);
  RG_INTERPOSE(LineWidth);
  RG_INTERPOSE(PointParameteri);
  RG_INTERPOSE(PixelStorei);
  RG_INTERPOSE(PixelTransferf);
  RG_INTERPOSE(ClampColor);
#undef RG_INTERPOSE
}

TEST_P(HostileState, testNoticesEachRestoringCallThatIsLeftOut) {
  interpose(loaded->gl);
  const auto countedRun = [&](size_t variant, int dropped) {
    Dropping::seen = 0;
    Dropping::dropped = dropped;
    const std::string changed = differenceAfterGuard(variant, [] { Dropping::armed = true; });
    Dropping::armed = false;
    return changed;
  };
  std::vector<std::string> unnoticed;
  for (size_t variant = 0; variant < 2; ++variant) {
    ASSERT_EQ(countedRun(variant, -1), "");
    const int calls = Dropping::seen;
    ASSERT_GT(calls, 150);
    for (int i = 0; i < calls; ++i) {
      if (countedRun(variant, i).empty())
        unnoticed.push_back(Dropping::dropped_name + " (call " + std::to_string(i) + ")");
      while (gl.GetError() != GL_NO_ERROR) {
      }
    }
  }
  EXPECT_EQ(unnoticed, std::vector<std::string>{});
  context.takeMessages();  // of calls gone wrong for want of the one before
}

}  // namespace
}  // namespace rg::gl
