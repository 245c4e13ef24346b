// The rain beyond as drawn: how much light it takes, where it is and where not.
#include "rain/beyond_gl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gl/objects.h"
#include "gl/state_guard.h"
#include "gl_fixture.h"
#include "picture.h"
#include "rain/rain_gl.h"
#include "rain/size_law.h"
#include "scene.h"

namespace rg::rain::test {
namespace {

constexpr uint32_t kTouches = RG_TOUCHED_PROGRAM | RG_TOUCHED_VERTEX_ARRAY | RG_TOUCHED_BUFFERS |
                              RG_TOUCHED_TEXTURES | RG_TOUCHED_FRAMEBUFFER | RG_TOUCHED_VIEWPORT |
                              RG_TOUCHED_BLEND | RG_TOUCHED_DEPTH | RG_TOUCHED_RASTER |
                              RG_TOUCHED_PIXEL_STORE;
constexpr double kFar_m = 1000.0, kNear_m = 0.1;  // of scene.h's views
const BeyondLook kEven{.contrast = glm::dvec3(0.0)};

struct Asked {
  BeyondLook look{};
  float gain = 1.0f;
  bool particles = false;
  bool read_depth = true;
  glm::vec3 light{0.0f};  // of sky and ground; 0: what is seen is what comes through
  std::vector<DropLamp> lamps{};
};

// Draws over a white scene of given depth.
class BeyondTest : public rg::test::GlTest {
 protected:
  void SetUp() override { loaded = gl::loadContext(rg::test::GlContext::getProc, nullptr); }

  static BeyondPicture pictureOf(const Scene& scene, const Field& field) {
    Beyond motion;
    motion.tick(scene.tick(), WindProfile{});
    BeyondPicture picture;
    motion.describe(1.2 * 1663.0, picture);
    field.volumesSeen(motion.cones(), kBeyondRange_m, picture.volumes);
    return picture;
  }

  // `depth_m` along the view, by pixel from the lower left.
  rg::test::Picture draw(Scene& scene, Field& field, int width, int height, const std::vector<float>& depth_m,
                         const Asked& asked, int times = 1) {
    const gl::StateGuard guard(*loaded, kTouches);
    const gl::Texture2D colour(loaded->gl, GL_RGBA32F, width, height);
    gl::Texture2D deep(loaded->gl, GL_DEPTH_COMPONENT32F, width, height);
    const gl::Framebuffer target(loaded->gl, {&colour}, &deep);
    const float white[] = {1.0f, 1.0f, 1.0f, 0.5f};
    loaded->gl.ClearNamedFramebufferfv(target.name(), GL_COLOR, 0, white);
    std::vector<float> stored;
    for (const float d : depth_m) {
      const double ndc = (kFar_m + kNear_m) / (kFar_m - kNear_m) -
                         2.0 * kFar_m * kNear_m / ((kFar_m - kNear_m) * static_cast<double>(d));
      stored.push_back(static_cast<float>(0.5 * ndc + 0.5));
    }
    deep.write(0, 0, 0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());

    RainDraw request;
    request.view = &scene.views[0];
    request.viewport_px = {0, 0, width, height};
    request.time_ns = tickTimeNs(scene.index);
    request.target = {target.name(),
                      asked.read_depth ? colour.name() : 0,
                      asked.read_depth ? deep.name() : 0,
                      width,
                      height,
                      false,
                      1.0f};
    request.lighting.sky_radiance = request.lighting.ground_radiance = asked.light;
    request.lighting.lamps = asked.lamps;
    request.gain = asked.gain;
    if (!beyond) {
      beyond = std::make_unique<BeyondRenderer>(*loaded);
      beyond->setPattern(generatePattern());
    }
    beyond->take(pictureOf(scene, field));
    for (int i = 0; i < times; ++i) beyond->draw(request, asked.look);
    if (asked.particles) {
      Upload upload;
      field.publishAll(upload);
      RainRenderer drops(*loaded, 200000);
      drops.upload(upload);
      drops.draw(request);
    }
    return rg::test::readTexture(loaded->gl, colour.name());
  }

  rg::test::Picture drawBoard(double rain_mm_h, double board_m, int width, int height, const Asked& asked) {
    Field field({.capacity = 200000, .seed = 5});
    field.setVisibility({.factor = 1.2});
    Scene scene = sceneWithView(rain_mm_h);
    if (asked.particles) {
      for (; scene.index < 4; ++scene.index) field.tick(scene.tick());
      --scene.index;
    }
    return draw(scene, field, width, height,
                std::vector<float>(static_cast<size_t>(width * height), static_cast<float>(board_m)), asked);
  }

