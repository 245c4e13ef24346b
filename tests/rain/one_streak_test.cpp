// One drop's streak, pixel by pixel: how long, how wide, how much of each pixel it covers, from any side.
#include <gtest/gtest.h>

#include <functional>

#include "gl/objects.h"
#include "gl/state_guard.h"
#include "gl_fixture.h"
#include "picture.h"
#include "rain/rain_gl.h"
#include "scene.h"
#include "shared/rain_drawn.glsl"

namespace rg::rain::test {
namespace {

using glm::dvec2;

constexpr uint32_t kTouches = RG_TOUCHED_PROGRAM | RG_TOUCHED_VERTEX_ARRAY | RG_TOUCHED_BUFFERS |
                              RG_TOUCHED_TEXTURES | RG_TOUCHED_FRAMEBUFFER | RG_TOUCHED_VIEWPORT |
                              RG_TOUCHED_BLEND | RG_TOUCHED_DEPTH | RG_TOUCHED_RASTER;
constexpr int kWidth_px = 320, kHeight_px = 180;
constexpr double kSlope = 0.57735026919;  // of the view's edge: 60 deg across
constexpr float kThroughFaces = 0.94f;    // what a drop shows of the light about it
constexpr double kFocal_px = 0.5 * kWidth_px / kSlope;

// The eye at the origin looks along +x; +y is left, +z up.
struct Case {
  dvec3 place_m{5, 0, 0}, velocity_mps{0, 0, -8}, eye_velocity_mps{0.0};
  double diameter_m = 2e-3, exposure_s = 1.0 / 60.0;
  float gain = 1.0f;
  float drop_radiance = 0.0f, behind = 1.0f;
  bool colour_told = false;  // the target's texture, so that what is behind can be looked at
  dvec3 past() const { return velocity_mps - eye_velocity_mps; }  // the drop's velocity as the eye sees it
};

dvec2 onPicture(const dvec3& p) {
  return dvec2(0.5 * kWidth_px, 0.5 * kHeight_px) + kFocal_px / p.x * dvec2(-p.y, p.z);
}

class Covers {
 public:
  double& at(int x, int y) { return values_[static_cast<size_t>(y) * kWidth_px + static_cast<size_t>(x)]; }
  double at(int x, int y) const {
    return values_[static_cast<size_t>(y) * kWidth_px + static_cast<size_t>(x)];
  }
  double sum() const {
    double s = 0.0;
    for (const double v : values_) s += v;
    return s;
  }
  double greatest() const { return *std::max_element(values_.begin(), values_.end()); }
  // Sums over squares of pixels: what remains when it does not matter how a pixel's sides are softened.
  Covers blurred(int reach_px) const {
    Covers result;
    for (int y = reach_px; y < kHeight_px - reach_px; ++y) {
      for (int x = reach_px; x < kWidth_px - reach_px; ++x) {
        for (int v = y - reach_px; v <= y + reach_px; ++v) {
          for (int u = x - reach_px; u <= x + reach_px; ++u) result.at(x, y) += at(u, v);
        }
      }
    }
    return result;
  }

 private:
  std::vector<double> values_ = std::vector<double>(size_t{kWidth_px} * kHeight_px);
};

double greatestDifference(const Covers& a, const Covers& b) {
  double most = 0.0;
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) most = std::max(most, std::abs(a.at(x, y) - b.at(x, y)));
  }
  return most;
}

// Garg & Nayar's tau/T by brute force: the drop's disk on the picture at many times of the exposure, each
// weighed as the shutter is open; the disk as so many points, each with its share of the area (a sunflower's
// seeds: Vogel 1979, "A better way to construct the sunflower head").
Covers byBruteForce(const Case& c) {
  constexpr int kTimes = 4000, kPoints = 300;
  std::vector<dvec2> points;
  for (int k = 0; k < kPoints; ++k) {
    const double r = std::sqrt((k + 0.5) / kPoints), angle = 2.39996322972865332 * k;
    points.emplace_back(r * std::cos(angle), r * std::sin(angle));
  }
  Covers covers;
  for (int i = 0; i < kTimes; ++i) {
    const double time = 2.0 * (i + 0.5) / kTimes - 1.0;
    const double open = static_cast<double>(shared::rainShutter(static_cast<float>(time)));
    const dvec3 p = c.place_m + c.past() * (0.5 * time * c.exposure_s);
    const dvec2 middle = onPicture(p);
    const double radius = 0.5 * c.diameter_m * kFocal_px / p.x;
    const double share = open / kTimes * 3.14159265358979 * radius * radius / kPoints;
    for (const dvec2& point : points) {
      const dvec2 on = glm::floor(middle + radius * point);
      if (on.x < 0 || on.y < 0 || on.x >= kWidth_px || on.y >= kHeight_px) continue;
      covers.at(static_cast<int>(on.x), static_cast<int>(on.y)) += share;
    }
  }
  return covers;
}

