#include "gl/program.h"

#include <gtest/gtest.h>

#include "gl/error.h"
#include "gl_fixture.h"
#include "shared/hash.glsl"

namespace rg::gl {
namespace {

std::string_view fakeFiles(std::string_view path) {
  if (path == "a.glsl") return "#include \"b.glsl\"\nfloat a() { return b() + c(); }\n";
  if (path == "b.glsl") return "#include <vector>\n  #  include \"c.glsl\"\nfloat b() { return c(); }";
  if (path == "c.glsl") return "float c() { return SCALE; }\n";
  if (path == "loop.glsl") return "#include \"loop.glsl\"\n";
  if (path == "good.vert") return "void main() { gl_Position = vec4(0.0); }\n";
  if (path == "good.frag")
    return "#include \"a.glsl\"\nlayout(location = 0) out vec4 color;\nvoid main() { color = vec4(a()); }\n";
  if (path == "typo.glsl") return "float fine() { return 1.0; }\nfloat typo() { return nowhere; }\n";
  if (path == "bad.frag") return "#include \"c.glsl\"\n#include \"typo.glsl\"\nvoid main() {}\n";
  if (path == "missing.frag") return "void main() {}\n\n#include \"not/there.glsl\"\n";
  if (path == "bare.frag") return "#include b.glsl\n";
  if (path == "unlinked.vert") return "float nobody();\nvoid main() { gl_Position = vec4(nobody()); }\n";
  if (path == "odd.txt") return "void main() {}\n";
  return {};
}

size_t count(const std::string& text, const std::string& part) {
  size_t found = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::string failure(const auto& build) {
  try {
    build();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::kDriver);
    return error.what();
  }
  return "(it was built)";
}

TEST(Includes, arePutInOnceEachInTheOrderOfFirstMention) {
  const std::vector<std::string> defines{"SCALE 2.0"};
  const ShaderText resolved = resolveIncludes("good.frag", defines, fakeFiles);
  EXPECT_EQ(resolved.files, (std::vector<std::string>{"good.frag", "a.glsl", "b.glsl", "c.glsl"}));
  EXPECT_EQ(count(resolved.text, "float c()"), 1u);
  EXPECT_EQ(resolved.text.rfind("#version 450 core\n#define SCALE 2.0\n", 0), 0u);
  EXPECT_EQ(resolved.text.find("#include"), std::string::npos);
  EXPECT_LT(resolved.text.find("float c()"), resolved.text.find("float b()"));
}

TEST(Includes, thatGoInCirclesEnd) {
  EXPECT_EQ(resolveIncludes("loop.glsl", {}, fakeFiles).files.size(), 1u);
}

TEST(Includes, keepLineNumbers) {
  const ShaderText resolved = resolveIncludes("b.glsl", {}, fakeFiles);
  EXPECT_NE(resolved.text.find("#line 3 0\nfloat b()"), std::string::npos) << resolved.text;
}

TEST(Includes, ofMissingFilesNameFileAndLine) {
  EXPECT_EQ(failure([] { resolveIncludes("missing.frag", {}, fakeFiles); }),
            "missing.frag:3: there is no shader file \"not/there.glsl\"");
  EXPECT_EQ(failure([] { resolveIncludes("bare.frag", {}, fakeFiles); }),
            "bare.frag:1: #include wants a path in quotes");
  EXPECT_NE(failure([] { resolveIncludes("nowhere.vert", {}, fakeFiles); }).find("nowhere.vert"),
            std::string::npos);
}

TEST(Logs, nameFilesInTheFormsDriversUse) {
  const std::vector<std::string> files{"rain/streak.vert", "shared/hash.glsl"};
  EXPECT_EQ(nameFilesInLog("1:17(5): error: x\n0(3) : error C0000\nno place 1:2\n7:1: kept\n", files),
            "shared/hash.glsl:17(5): error: x\nrain/streak.vert:3 : error C0000\nno place 1:2\n7:1: kept\n");
  EXPECT_EQ(nameFilesInLog("", files), "");
  EXPECT_EQ(nameFilesInLog("1:", files), "1:");
}

class ProgramTest : public test::GlTest {};

const std::vector<std::string> kScaled{"SCALE 0.25"};

TEST_F(ProgramTest, buildsFromIncludesAndDefines) {
  const Program program(gl, {"good.vert", "good.frag"}, kScaled, fakeFiles);
  GLint linked = 0;
  gl.GetProgramiv(program.name(), GL_LINK_STATUS, &linked);
  EXPECT_TRUE(linked);
}

TEST_F(ProgramTest, tellsCompileErrorsByOurFileAndLine) {
  const std::string text = failure([&] { Program(gl, {"good.vert", "bad.frag"}, kScaled, fakeFiles).use(); });
  EXPECT_NE(text.find("bad.frag does not compile"), std::string::npos) << text;
  EXPECT_NE(text.find("typo.glsl:2"), std::string::npos) << text;
  context.takeMessages();  // Mesa's debug output tells of compile errors too
}

TEST_F(ProgramTest, tellsLinkErrorsAndFreesWhatItMade) {
  const std::string text = failure([&] { Program(gl, {"unlinked.vert"}, {}, fakeFiles).use(); });
  EXPECT_NE(text.find("unlinked.vert do not link"), std::string::npos) << text;
  context.takeMessages();
  EXPECT_NE(
      failure([&] { Program(gl, {"odd.txt"}, {}, fakeFiles).use(); }).find("odd.txt: a shader file ends in"),
      std::string::npos);
}

// The context as another driver's, which counts.
struct Driver {
  Driver(const GladGLContext& real, const char* renderer, bool side_by_side) : gl(real) {
    name = renderer;
    below = &real;
    linked = asked = 0;
    gl.KHR_parallel_shader_compile = side_by_side ? 1 : 0;
    gl.GetString = [](GLenum what) -> const GLubyte* {
      return what == GL_RENDERER ? reinterpret_cast<const GLubyte*>(name) : below->GetString(what);
    };
    gl.LinkProgram = [](GLuint program) {
      ++linked;
      below->LinkProgram(program);
    };
    gl.GetProgramiv = [](GLuint program, GLenum what, GLint* out) {
      ++asked;
      below->GetProgramiv(program, what, out);
    };
    gl.GetShaderiv = [](GLuint shader, GLenum what, GLint* out) {
      ++asked;
      below->GetShaderiv(shader, what, out);
    };
  }
  GladGLContext gl;
  static inline const char* name;
  static inline const GladGLContext* below;
  static inline int linked, asked;
};

TEST_F(ProgramTest, isBegunAsItIsMadeAndWaitedForOnceNeededWhereTheDriverHasThreads) {
  const Driver driver(gl, "Some GPU", true);
  const Program program(driver.gl, {"good.vert", "good.frag"}, kScaled, fakeFiles);
  EXPECT_EQ(Driver::linked, 1);
  EXPECT_EQ(Driver::asked, 0) << "asking waits";
  for (int i = 0; i < 3; ++i) program.use();
  EXPECT_EQ(Driver::linked, 1);
  EXPECT_EQ(Driver::asked, 1);
  gl.UseProgram(0);
}

TEST_F(ProgramTest, manyAreWaitedForTogetherAndTheOneThatFailsIsNamed) {
  Driver driver(gl, "Some GPU", true);
  BegunPrograms all(driver.gl);
  Program first(driver.gl, {"good.vert", "good.frag"}, kScaled, fakeFiles);
  const Program second(driver.gl, {"good.vert", "good.frag"}, kScaled, fakeFiles);
  const Program moved = std::move(first);
  EXPECT_EQ(Driver::linked, 2);
  EXPECT_EQ(Driver::asked, 0) << "asking waits";
  all.finish();
  EXPECT_EQ(Driver::asked, 2);
  moved.use();
  second.use();
  EXPECT_EQ(Driver::asked, 2);
  gl.UseProgram(0);
  const Program third(driver.gl, {"unlinked.vert"}, {}, fakeFiles);
  EXPECT_NE(failure([&] { all.finish(); }).find("unlinked.vert do not link"), std::string::npos);
  context.takeMessages();
}

TEST_F(ProgramTest, manyAreCompiledByAllThreadsAndTheHostsNumberIsGivenBack) {
  static GLuint threads;
  threads = 3;
  Driver driver(gl, "Some GPU", true);
  driver.gl.MaxShaderCompilerThreadsKHR = [](GLuint count) { threads = count; };
  driver.gl.GetInteger64v = [](GLenum what, GLint64* out) {
    ASSERT_EQ(what, static_cast<GLenum>(GL_MAX_SHADER_COMPILER_THREADS_KHR));
    *out = threads;
  };
  {
    const BegunPrograms all(driver.gl);
    EXPECT_EQ(threads, 0xffffffffu);
  }
  EXPECT_EQ(threads, 3u);
}

TEST_F(ProgramTest, isFinishedAsItIsMadeWhereTheDriverHasNoThreads) {
  const Driver driver(gl, "Some GPU", false);
  const Program program(driver.gl, {"good.vert", "good.frag"}, kScaled, fakeFiles);
  EXPECT_EQ(Driver::linked, 1);
  EXPECT_EQ(Driver::asked, 1);
}

TEST_F(ProgramTest, isNotBegunBeforeItIsNeededOnSoftwareGl) {
  const Driver driver(gl, "llvmpipe (LLVM 15)", true);
  const Program program(driver.gl, {"good.vert", "good.frag"}, kScaled, fakeFiles);
  EXPECT_EQ(Driver::linked, 0);
  program.set(0, 1.0f);
  EXPECT_EQ(Driver::linked, 1);
  gl.GetError();  // there is no such uniform
  context.takeMessages();
}

TEST_F(ProgramTest, thatFailsOnTheDriversThreadsSaysSoEachTimeItIsNeeded) {
  const Driver driver(gl, "Some GPU", true);
  const Program program(driver.gl, {"good.vert", "bad.frag"}, kScaled, fakeFiles);
  for (int i = 0; i < 2; ++i)
    EXPECT_NE(failure([&] { program.use(); }).find("typo.glsl:2"), std::string::npos);
  context.takeMessages();
}

// A compute shader that answers with what the shared file gives on the GPU.
std::string_view hashFiles(std::string_view path) {
  if (path != "hash.comp") return shaderSource(path);
  return "#include \"shared/hash.glsl\"\n"
         "layout(local_size_x = 64) in;\n"
         "layout(std430, binding = 0) buffer Out { uvec4 results[]; };\n"
         "void main() {\n"
         "  uint i = gl_GlobalInvocationID.x;\n"
         "  uvec3 three = pcg3d(uvec3(i, 7u, pcg(i)));\n"
         "  uvec4 four = pcg4d(uvec4(i, three.x, 3u, 4u));\n"
         "  results[2u * i] = uvec4(pcg(i), three);\n"
         "  results[2u * i + 1u] = uvec4(four.x ^ four.y, four.z ^ four.w, "
         "floatBitsToUint(unitFloat(four.x)),\n"
         "                               floatBitsToUint(openUnitFloat(four.y)));\n"
         "}\n";
}

class HashParity : public test::GlTest {};

TEST_F(HashParity, isTheSameOnCpuAndGpuToTheBit) {
  namespace s = rg::shared;
  constexpr uint32_t kCount = 4096;
  const Program program(gl, {"hash.comp"}, {}, hashFiles);
  const Buffer results(gl, kCount * 2 * sizeof(glm::uvec4));
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, results.name());
  program.use();
  gl.DispatchCompute(kCount / 64, 1, 1);
  gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<glm::uvec4> gpu(kCount * 2);
  results.read(0, gpu.data(), gpu.size() * sizeof(glm::uvec4));
  for (uint32_t i = 0; i < kCount; ++i) {
    const s::uvec3 three = s::pcg3d(s::uvec3(i, 7u, s::pcg(i)));
    const s::uvec4 four = s::pcg4d(s::uvec4(i, three.x, 3u, 4u));
    ASSERT_EQ(gpu[2 * i], glm::uvec4(s::pcg(i), three.x, three.y, three.z)) << i;
    ASSERT_EQ(gpu[2 * i + 1],
              glm::uvec4(four.x ^ four.y, four.z ^ four.w, s::floatBitsToUint(s::unitFloat(four.x)),
                         s::floatBitsToUint(s::openUnitFloat(four.y))))
        << i;
  }
}

TEST(Hash, fillsTheUnitIntervalEvenly) {
  constexpr uint32_t kCount = 1 << 16;
  constexpr uint32_t kBins = 64;
  std::vector<double> bins(kBins, 0.0);
  for (uint32_t i = 0; i < kCount; ++i) {
    const float u = rg::shared::unitFloat(rg::shared::pcg3d(rg::shared::uvec3(i, 1u, 2u)).y);
    ASSERT_GE(u, 0.0f);
    ASSERT_LT(u, 1.0f);
    bins[static_cast<size_t>(u * static_cast<float>(kBins))] += 1.0;
  }
  constexpr double kExpected = static_cast<double>(kCount) / kBins;
  double chi_square = 0.0;
  for (const double n : bins) chi_square += (n - kExpected) * (n - kExpected) / kExpected;
  EXPECT_LT(chi_square, 103.4);  // 63 degrees of freedom, p = 0.001
}

TEST(Hash, openUnitFloatNeverReachesItsEnds) {
  EXPECT_GT(rg::shared::openUnitFloat(0u), 0.0f);
  EXPECT_LT(rg::shared::openUnitFloat(0xFFFFFFFFu), 1.0f);
  EXPECT_LT(rg::shared::unitFloat(0xFFFFFFFFu), 1.0f);
}

}  // namespace
}  // namespace rg::gl