  static double mean(const rg::test::Picture& picture) {
    double sum = 0.0;
    for (const glm::vec4& p : picture.pixels) sum += static_cast<double>(p.x);
    return sum / static_cast<double>(picture.pixels.size());
  }

  std::unique_ptr<gl::Context> loaded;
  std::unique_ptr<BeyondRenderer> beyond;
};

// The unit-depth ray through a pixel's middle, world axes, of scene.h's views.
dvec3 rayAt(const ViewState& view, int x, int y, int width, int height) {
  const dvec3 eye_ray(((x + 0.5) / width * 2.0 - 1.0) / view.clipFromEye[0][0],
                      ((y + 0.5) / height * 2.0 - 1.0) / view.clipFromEye[1][1], -1.0);
  return glm::transpose(glm::dmat3(view.eyeFromWorld)) * eye_ray;
}

// Where the ray from the eye is inside a box, by the slab method; first > second: nowhere.
glm::dvec2 insideBox(const dvec3& eye, const dvec3& ray, const dvec3& low, const dvec3& high) {
  glm::dvec2 span(0.0, 1e9);
  for (glm::length_t i = 0; i < 3; ++i) {
    const double a = (low[i] - eye[i]) / ray[i], b = (high[i] - eye[i]) / ray[i];
    span = {std::max(span.x, std::min(a, b)), std::min(span.y, std::max(a, b))};
  }
  return span;
}

// Light that comes through the open parts of a way, without what particles take: cut at all ends of spans,
// each piece is open or not as its middle is.
double through(double rate_mm_h, const std::vector<glm::dvec2>& inside, double end_m) {
  std::vector<double> cuts{0.0, end_m};
  for (const glm::dvec2& span : inside) {
    for (const double s : {span.x, span.y}) cuts.push_back(std::clamp(s, 0.0, end_m));
  }
  std::sort(cuts.begin(), cuts.end());
  const ParticlesShare particles = particlesShare(rate_mm_h, 1.2 * 1663.0);
  const auto taken = [&](double s) {
    return particles.at_eye_per_m * particles.mean_m *
           (1.0 - static_cast<double>(
                      shared::rainTakenBeyond(static_cast<float>(s), static_cast<float>(particles.mean_m))));
  };
  double depth = 0.0;
  for (size_t i = 1; i < cuts.size(); ++i) {
    const double middle = 0.5 * (cuts[i - 1] + cuts[i]);
    const bool open = std::none_of(inside.begin(), inside.end(), [&](const glm::dvec2& span) {
      return span.x < middle && middle < span.y;
    });
    if (open)
      depth += extinction_per_m(rate_mm_h) * (cuts[i] - cuts[i - 1]) - (taken(cuts[i]) - taken(cuts[i - 1]));
  }
  return std::exp(-depth);
}

TEST_F(BeyondTest, withParticlesABoardAt100MetresIsAsPaleAsWebersLawSays) {
  constexpr int kWidth = 192, kHeight = 108;
  for (const double rate : {1.0, 10.0, 100.0}) {
    const auto picture = drawBoard(rate, 100.0, kWidth, kHeight, {.particles = true});
    const ViewState view = viewAt({0, 0, 1.5});
    double expected = 0.0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x)
        expected +=
            std::exp(-extinction_per_m(rate) * 100.0 * glm::length(rayAt(view, x, y, kWidth, kHeight)));
    }
    const double ratio = std::log(mean(picture)) / std::log(expected / (kWidth * kHeight));
    std::printf("%g mm/h: optical depth %+.1f %%\n", rate, 100.0 * (ratio - 1.0));
    EXPECT_NEAR(ratio, 1.0, 0.1) << rate << " mm/h";
  }
}

TEST_F(BeyondTest, keepsItsMeanWhateverItShowsOfThePattern) {
  for (const double rate : {10.0, 100.0}) {
    const double even = 1.0 - mean(drawBoard(rate, 100.0, 320, 180, {.look = kEven}));
    const double full = 1.0 - mean(drawBoard(rate, 100.0, 320, 180, {.look = {.contrast = glm::dvec3(1.0)}}));
    // A picture shows some forty turns of the pattern, each with chance's share.
    EXPECT_NEAR(full, even, 0.03 * even) << rate << " mm/h";
  }
}