class OneStreak : public rg::test::GlTest {
 protected:
  void SetUp() override {
    loaded = gl::loadContext(rg::test::GlContext::getProc, nullptr);
    const gl::StateGuard guard(*loaded, kTouches);
    renderer = std::make_unique<RainRenderer>(*loaded, 1);
    colour = gl::Texture2D(loaded->gl, GL_RGBA32F, kWidth_px, kHeight_px);
    target = gl::Framebuffer(loaded->gl, {&colour});
  }

  // What of each pixel the drop covers, from how it changes what is behind it.
  Covers drawn(const Case& c) {
    const gl::StateGuard guard(*loaded, kTouches);
    Upload upload = uploadOf(c);
    renderer->upload(upload);
    const float behind[] = {c.behind, c.behind, c.behind, 1};
    loaded->gl.ClearNamedFramebufferfv(target.name(), GL_COLOR, 0, behind);
    ViewState view = viewAt(dvec3(0));
    view.eye_velocity_mps = c.eye_velocity_mps;
    view.exposure_s = c.exposure_s;
    RainDraw draw;
    draw.view = &view;
    draw.viewport_px = {0, 0, kWidth_px, kHeight_px};
    draw.target.framebuffer = target.name();
    draw.target.color_texture = c.colour_told ? colour.name() : 0;
    draw.target.width_px = kWidth_px;
    draw.target.height_px = kHeight_px;
    draw.lighting.sky_radiance = draw.lighting.ground_radiance = glm::vec3(c.drop_radiance / kThroughFaces);
    draw.gain = c.gain;
    renderer->draw(draw);
    const rg::test::Picture picture = rg::test::readTexture(loaded->gl, colour.name());
    Covers covers;
    for (int y = 0; y < kHeight_px; ++y) {
      for (int x = 0; x < kWidth_px; ++x)
        covers.at(x, y) = static_cast<double>((picture.at(x, y).x - c.behind) / (c.drop_radiance - c.behind));
    }
    return covers;
  }

  std::unique_ptr<gl::Context> loaded;

 private:
  static Upload uploadOf(const Case& c) {
    Upload upload;
    upload.whole = true;
    upload.picture.slot_end = 1;
    for (ClassPicture& kind : upload.picture.classes) {
      kind.origin_m = c.place_m - dvec3(0.5);
      kind.velocity_mps = c.velocity_mps;
      kind.reach_per_diameter = 1e9;  // nothing fades
    }
    RainDrop drop{};
    drop.fraction_xy = 0x80008000u;  // the cell's middle
    drop.fraction_z_class = 0x8000u;
    drop.diameter_m = static_cast<float>(c.diameter_m);
    drop.end = 1u << 30;
    upload.slots = {0};
    upload.records = {drop};
    return upload;
  }

  std::unique_ptr<RainRenderer> renderer;
  gl::Texture2D colour;
  gl::Framebuffer target;
};

// ---- cover ----

// A drop wider than pixels: each pixel alone, to 9 % of the densest, as the sides, where a disk's chord is
// steepest, are softened over a third of a pixel, and a pixel's share is told as of its width across the
// streak; the sum to 1 %.
TEST_F(OneStreak, coversEachPixelForGargAndNayarsDwellTime) {
  const Case cases[] = {
      {.place_m = {0.9, 0.0, 0.02}, .velocity_mps = {0, 0, -24}, .diameter_m = 20e-3},
      {.place_m = {0.9, 0.02, 0.0}, .velocity_mps = {0, -20, -17}, .diameter_m = 20e-3},
      {.place_m = {1.2, 0.0, 0.1}, .velocity_mps = {-26, 8, -21}, .diameter_m = 20e-3},  // comes nearer
  };
  for (const Case& c : cases) {
    const Covers expected = byBruteForce(c), got = drawn(c);
    EXPECT_GT(expected.greatest(), 0.05);
    EXPECT_LT(greatestDifference(got, expected), 0.09 * expected.greatest());
    EXPECT_NEAR(got.sum(), expected.sum(), 0.01 * expected.sum());
  }
}

