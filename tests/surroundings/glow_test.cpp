// The glow about bright lamps: as much as an eye scatters, as far as it does, and no light made or lost.
#include <gtest/gtest.h>

#include <limits>

#include "gl/objects.h"
#include "gl/state_guard.h"
#include "gl_fixture.h"
#include "picture.h"
#include "scene.h"
#include "surroundings/glare.h"
#include "surroundings/glow_gl.h"

namespace rg::surroundings::test {
namespace {

using glm::vec4;

// The CIE's equation as it is printed (CIE 135/1; 1999), in 1/sr, for 40 years and pigmentation 0.5.
double veilPerLux(double t_deg) {
  return 10.0 / std::pow(t_deg, 3) +
         (5.0 / (t_deg * t_deg) + 0.05 / t_deg) * (1.0 + std::pow(40.0 / 62.5, 4)) + 0.00125;
}

TEST(Glare, isTheIntegralOfTheEquationOverRings) {
  for (const auto& [from, to] : {std::pair{0.1, 0.2}, {0.3, 4.0}, {5.0, 60.0}}) {
    constexpr int kSteps = 20000;  // midpoints: the error is far below the tolerance
    double sum = 0.0;
    const double step = (to - from) / kSteps, per_degree = glm::radians(1.0);
    for (int i = 0; i < kSteps; ++i) {
      const double t = from + (i + 0.5) * step;
      sum += veilPerLux(t) * 2.0 * glm::pi<double>() * t * step * per_degree * per_degree;
    }
    EXPECT_NEAR(scatteredShare(from, to) / sum, 1.0, 1e-4) << from;
  }
}

// From an octave's root below the first level's bell to as much above the last one's, as far as an eye
// spreads.
TEST(Glare, levelsTogetherHaveTheShareOfAllTheirRings) {
  for (const double focal_px : {300.0, 1500.0, 6000.0}) {
    const auto angle_deg = [focal_px](double px) {
      return std::clamp(glm::degrees(std::atan(px / focal_px)), kGlareFrom_deg, kGlareTo_deg);
    };
    double sum = 0.0;
    for (const float share : glareShares(focal_px, 7)) sum += static_cast<double>(share);
    const double first_px = 0.73 * 1.18 * 2.0 / std::sqrt(2.0);
    EXPECT_NEAR(sum, scatteredShare(angle_deg(first_px), angle_deg(128.0 * first_px)), 1e-6) << focal_px;
  }
}

class Glow : public rg::test::GlTest {
 protected:
  void SetUp() override { loaded = gl::loadContext(rg::test::GlContext::getProc, nullptr); }

  rg::test::Picture glowOf(const std::vector<vec4>& pixels, int width, int height, double strength,
                           const glm::ivec4& viewport_px, bool srgb = false, bool texture_told = true) {
    const gl::StateGuard guard(*loaded, RG_TOUCHED_PROGRAM | RG_TOUCHED_VERTEX_ARRAY | RG_TOUCHED_BUFFERS |
                                            RG_TOUCHED_TEXTURES | RG_TOUCHED_FRAMEBUFFER |
                                            RG_TOUCHED_VIEWPORT | RG_TOUCHED_BLEND | RG_TOUCHED_DEPTH |
                                            RG_TOUCHED_RASTER | RG_TOUCHED_PIXEL_STORE);
    gl::Texture2D colour(loaded->gl, GL_RGBA32F, width, height);
    const gl::Framebuffer target(loaded->gl, {&colour});
    colour.write(0, 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
    const Scene scene = sceneOnGround(10.0);
    rain::RainDraw request;
    request.view = &scene.views[0];
    request.viewport_px = viewport_px;
    request.target = {target.name(), texture_told ? colour.name() : 0, 0, width, height, srgb, 1.0f};
    GlowRenderer renderer(*loaded);
    renderer.draw(request, strength);
    return rg::test::readTexture(loaded->gl, colour.name());
  }

  // A lamp `side` px wide in the middle of the dark, and what is within a distance of it.
  std::vector<vec4> lamp(int width, int height, int side) const {
    std::vector<vec4> pixels(static_cast<size_t>(width * height), vec4(0.0f, 0.0f, 0.0f, 0.25f));
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x)
        pixels[static_cast<size_t>((height / 2 - side / 2 + y) * width + width / 2 - side / 2 + x)] =
            vec4(1e4f, 5e3f, 0.0f, 0.25f);
    }
    return pixels;
  }
  static double lightWithin(const rg::test::Picture& p, double radius_px) {
    double sum = 0.0;
    for (int y = 0; y < p.height; ++y) {
      for (int x = 0; x < p.width; ++x) {
        if (std::hypot(x + 0.5 - p.width / 2, y + 0.5 - p.height / 2) < radius_px)
          sum += static_cast<double>(p.at(x, y).x);
      }
    }
    return sum;
  }