TEST_F(BeyondTest, isAsBrightAtEveryResolution) {
  const Asked asked{.light = glm::vec3(0.3f)};
  const double small = mean(drawBoard(25.0, 200.0, 320, 180, asked)),
               large = mean(drawBoard(25.0, 200.0, 960, 540, asked));
  EXPECT_LT(small, 0.9);
  EXPECT_NEAR(small, large, 0.005 * large);  // mips of the pattern keep its mean
}

TEST_F(BeyondTest, showsTheSkysLightWhereItHidesTheScene) {
  const auto picture = drawBoard(100.0, 990.0, 64, 36, {.look = kEven, .light = glm::vec3(0.3f)});
  // At 6.8 per km a thousandth of the scene comes through.
  for (const glm::vec4& p : picture.pixels) ASSERT_NEAR(p.x, 0.3f, 0.01f);
}

// A lamp in the rain, 28 m off, that goes from a corner of the picture's tiles to the next: half way between
// both it is as bright. (One asked for at corners alone is 800 times as bright there.)
TEST_F(BeyondTest, isLitAsMuchByALampWhereverThatLiesInATile) {
  constexpr double kAhead_m = 28.0, kTile_m = 2.0 * 32.0 / 320.0 * 0.57735 * kAhead_m, kCorner_m = 0.6;
  const Asked dark{.look = kEven};
  const double without = mean(drawBoard(50.0, 200.0, 320, 180, dark));
  double least = 1e9, most = 0.0;
  for (int k = 0; k <= 8; ++k) {
    Asked lit = dark;
    lit.lamps.push_back(
        {.position_m = {kAhead_m, k / 8.0 * kTile_m, 1.5 + kCorner_m}, .intensity = glm::vec3(50.0f)});
    const double light = mean(drawBoard(50.0, 200.0, 320, 180, lit)) - without;
    least = std::min(least, light);
    most = std::max(most, light);
  }
  std::printf("lit by %.4f to %.4f\n", least, most);
  EXPECT_GT(least, 1e-3);
  EXPECT_LT(most, 1.3 * least);
}

// As far as a host may place it.
TEST_F(BeyondTest, isNotLitByALampBeyondAllThatIsSeen) {
  const Asked dark{.look = kEven, .light = glm::vec3(0.3f)};
  const auto without = drawBoard(50.0, 200.0, 64, 36, dark);
  for (const double far_m : {1e12, 1e20, 1e300}) {
    Asked lit = dark;
    lit.lamps.push_back({.position_m = {far_m, 0.0, 0.0}, .intensity = glm::vec3(1e9f)});
    EXPECT_EQ(rg::test::greatestDifference(drawBoard(50.0, 200.0, 64, 36, lit), without), 0.0f) << far_m;
    for (const glm::vec4& p : drawBoard(50.0, 200.0, 64, 36, lit).pixels) ASSERT_TRUE(std::isfinite(p.x));
  }
}

TEST_F(BeyondTest, inDryWeatherChangesNoPixel) {
  for (const bool read_depth : {true, false}) {
    const auto picture = drawBoard(0.0, 100.0, 64, 36, {.read_depth = read_depth, .light = glm::vec3(0.3f)});
    for (const glm::vec4& p : picture.pixels) ASSERT_EQ(p, glm::vec4(1.0f, 1.0f, 1.0f, 0.5f));
  }
}

TEST_F(BeyondTest, leavesTheTargetsAlpha) {
  const auto picture = drawBoard(50.0, 500.0, 64, 36, {});
  for (const glm::vec4& p : picture.pixels) ASSERT_EQ(p.w, 0.5f);
}

TEST_F(BeyondTest, isTheSamePictureTwice) {
  const auto once = drawBoard(50.0, 500.0, 160, 90, {}), again = drawBoard(50.0, 500.0, 160, 90, {});
  EXPECT_EQ(rg::test::greatestDifference(once, again), 0.0f);
}

TEST_F(BeyondTest, withoutDepthToReadStaysBehindWhatIsNear) {
  const Asked asked{.look = kEven, .read_depth = false};
  // At 4 m all layers are hidden; at 50 m two are seen whole: 40 m; at 900 m all, to the end of the rain.
  EXPECT_EQ(mean(drawBoard(50.0, 4.0, 64, 36, asked)), 1.0);
  EXPECT_NEAR(-std::log(mean(drawBoard(50.0, 50.0, 64, 36, asked))), extinction_per_m(50.0) * 40.0,
              0.1 * extinction_per_m(50.0) * 40.0);  // particles take some of it
  EXPECT_LT(mean(drawBoard(50.0, 900.0, 64, 36, asked)), 0.05);
}