// Narrower than a pixel: over squares of 9 x 9 that fall off to their sides, to 5 % of the densest; the sum
// to 1 %.
TEST_F(OneStreak, coversAsMuchWhenItIsNarrowerThanAPixel) {
  for (const double turn : {0.0, 0.3, 0.7853981634, 1.1, 1.5707963268}) {
    for (const double diameter_m : {1e-3, 4e-3, 16e-3}) {
      Case c{.place_m = {4, 0.003, 0.001}, .diameter_m = diameter_m};
      c.velocity_mps = 8.0 * 6.0 * dvec3(0, std::sin(turn), -std::cos(turn));
      const Covers expected = byBruteForce(c).blurred(2).blurred(2), got = drawn(c).blurred(2).blurred(2);
      EXPECT_LT(greatestDifference(got, expected), 0.10 * expected.greatest())
          << turn << " rad, " << diameter_m << " m";
      EXPECT_NEAR(got.sum(), expected.sum(), 0.01 * expected.sum()) << turn << " rad, " << diameter_m << " m";
    }
  }
}

// Wherever it lies on the grid of pixels: to 2 % of the sum, as the disk's share is told to half a percent.
TEST_F(OneStreak, coversAsMuchAtEveryPlaceOnTheGrid) {
  for (const double slant : {0.0, 1.0 / 3.0, 1.0}) {
    double least = 1e30, most = 0.0;
    for (int i = 0; i < 16; ++i) {
      Case c{.place_m = {4, i / 16.0 * 4.0 / kFocal_px, 0.0}, .velocity_mps = {0, 40 * slant, -40}};
      const double sum = drawn(c).sum();
      least = std::min(least, sum);
      most = std::max(most, sum);
    }
    EXPECT_LT(most, 1.02 * least) << slant;
  }
}

// To 2 parts in a thousand: fragments are told the root of the cover as a half float.
TEST_F(OneStreak, coversInProportionToTheGain) {
  Case c;
  const double physical = drawn(c).sum();
  for (const float gain : {0.5f, 2.5f, 10.0f}) {
    c.gain = gain;
    EXPECT_NEAR(drawn(c).sum(), static_cast<double>(gain) * physical,
                2e-3 * static_cast<double>(gain) * physical);
  }
}

// Before the dark eyes see a streak as it is: of the gain there is the less, the darker what is behind it is.
TEST_F(OneStreak, isDrawnWithLessOfTheGainTheDarkerWhatIsBehindIt) {
  const auto covered = [&](float gain, float behind) {
    return drawn({.gain = gain, .drop_radiance = 1.0f, .behind = behind, .colour_told = true}).sum();
  };
  const double physical = drawn({.drop_radiance = 1.0f, .behind = 0.0f}).sum();
  EXPECT_NEAR(covered(6.0f, 0.0f), physical, 0.01 * physical);
  // The share of what the gain adds that is left: all before what is as bright as the drop, five eighths
  // before a quarter of that, and towards the dark five times as much as what is behind. To a percent of the
  // gain, for half floats and the light that is read in a few places only.
  constexpr double kLeft[][2] = {{0.05, 5.0 / 24.0}, {0.25, 5.0 / 8.0}, {0.5, 5.0 / 6.0}, {0.95, 0.99}};
  for (const auto& [behind, left] : kLeft)
    EXPECT_NEAR(covered(6.0f, static_cast<float>(behind)), (1.0 + 5.0 * left) * physical, 0.06 * physical)
        << behind;
  // As bright or brighter: all of it. A gain of one, or less, is the same before everything.
  EXPECT_NEAR(covered(6.0f, 4.0f), 6.0 * physical, 0.06 * physical);
  EXPECT_NEAR(covered(1.0f, 0.2f), physical, 0.01 * physical);
  EXPECT_NEAR(covered(0.5f, 0.0f), 0.5 * physical, 0.01 * physical);
}

// Physics.md's example: a 2 mm drop exposed for 1/60 s changes what is behind it by about 1 %.
TEST_F(OneStreak, ofTwoMillimetresChangesAPercentOfWhatIsBehindIt) {
  const Case c{.place_m = {0.6, 0, 0}, .velocity_mps = {0, 0, -6.5}};
  EXPECT_GT(drawn(c).greatest(), 0.005);
  EXPECT_LT(drawn(c).greatest(), 0.02);
}

TEST_F(OneStreak, hidesNothingWhollyWhateverTheGain) {
  Case c{.place_m = {0.9, 0, 0}, .diameter_m = 20e-3};
  c.gain = 50.0f;
  EXPECT_LT(drawn(c).greatest(), 0.96);
  EXPECT_GT(drawn(c).greatest(), 0.7);
}

// ---- shape ----

// How long a streak is, from how far its cover spreads about its middle: the shutter's own spread is known.
double lengthOf(const Covers& covers, const dvec2& along) {
  double spread_of_shutter = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double t = (i + 0.5) / 1000;
    spread_of_shutter += t * t * static_cast<double>(shared::rainShutter(static_cast<float>(t))) / 1000;
  }
  double sum = 0.0, first = 0.0, second = 0.0;
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      const double at = glm::dot(dvec2(x, y), along), w = covers.at(x, y);
      sum += w;
      first += w * at;
      second += w * at * at;
    }
  }
  const double mean = first / sum;
  return 2.0 * std::sqrt((second / sum - mean * mean) / spread_of_shutter);
}

