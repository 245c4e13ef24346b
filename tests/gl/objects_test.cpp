#include "gl/objects.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "gl/error.h"
#include "gl_fixture.h"
#include "picture.h"

namespace rg::gl {
namespace {

class Objects : public test::GlTest {};

TEST_F(Objects, areFreedOnceAtTheEndOfTheirScope) {
  GLuint name = 0;
  {
    const Texture2D texture(gl, GL_RGBA16F, 8, 4, 1);
    name = texture.name();
    EXPECT_TRUE(gl.IsTexture(name));
  }
  EXPECT_FALSE(gl.IsTexture(name));
}

TEST_F(Objects, moveWithoutFreeingAndFreeWhatTheyReplace) {
  Buffer first(gl, 16), second(gl, 32);
  const GLuint kept = first.name(), replaced = second.name();
  second = std::move(first);
  EXPECT_FALSE(first);
  EXPECT_EQ(second.name(), kept);
  EXPECT_EQ(second.bytes(), 16u);
  EXPECT_TRUE(gl.IsBuffer(kept));
  EXPECT_FALSE(gl.IsBuffer(replaced));
}

TEST_F(Objects, thatAreForgottenAreNotFreed) {
  Texture2D texture(gl, GL_R8, 1, 1);
  const GLuint name = texture.name();
  texture.forget();
  texture.reset();
  EXPECT_TRUE(gl.IsTexture(name));
  gl.DeleteTextures(1, &name);
}

TEST_F(Objects, ofEveryKindAreMadeAndFreed) {
  const Sampler sampler(gl, GL_LINEAR, GL_LINEAR, GL_REPEAT);
  const VertexArray array(gl);
  TimestampQuery query(gl);
  EXPECT_TRUE(gl.IsSampler(sampler.name()));
  EXPECT_TRUE(gl.IsVertexArray(array.name()));
  query.stamp();
  EXPECT_GT(query.ns(), 0u);
  EXPECT_TRUE(query.ready());
  EXPECT_TRUE(gl.IsQuery(query.name()));
}

TEST_F(Objects, bufferKeepsWhatIsWrittenAndZeroes) {
  std::vector<uint32_t> values(64);
  std::iota(values.begin(), values.end(), 1u);
  Buffer buffer(gl, 256);
  buffer.zero();
  buffer.write(64, std::span<const uint32_t>(values.data(), 16));
  buffer.zero(64, 4);
  std::vector<uint32_t> read(64);
  buffer.read(0, read.data(), 256);
  EXPECT_EQ(read[15], 0u);
  EXPECT_EQ(read[16], 0u);
  EXPECT_EQ(read[17], 2u);
  EXPECT_EQ(read[31], 16u);
  EXPECT_EQ(read[32], 0u);
}

TEST_F(Objects, bufferOfNothingIsStillABuffer) {
  const Buffer buffer(gl, std::span<const float>{});
  EXPECT_TRUE(gl.IsBuffer(buffer.name()));
}

TEST_F(Objects, texturesTakeAndZeroPixelsOfEveryKind) {
  Texture2D color(gl, GL_RGBA32F, 2, 2);
  const std::vector<float> pixels(16, 0.5f);
  color.write(0, 0, 0, 0, 2, 2, GL_RGBA, GL_FLOAT, pixels.data());
  EXPECT_EQ(test::readTexture(gl, color.name()).at(1, 1), glm::vec4(0.5f));
  color.zero();
  EXPECT_EQ(test::readTexture(gl, color.name()).at(1, 1), glm::vec4(0.0f));
  Texture2D(gl, GL_R32UI, 4, 4).zero();
  Texture2D(gl, GL_RG16I, 4, 4).zero();
  Texture2D(gl, GL_DEPTH_COMPONENT32F, 4, 4).zero();
  Texture2DArray array(gl, GL_RGBA8, 4, 4, 3, 2);
  array.zero(1);
  TextureCube cube(gl, GL_RGBA16F, 4, fullMipLevels(4, 4));
  cube.write(0, 0, 0, 5, 2, 2, GL_RGBA, GL_FLOAT, pixels.data());
  cube.generateMipmaps();
  Texture3D(gl, GL_R16F, 4, 4, 4).zero();
}

TEST_F(Objects, mipLevelsReachOnePixel) {
  EXPECT_EQ(fullMipLevels(1, 1), 1);
  EXPECT_EQ(fullMipLevels(256, 3), 9);
  EXPECT_EQ(fullMipLevels(255, 3), 8);
}

TEST_F(Objects, framebufferDrawsAllItsColorsAndSaysWhenItIsIncomplete) {
  const Texture2D a(gl, GL_RGBA16F, 8, 8), b(gl, GL_R32F, 8, 8), depth(gl, GL_DEPTH_COMPONENT32F, 8, 8);
  const Framebuffer framebuffer(gl, {&a, &b}, &depth);
  framebuffer.requireComplete("test");
  const float one[4] = {1.0f, 1.0f, 1.0f, 1.0f};
  gl.ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 1, one);
  EXPECT_EQ(test::readTexture(gl, b.name()).at(3, 3).x, 1.0f);
  const Framebuffer empty(gl);
  EXPECT_THROW(empty.requireComplete("test"), Error);
}

TEST_F(Objects, fencePassesWhenTheWorkIsDone) {
  Fence fence(gl);
  fence.wait();
  EXPECT_TRUE(fence.passed());
  Fence moved = std::move(fence);
  EXPECT_FALSE(fence);
  EXPECT_TRUE(moved);
}

TEST_F(Objects, areSharedWithAContextOfTheSameGroup) {
  Buffer buffer(gl, 16);
  buffer.zero();
  const auto other = context.shared();
  other->makeCurrent();
  EXPECT_TRUE(other->gl.IsBuffer(buffer.name()));
  context.makeCurrent();
}

TEST_F(Objects, errorsAreTakenAndThrownWithTheirName) {
  throwOnError(gl, "nothing");
  gl.Enable(0xFFFF);
  try {
    throwOnError(gl, "making a mess");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "making a mess: GL_INVALID_ENUM");
    EXPECT_EQ(error.kind(), Error::Kind::kDriver);
  }
  EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  EXPECT_EQ(context.takeMessages().size(), 1u);  // the debug output saw it too
}

}  // namespace
}  // namespace rg::gl