// ---- shelter ----

// A tunnel along x of two boxes that overlap, as roads' tunnels do.
struct Tunnel {
  static constexpr double kFrom_m = 0.0, kTo_m = 60.0;
  std::vector<std::pair<dvec3, dvec3>> boxes{{{kFrom_m, -5, 0}, {33, 5, 6}}, {{30, -5, 0}, {kTo_m, 5, 6}}};
  double outside_m = 300.0;  // depth of what is seen beyond the mouths

  // Depth of the walls, or of what lies beyond a mouth.
  double depth(const dvec3& eye, const dvec3& ray) const {
    const glm::dvec2 whole = insideBox(eye, ray, {kFrom_m, -5, 0}, {kTo_m, 5, 6});
    if (whole.x >= whole.y) return outside_m;
    const dvec3 leaves = eye + ray * whole.y;
    if (whole.x <= 0.0 && leaves.x < kTo_m - 1e-6) return whole.y;  // a wall from within
    if (whole.x > 0.0) {
      const dvec3 enters = eye + ray * whole.x;
      if (enters.x > kFrom_m + 1e-6) return whole.x;  // a wall from outside
      if (leaves.x < kTo_m - 1e-6) return whole.y;
    }
    return outside_m;
  }
};

TEST_F(BeyondTest, inATunnelIsOnlyBeyondItsMouthWhereverTheEyeIs) {
  constexpr int kWidth = 240, kHeight = 135;
  constexpr double kRate = 50.0;
  const Tunnel tunnel;
  Field field;
  for (uint32_t i = 0; i < 2; ++i)
    ASSERT_EQ(setBox(field, i + 1, tunnel.boxes[i].first, tunnel.boxes[i].second), "");
  for (const double x : {-20.0, -0.5, 0.5, 10.0, 31.5, 45.0, 58.0, 59.9, 60.1}) {
    const dvec3 eye(x, 0.7, 1.5);
    Scene scene = sceneWithView(kRate, eye);
    look(scene.views[0], eye, 0.06, 0.02);
    field.reset();
    field.tick(scene.tick());
    std::vector<float> depth_m;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column)
        depth_m.push_back(
            static_cast<float>(tunnel.depth(eye, rayAt(scene.views[0], column, row, kWidth, kHeight))));
    }
    const auto picture = draw(scene, field, kWidth, kHeight, depth_m, {.look = kEven});
    int wet = 0;
    for (int row = 0; row < kHeight; row += 3) {
      for (int column = 0; column < kWidth; column += 3) {
        const dvec3 ray = rayAt(scene.views[0], column, row, kWidth, kHeight);
        const double stretch = glm::length(ray);
        std::vector<glm::dvec2> inside;
        for (const auto& [low, high] : tunnel.boxes)
          inside.push_back(insideBox(eye, ray, low, high) * stretch);
        const double end_m =
            static_cast<double>(depth_m[static_cast<size_t>(row * kWidth + column)]) * stretch;
        const double expected = through(kRate, inside, end_m);
        wet += expected < 0.99 ? 1 : 0;
        // Depth as 32-bit floats hold it, with a far plane of 1 km.
        ASSERT_NEAR(static_cast<double>(picture.at(column, row).x), expected, 0.001)
            << "eye at " << x << ", pixel " << column << ", " << row;
      }
    }
    EXPECT_GT(wet, 20) << "nothing of the mouth is seen from " << x;
  }
}

TEST_F(BeyondTest, isWhereNoneOfManyVolumesIs) {
  constexpr int kWidth = 160, kHeight = 90;
  constexpr double kRate = 80.0;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Field field;
  std::vector<std::pair<dvec3, dvec3>> boxes;
  for (uint32_t i = 0; i < 7; ++i) {  // a tile knows eight
    const dvec3 low(5.0 + 80.0 * unit(random), -30.0 + 50.0 * unit(random), -5.0 + 12.0 * unit(random));
    boxes.emplace_back(
        low, low + dvec3(2.0 + 40.0 * unit(random), 1.0 + 12.0 * unit(random), 1.0 + 8.0 * unit(random)));
    ASSERT_EQ(setBox(field, i + 1, boxes.back().first, boxes.back().second), "");
  }
  const dvec3 eye(0, 0, 1.5);
  Scene scene = sceneWithView(kRate, eye);
  field.tick(scene.tick());
  const auto picture =
      draw(scene, field, kWidth, kHeight, std::vector<float>(static_cast<size_t>(kWidth * kHeight), 150.0f),
           {.look = kEven});
  int sheltered = 0;
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; column += 2) {
      const dvec3 ray = rayAt(scene.views[0], column, row, kWidth, kHeight);
      const double stretch = glm::length(ray);
      std::vector<glm::dvec2> inside;
      for (const auto& [low, high] : boxes) {
        const glm::dvec2 span = insideBox(eye, ray, low, high) * stretch;
        if (span.x < span.y) inside.push_back(span);
      }
      sheltered += inside.size() > 1 ? 1 : 0;
      const double expected = through(kRate, inside, 150.0 * stretch);
      ASSERT_NEAR(static_cast<double>(picture.at(column, row).x), expected, 0.001) << column << ", " << row;
    }
  }
  EXPECT_GT(sheltered, 50) << "no ray meets two volumes";
}