  std::unique_ptr<gl::Context> loaded;
};

// Views are 60 degrees wide. Bells of an octave each follow a law that falls by the third power within a
// fifth or so; what is beside the picture is lost.
TEST_F(Glow, spreadsLightAsFarAsAnEyeAtEveryResolution) {
  for (const int width : {256, 512}) {
    const int side = width / 128, height = width * 9 / 16;
    const auto seen = glowOf(lamp(width, height, side), width, height, 1.0, {0, 0, width, height});
    const double all = 1e4 * side * side,
                 per_px = glm::degrees(std::atan(2.0 * std::tan(glm::radians(30.0)) / width));
    EXPECT_NEAR(lightWithin(seen, 1e9) / all, 1.0, 0.01);
    for (const double from_deg : {2.0, 4.0, 8.0}) {
      const double ring =
          (lightWithin(seen, 2.0 * from_deg / per_px) - lightWithin(seen, from_deg / per_px)) / all;
      EXPECT_NEAR(ring / scatteredShare(from_deg, 2.0 * from_deg), 1.0, 0.25) << width << " " << from_deg;
    }
    EXPECT_NEAR(
        static_cast<double>(seen.at(width / 2 + 9, height / 2).y / seen.at(width / 2 + 9, height / 2).x), 0.5,
        0.01);
  }
}

TEST_F(Glow, leavesAlphaAndWhatIsBesideTheViewportAndWhereNobodyAskedForIt) {
  const auto before = lamp(96, 64, 2);
  const auto at = [&](const rg::test::Picture& p, int x, int y) { return p.at(x, y).x; };
  for (const bool told : {true, false}) {
    const auto seen = glowOf(before, 96, 64, 1.0, {16, 16, 64, 40}, false, told);
    EXPECT_EQ(at(seen, 15, 32), 0.0f);
    EXPECT_EQ(at(seen, 50, 56), 0.0f);
    EXPECT_GT(at(seen, 30, 32), 0.0f);
    for (const vec4& pixel : seen.pixels) ASSERT_EQ(pixel.w, 0.25f);
  }
  EXPECT_EQ(glowOf(before, 96, 64, 0.0, {0, 0, 96, 64}).pixels, before);
  EXPECT_EQ(glowOf(before, 96, 64, 1.0, {0, 0, 96, 64}, true).pixels, before);  // sRGB
  EXPECT_EQ(glowOf(before, 96, 64, 1.0, {0, 0, 96, 3}).pixels, before);         // too small for any
  for (const bool told : {true, false}) {  // partly and wholly beside the target
    EXPECT_GT(at(glowOf(before, 96, 64, 1.0, {-40, 8, 96, 90}, false, told), 30, 32), 0.0f);
    EXPECT_EQ(glowOf(before, 96, 64, 1.0, {96, 0, 96, 64}, false, told).pixels, before);
  }
}

// What would be spread beside the picture comes back, alike at all borders, and none is lost; whatever the
// host's unit.
TEST_F(Glow, isAlikeAtAllBordersAndKeepsTheLight) {
  const auto near = [&](glm::ivec2 lamp, glm::ivec2 inwards, glm::ivec2 size = {128, 64}) {
    std::vector<vec4> pixels(static_cast<size_t>(size.x * size.y), vec4(0.0f));
    pixels[static_cast<size_t>(lamp.y * size.x + lamp.x)] = vec4(1e6f);
    const auto seen = glowOf(pixels, size.x, size.y, 1.0, {0, 0, size.x, size.y});
    EXPECT_NEAR(lightWithin(seen, 1e9) / 1e6, 1.0, 0.02) << lamp.x << " " << lamp.y;
    return static_cast<double>(seen.at(lamp.x + inwards.x, lamp.y + inwards.y).x);
  };
  // Sides of which all levels are halves.
  EXPECT_NEAR(near({50, 62}, {0, -6}) / near({50, 1}, {0, 6}), 1.0, 0.01);
  EXPECT_NEAR(near({126, 33}, {-6, 0}) / near({1, 33}, {6, 0}), 1.0, 0.01);
  for (const glm::ivec2 corner : {glm::ivec2(2, 2), glm::ivec2(99, 65)}) near(corner, {0, 0}, {101, 67});
}

TEST_F(Glow, doesNotSpreadWhatIsNoLight) {
  auto pixels = lamp(96, 64, 2);
  pixels[96 * 20 + 20] = vec4(std::numeric_limits<float>::quiet_NaN());
  pixels[96 * 20 + 40] = vec4(std::numeric_limits<float>::infinity());
  pixels[96 * 20 + 60] = vec4(-1e30f, -1e30f, -1e30f, 0.0f);
  const auto seen = glowOf(pixels, 96, 64, 4.0, {0, 0, 96, 64});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      if (y == 20 && (x == 20 || x == 40 || x == 60)) continue;
      ASSERT_TRUE(seen.at(x, y).x >= 0.0f && seen.at(x, y).x < 1e9f) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace rg::surroundings::test
