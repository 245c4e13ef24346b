// The captured surroundings: right way round, and never more work than allowed.
#include <glm/gtc/matrix_transform.hpp>

#include "gl_fixture.h"
#include "glass/look_capture_gl.h"

namespace rg::test {
namespace {

constexpr int kSize_px = 16;

class Capture : public GlTest {
 protected:
  // Paints each face with a colour that tells where it looks, and its right half brighter.
  void paint(uint32_t framebuffer, int size_px, const glm::dmat4& eyeFromWorld) {
    ++faces_drawn;
    const glm::dmat3 worldFromEye = glm::transpose(glm::dmat3(eyeFromWorld));
    last_forward = -worldFromEye[2];
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl.Enable(GL_SCISSOR_TEST);
    for (int half = 0; half < 2; ++half) {
      const glm::dvec3 middle = last_forward + (half - 0.5) * worldFromEye[0];
      const glm::vec4 color(glm::vec3(0.5 + 0.5 * glm::normalize(middle)), 1.0f);
      gl.Scissor(half * size_px / 2, 0, size_px / 2, size_px);
      gl.ClearBufferfv(GL_COLOR, 0, &color.x);
    }
    gl.Disable(GL_SCISSOR_TEST);
  }
  void renew(int max_faces) {
    capture.renew(eye, kSize_px, max_faces,
                  [&](uint32_t framebuffer, int size_px, const glm::dmat4& view, const glm::dmat4&) {
                    paint(framebuffer, size_px, view);
                  });
  }

  glass::LookCapture capture{gl};
  glm::dmat4 eye =
      glm::lookAt(glm::dvec3(5e5, 3.0, 1.2), glm::dvec3(5e5 + 1.0, 3.0, 1.2), glm::dvec3(0.0, 0.0, 1.0));
  int faces_drawn = 0;
  glm::dvec3 last_forward{0.0};
};

TEST_F(Capture, drawsAtMostTheFacesItMayAndTheForwardOneFirst) {
  renew(1);
  EXPECT_EQ(faces_drawn, 1);
  EXPECT_NEAR(last_forward.x, 1.0, 1e-9);
  renew(2);
  EXPECT_EQ(faces_drawn, 3);
  EXPECT_EQ(capture.cube(), 0u);  // nothing is shown before all around is known
  renew(6);
  EXPECT_NE(capture.cube(), 0u);
}

TEST_F(Capture, renewsTheForwardFaceMostButNoneNever) {
  renew(6);
  int forward = 0;
  std::array<int, 6> seen{};
  for (int k = 0; k < 60; ++k) {
    renew(1);
    forward += last_forward.x > 0.9;
    for (size_t axis = 0; axis < 3; ++axis) {
      seen[2 * axis] += last_forward[static_cast<int>(axis)] > 0.9;
      seen[2 * axis + 1] += last_forward[static_cast<int>(axis)] < -0.9;
    }
  }
  EXPECT_GT(forward, 15);
  for (const int count : seen) EXPECT_GE(count, 4);
}

TEST_F(Capture, depthOfItsPicturesIsThatOfTheHostsViews) {
  for (const bool zero_to_one : {false, true}) {
    for (const bool reversed : {false, true}) {
      glm::dmat4 clip(0.0);
      capture.renew(
          eye, kSize_px, 1,
          [&](uint32_t, int, const glm::dmat4&, const glm::dmat4& clipFromEye) { clip = clipFromEye; },
          {zero_to_one, reversed});
      const auto depth = [&](double distance_m) {
        const glm::dvec4 at = clip * glm::dvec4(0.0, 0.0, -distance_m, 1.0);
        return at.z / at.w;
      };
      const double nearest = zero_to_one ? 0.0 : -1.0;
      for (const double distance_m : {0.3, 10.0, 1000.0}) {
        EXPECT_GT(depth(distance_m), nearest);
        EXPECT_LT(depth(distance_m), 1.0);
        EXPECT_EQ(depth(distance_m) < depth(2.0 * distance_m), !reversed);
      }
    }
  }
}

TEST_F(Capture, showsInEachDirectionWhatLiesThere) {
  renew(6);
  std::vector<glm::vec4> pixels(kSize_px * kSize_px * 6);
  gl.GetTextureImage(capture.cube(), 0, GL_RGBA, GL_FLOAT,
                     static_cast<GLsizei>(pixels.size() * sizeof(glm::vec4)), pixels.data());
  for (int face = 0; face < 6; ++face) {
    for (const int column : {kSize_px / 4, 3 * kSize_px / 4}) {
      const float s = (static_cast<float>(column) + 0.5f) * 2.0f / kSize_px - 1.0f;
      const glm::vec3 towards[6] = {{1, 0, -s}, {-1, 0, s}, {s, 1, 0},
                                    {s, -1, 0}, {s, 0, 1},  {-s, 0, -1}};  // OpenGL 4.5, table 8.19
      const glm::vec4& stored =
          pixels[static_cast<size_t>((face * kSize_px + kSize_px / 2) * kSize_px + column)];
      const glm::vec3 told = 2.0f * glm::vec3(stored) - 1.0f;
      EXPECT_GT(glm::dot(glm::normalize(told), glm::normalize(towards[face])), 0.99f)
          << "face " << face << " column " << column;
    }
  }
}

}  // namespace
}  // namespace rg::test