TEST_F(BeyondTest, isBeyondTheMouthOfAVaultOfMorePlanesThanATileKnows) {
  constexpr int kWidth = 320, kHeight = 180, kFacets = 16;
  constexpr double kRate = 50.0, kRadius_m = 5.0, kLength_m = 80.0, kScene_m = 250.0;
  std::vector<dvec3> corners;
  for (int i = 0; i <= kFacets; ++i) {
    const double angle = glm::pi<double>() * i / kFacets;
    for (const double x : {0.0, kLength_m})
      corners.emplace_back(x, kRadius_m * std::cos(angle), kRadius_m * std::sin(angle));
  }
  VolumeInfo info;
  info.name = "vault";
  info.vertices = corners;
  Convex shape;
  ASSERT_EQ(makeConvex(info, shape), "");
  Field field;
  ASSERT_EQ(field.setVolume(1, info), "");
  for (const double x : {5.0, 40.0, 70.0}) {
    const dvec3 eye(x, 1.0, 1.3);
    Scene scene = sceneWithView(kRate, eye);
    field.reset();
    field.tick(scene.tick());
    std::vector<float> depth_m;
    std::vector<double> expected;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const dvec3 ray = rayAt(scene.views[0], column, row, kWidth, kHeight);
        const double stretch = glm::length(ray);
        double leaves = 1e9;
        for (const Plane& plane : shape.planes) {
          const double rate = glm::dot(plane.normal, ray);
          if (rate > 0.0) leaves = std::min(leaves, (plane.d - glm::dot(plane.normal, eye)) / rate);
        }
        const bool mouth = eye.x + ray.x * leaves > kLength_m - 1e-6;
        depth_m.push_back(static_cast<float>(mouth ? kScene_m : leaves));
        expected.push_back(
            through(kRate, {{0.0, leaves * stretch}}, static_cast<double>(depth_m.back()) * stretch));
      }
    }
    const auto picture = draw(scene, field, kWidth, kHeight, depth_m, {.look = kEven});
    size_t off = 0;
    for (size_t i = 0; i < expected.size(); ++i)
      off += std::abs(static_cast<double>(picture.pixels[i].x) - expected[i]) > 0.002 ? 1u : 0u;
    // Slivers of planes that bind between a tile's samples: a pixel in a thousand.
    EXPECT_LE(off, expected.size() / 1000) << "eye at " << x;
  }
}

TEST_F(BeyondTest, goesWithAMovingBodysShelter) {
  // A cabin round the eye, told at one tick and drawn 8 ms later, 0.27 m on: its windscreen goes with it.
  Field field;
  ASSERT_EQ(setBox(field, 1, {-1, -1, 0}, {1.5, 1, 2}, 7), "");
  Scene scene = sceneWithView(100.0, {0, 0, 1});
  VehicleState car;
  car.id = 7;
  car.pose.velocity_mps = {32, 0, 0};
  scene.vehicles.push_back(car);
  scene.views[0].eye_velocity_mps = car.pose.velocity_mps;
  field.tick(scene.tick());
  const BeyondPicture told = pictureOf(scene, field);
  ASSERT_EQ(told.volumes.size(), 1u);
  const double after_s = kTickSeconds;
  look(scene.views[0], {32 * after_s, 0, 1}, 0.0);
  shared::RainShelter shelter;
  setUpShelter(told.volumes, {32 * after_s, 0, 1}, after_s, shelter);
  for (uint32_t i = 0; i < shelter.volumes[0].count; ++i) {
    if (shelter.planes[i].x > 0.9f) {
      EXPECT_NEAR(shelter.planes[i].w, 1.5f, 1e-4f);
    }
  }
}

}  // namespace
}  // namespace rg::rain::test