struct Ends {
  dvec2 from_px, to_px;
};
Ends endsOf(const Case& c) {
  const dvec3 half = c.past() * (0.5 * c.exposure_s);
  return {onPicture(c.place_m - half), onPicture(c.place_m + half)};
}

// Within 2 %, and the pixels' own size (a dot is 2.5 px long).
void expectLength(const Case& c, const Covers& covers) {
  const Ends ends = endsOf(c);
  const double length_px = glm::distance(ends.to_px, ends.from_px);
  EXPECT_NEAR(lengthOf(covers, (ends.to_px - ends.from_px) / length_px), length_px, 0.02 * length_px + 1.25)
      << c.past().x << " " << c.past().y << " " << c.past().z << " m/s, " << c.exposure_s << " s";
}

TEST_F(OneStreak, isAsLongAsTheExposureAndTheVelocityPastTheEye) {
  for (const double exposure_s : {1.0 / 240.0, 1.0 / 60.0, 1.0 / 30.0, 0.08}) {
    for (const dvec3 eye : {dvec3(0), dvec3(0, 10, 0), dvec3(0, 0, 12)}) {
      const Case c{.place_m = {6, 0, 0},
                   .velocity_mps = {0, 0, -8},
                   .eye_velocity_mps = eye,
                   .exposure_s = exposure_s};
      const double length_px = glm::length(c.past()) * exposure_s * kFocal_px / 6.0;
      EXPECT_NEAR(glm::distance(endsOf(c).to_px, endsOf(c).from_px), length_px, 1e-9);
      expectLength(c, drawn(c));
    }
  }
}

TEST_F(OneStreak, isForeshortenedWhenLookedAtAlongItsWay) {
  double last_px = 1e30;
  for (const double turn : {0.0, 0.5, 1.0, 1.3, 1.5}) {
    Case c{.place_m = {6, 0.3, 0.2}, .exposure_s = 0.05};
    c.velocity_mps = 20.0 * dvec3(std::sin(turn), 0, -std::cos(turn));
    const Covers covers = drawn(c);
    const Ends ends = endsOf(c);
    const double length_px = glm::distance(ends.to_px, ends.from_px);
    EXPECT_LT(length_px, last_px);
    last_px = length_px;
    // Its middle on the picture is not its middle in time, so that its spread is compared with the oracle's.
    const dvec2 along = (ends.to_px - ends.from_px) / length_px;
    EXPECT_NEAR(lengthOf(covers, along), lengthOf(byBruteForce(c), along), 0.03 * length_px + 1.0) << turn;
  }
}

TEST_F(OneStreak, seenEndOnIsADotThatCoversAsMuch) {
  Case c{.place_m = {6, 0, 0}, .velocity_mps = {-30, 0, 0}, .diameter_m = 5e-3};
  const Covers expected = byBruteForce(c), got = drawn(c);
  EXPECT_NEAR(got.sum(), expected.sum(), 0.02 * expected.sum());
  for (int y = 0; y < kHeight_px; ++y) {
    for (int x = 0; x < kWidth_px; ++x) {
      const bool near = glm::distance(dvec2(x + 0.5, y + 0.5), 0.5 * dvec2(kWidth_px, kHeight_px)) < 3.0;
      ASSERT_TRUE(near || got.at(x, y) == 0.0) << x << " " << y;
    }
  }
}

// From the middle to either end it only gets paler, and is gone at the end.
TEST_F(OneStreak, isMoreTransparentTowardsItsEnds) {
  const Case c{.place_m = {4, -0.5 * 4.0 / kFocal_px, 0}, .velocity_mps = {0, 0, -60}, .diameter_m = 10e-3};
  const Covers covers = drawn(c);
  const int x = kWidth_px / 2, half_px = static_cast<int>(0.5 * 1.0 * kFocal_px / 4.0);
  double last = covers.at(x, kHeight_px / 2);
  for (int i = 1; i <= half_px; ++i) {
    const double above = covers.at(x, kHeight_px / 2 + i), below = covers.at(x, kHeight_px / 2 - 1 - i);
    EXPECT_LT(above, last + 1e-6);
    EXPECT_NEAR(above, below, 0.06 * covers.greatest());
    last = above;
  }
  EXPECT_LT(last, 0.02 * covers.greatest());
}

}  // namespace
}  // namespace rg::rain::test
