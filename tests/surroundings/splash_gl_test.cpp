// Splashes as drawn: where the host's depth shows a surface that looks up and rain reaches it, and there as
// much of them at every size. RG_RAIN_PICTURES=DIR writes pictures to look at.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <glm/gtx/transform.hpp>

#include "gl/objects.h"
#include "gl/state_guard.h"
#include "gl_fixture.h"
#include "picture.h"
#include "scene.h"
#include "surroundings/splashes_gl.h"

namespace rg::surroundings::test {
namespace {

constexpr uint32_t kTouches = RG_TOUCHED_PROGRAM | RG_TOUCHED_VERTEX_ARRAY | RG_TOUCHED_BUFFERS |
                              RG_TOUCHED_TEXTURES | RG_TOUCHED_FRAMEBUFFER | RG_TOUCHED_VIEWPORT |
                              RG_TOUCHED_BLEND | RG_TOUCHED_DEPTH | RG_TOUCHED_RASTER |
                              RG_TOUCHED_PIXEL_STORE;
double nothing(const dvec3&, const dvec3&) { return 1e9; }
// A box 0.8 m high on the ground, 4 to 6 m ahead.
double bench(const dvec3& eye, const dvec3& ray) {
  const double front = (4.0 - eye.x) / ray.x, top = (0.8 - eye.z) / ray.z;
  const double at_top = eye.x + top * ray.x, at_front = eye.z + front * ray.z;
  if (ray.z < 0.0 && at_top > 4.0 && at_top < 6.0) return top;
  if (ray.x > 0.0 && at_front > 0.0 && at_front < 0.8) return front;
  return levelGround(eye, ray);
}

struct Asked {
  int width = 320, height = 180;
  Surface surface = levelGround;
  double gain = 1.0;
  bool read_depth = true;
  float sky = 1.0f;
};

class SplashPictures : public rg::test::GlTest {
 protected:
  void SetUp() override { loaded = gl::loadContext(rg::test::GlContext::getProc, nullptr); }

  // Over black and below a bright sky, so that what is seen is what splashes show of that.
  rg::test::Picture draw(const Scene& scene, const SplashPicture& picture, int64_t time_ns,
                         const Asked& asked) {
    const gl::StateGuard guard(*loaded, kTouches);
    const int width = asked.width, height = asked.height;
    const gl::Texture2D colour(loaded->gl, GL_RGBA32F, width, height);
    gl::Texture2D deep(loaded->gl, GL_DEPTH_COMPONENT32F, width, height);
    const gl::Framebuffer target(loaded->gl, {&colour}, &deep);
    const float black[] = {0.0f, 0.0f, 0.0f, 0.5f};
    loaded->gl.ClearNamedFramebufferfv(target.name(), GL_COLOR, 0, black);
    const std::vector<float> stored = storedDepth(scene.views[0], width, height, asked.surface);
    deep.write(0, 0, 0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());

    rain::RainDraw request;
    request.view = &scene.views[0];
    request.viewport_px = {0, 0, width, height};
    request.time_ns = time_ns;
    request.target = {target.name(),
                      asked.read_depth ? colour.name() : 0,
                      asked.read_depth ? deep.name() : 0,
                      width,
                      height,
                      false,
                      1.0f};
    request.lighting.sky_radiance = vec3(asked.sky);
    request.lighting.ground_radiance = vec3(0.0f);
    if (!renderer) renderer = std::make_unique<SplashRenderer>(*loaded);
    renderer->take(picture);
    renderer->draw(request, {.gain = asked.gain});
    return rg::test::readTexture(loaded->gl, colour.name());
  }
  void TearDown() override {
    renderer.reset();
    GlTest::TearDown();
  }

  static double sum(const rg::test::Picture& picture, int from_row = 0, int to_row = 1 << 20) {
    double all = 0.0;
    for (int y = from_row; y < std::min(to_row, picture.height); ++y) {
      for (int x = 0; x < picture.width; ++x) all += static_cast<double>(picture.at(x, y).x);
    }
    return all;
  }
  static double mean(const rg::test::Picture& picture) {
    return sum(picture) / (picture.width * static_cast<double>(picture.height));
  }

  std::unique_ptr<gl::Context> loaded;
  std::unique_ptr<SplashRenderer> renderer;
};

constexpr int64_t kTime_ns = 3'333'000'000;

// A host in cd/m^2 without exposure, and air that rises faster than drops fall: finite everywhere.
TEST_F(SplashPictures, ofGlaringSkiesAndRisingAirAreFinite) {
  Scene scene = sceneOnGround(50.0);
  look(scene.views[0], {0, 0, 1.5}, 0.0, -0.25);
  for (const double rising_mps : {0.0, 4.0, 100.0}) {
    scene.weather.wind_mps = dvec3(10.0, 0.0, rising_mps);
    const rg::test::Picture picture = draw(scene, pictureOf(scene), kTime_ns, {.sky = 1e6f});
    EXPECT_GT(sum(picture), 0.0);
    for (const glm::vec4& pixel : picture.pixels) ASSERT_TRUE(std::isfinite(pixel.x)) << rising_mps;
  }
}

// The picture's mean is of all that is covered on the ground seen, by the law of its drops: every splash at
// its age, counted on the CPU as the kernel tells it. To 4 %: what lies across the picture's rim.
TEST_F(SplashPictures, coverAsMuchAtEverySizeOfPicture) {
  Scene scene = sceneOnGround(10.0);
  look(scene.views[0], {0, 0, 1.5}, 0.0, -0.25);
  const SplashPicture picture = pictureOf(scene);
  const double large = mean(draw(scene, picture, kTime_ns, {.width = 1280, .height = 720}));
  EXPECT_GT(large, 1e-4);
  EXPECT_NEAR(mean(draw(scene, picture, kTime_ns, {.width = 640, .height = 360})), large, 0.04 * large);

  SplashSetup setup;
  setUpSplashes(picture, scene.views[0], kTime_ns, {}, setup);
  const glm::dmat4& clip = scene.views[0].clipFromEye;
  double expected = 0.0;
  each(setup, [&](const shared::SplashJob&, uint32_t, const shared::Splash& s) {
    const glm::dvec4 at =
        clip * glm::dmat4(glm::dmat3(scene.views[0].eyeFromWorld)) * glm::dvec4(s.place_m, 1.0);
    if (!shared::splashIsAlive(s) || at.w < 0.1 || std::abs(at.x) > at.w || std::abs(at.y) > at.w) return;
    const float distance_m = glm::length(s.place_m), sine = -s.place_m.z / distance_m;
    const double px_per_m = 0.5 * clip[1][1] * 720 / at.w;
    const float faded = 1.0f - glm::smoothstep(14.0f, 20.0f, distance_m);
    const float times = shared::splashTimes(s.rank, distance_m, s.diameter_m) * faded;
    const shared::SplashDrawn drawn = shared::splashDrawn(shared::splashShape(s.diameter_m, s.age_s),
                                                          static_cast<float>(px_per_m), sine, times);
    const vec3 light = shared::splashLight(vec3(0.0f), vec3(1.0f), -sine, 0.0f);
    expected += static_cast<double>(shared::splashCoverSum(drawn) * light.x);
  });
  // To 6 %: what overlaps hides each other, and places are known to a pixel.
  EXPECT_NEAR(large, expected / (1280.0 * 720.0), 0.06 * large);
}

// As hosts draw into textures that they show upside down.
TEST_F(SplashPictures, areTheSameUpsideDown) {
  Scene scene = sceneOnGround(20.0);
  const SplashPicture picture = pictureOf(scene);
  const auto upright = draw(scene, picture, kTime_ns, {});
  scene.views[0].clipFromEye = glm::scale(dvec3(1.0, -1.0, 1.0)) * scene.views[0].clipFromEye;
  const auto flipped = draw(scene, picture, kTime_ns, {});
  double apart = 0.0;
  for (int y = 0; y < upright.height; ++y) {
    for (int x = 0; x < upright.width; ++x)
      apart += static_cast<double>(std::abs(upright.at(x, y).x - flipped.at(x, upright.height - 1 - y).x));
  }
  // But for those whose place is on the other side of a pixel's edge.
  EXPECT_LT(apart, 0.05 * sum(upright));
}

// A picture's upper rim cuts them off, and does not leave them out: close by, as another picture shows them
// that goes on above it. To 10 %: of those whose foot is above it the near side reaches below.
TEST_F(SplashPictures, areCutByTheUpperRim) {
  const dvec3 eye(0, 0, 0.3);
  Scene scene = sceneOnGround(200.0, eye);
  look(scene.views[0], eye, 0.0, -0.45);
  const SplashPicture picture = pictureOf(scene);
  const double slope = scene.views[0].clipFromEye[1][1];
  double cut = 0.0, whole = 0.0;
  for (int k = 0; k < 8; ++k) {
    const int64_t time_ns = kTime_ns + k * INT64_C(150'000'000);
    scene.views[0].clipFromEye[1][1] = slope;
    whole += sum(draw(scene, picture, time_ns, {.width = 640, .height = 360}), 264, 270);
    scene.views[0].clipFromEye[1][1] = 2.0 * slope;
    cut += sum(draw(scene, picture, time_ns, {.width = 640, .height = 180}), 174, 180);
  }
  EXPECT_NEAR(cut, whole, 0.1 * whole);
}

// The foot of a dark wall 4 m ahead is shaded: what splashes there gathers from behind is the wall's, but for
// what they mirror, and the same ones shine where the sky stands behind them.
TEST_F(SplashPictures, areDimBeforeADarkWall) {
  Scene scene = sceneOnGround(100.0);
  look(scene.views[0], {0, 0, 1.5}, 0.0, -0.25);
  const Surface walled = [](const dvec3& eye, const dvec3& ray) {
    return std::min(levelGround(eye, ray), ray.x > 0.0 ? 4.0 / ray.x : 1e9);
  };
  const int from_row = static_cast<int>(90 - 156 * std::tan(std::atan(1.5 / 3.2) - 0.25)),
            to_row = static_cast<int>(90 - 156 * std::tan(std::atan(1.5 / 3.9) - 0.25));
  const SplashPicture picture = pictureOf(scene);
  const double open = sum(draw(scene, picture, kTime_ns, {}), from_row, to_row),
               shaded = sum(draw(scene, picture, kTime_ns, {.surface = walled}), from_row, to_row);
  EXPECT_GT(shaded, 0.05 * open);
  EXPECT_LT(shaded, 0.45 * open);
}

// Seen from above, a roof over the right half of the picture and a wind from the left, that carries rain in
// below no edge but the roof's windward one, and leaves the ground dry behind the other. Exact to the pixels
// that a crown is wide.
TEST_F(SplashPictures, areNoneBelowARoofUpToItsEdge) {
  Scene scene = sceneOnGround(50.0, {0, 0, 8.0});
  scene.views[0].eyeFromWorld =
      glm::translate(glm::lookAt(dvec3(0.0), dvec3(0, 0, -1), dvec3(0, 1, 0)), -dvec3(0, 0, 8.0));
  scene.weather.wind_mps = {6.0, 0.0, 0.0};
  rain::Field field;
  // From 2 to 3 m up, x from 0 to 1.5 m: what comes in at its windward edge falls on through below.
  ASSERT_EQ(setBox(field, 1, {0, -20, 2.0}, {1.5, 20, 3.0}), "");
  const double px_per_m = 160.0 / std::tan(glm::radians(30.0)) / 8.0;
  const auto between = [&](const SplashPicture& picture, double from_m, double to_m) {
    const int from = static_cast<int>(160 + from_m * px_per_m), to = static_cast<int>(160 + to_m * px_per_m);
    double all = 0.0;
    for (int k = 0; k < 3; ++k) {
      const auto seen = draw(scene, picture, kTime_ns + k * INT64_C(150'000'000), {});
      for (int x = from; x < to; ++x) {
        for (int y = 0; y < 180; ++y) all += static_cast<double>(seen.at(x, y).x);
      }
    }
    return all;
  };
  const SplashPicture sheltered = pictureOf(scene, field), open = pictureOf(scene);
  // A drop slants 6 / v: slow ones of 1 mm (4 m/s) by 1.5 m for each metre, the fastest by 0.65. All ways to
  // the ground between lead through the box: 2 m * 1.5 + edges.
  const double slowest = 6.0 / rain::fallSpeed(1.0), fastest = 6.0 / rain::fallSpeed(6.0);
  const double wet = between(open, -2.0, 2.0 * fastest - 0.05);
  EXPECT_GT(wet, 0.0);
  EXPECT_NEAR(between(sheltered, -2.0, 2.0 * fastest - 0.05), wet, 0.02 * wet);
  const double from_m = 2.0 * slowest + 0.05, to_m = 1.5 + 3.0 * fastest - 0.05;
  EXPECT_NEAR(between(sheltered, from_m, to_m), 0.0, 0.01 * between(open, from_m, to_m));
}

// A tunnel whose ground, walls and vault the host draws: dry all over, and wet without the volume.
TEST_F(SplashPictures, areNoneInATunnel) {
  Scene scene = sceneOnGround(50.0);
  scene.weather.wind_mps = {3.0, 5.0, 0.0};
  rain::Field field;
  EXPECT_GT(mean(draw(scene, pictureOf(scene, field), kTime_ns, {})), 1e-4);
  ASSERT_EQ(setBox(field, 1, {-50, -40, 0.0}, {80, 40, 6.0}), "");
  EXPECT_EQ(mean(draw(scene, pictureOf(scene, field), kTime_ns, {})), 0.0);
}

// On what looks up and is seen: not in the sky, not on a wall, nor on ground that the wall hides.
TEST_F(SplashPictures, standOnWhatIsSeenAndLooksUp) {
  Scene scene = sceneOnGround(50.0);
  const SplashPicture picture = pictureOf(scene);
  EXPECT_EQ(mean(draw(scene, picture, kTime_ns, {.surface = nothing})), 0.0);
  EXPECT_EQ(mean(draw(scene, picture, kTime_ns, {.surface = wallAt2m})), 0.0);
  // The bench's top is seen from 0.7 m above it, in rows that its front and the ground do not have.
  const auto row = [](double x_m, double z_m) {
    return static_cast<int>(90 + 160.0 / std::tan(glm::radians(30.0)) * (z_m - 1.5) / x_m);
  };
  double top = 0.0, front = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto seen = draw(scene, picture, kTime_ns + k * INT64_C(150'000'000), {.surface = bench});
    top += sum(seen, row(4.0, 0.8) + 1, row(6.0, 0.8)) / (row(6.0, 0.8) - row(4.0, 0.8) - 1);
    front += sum(seen, 0, row(4.0, 0.8) - 2) / (row(4.0, 0.8) - 2);
  }
  EXPECT_GT(top, 0.1);
  EXPECT_LT(front, 0.02 * top);
}

// Where depth is only tested they stand at the ground's height, hidden by what is before it.
TEST_F(SplashPictures, standOnTheToldGroundWhereDepthIsNotRead) {
  Scene scene = sceneOnGround(20.0);
  const double read = mean(draw(scene, pictureOf(scene), kTime_ns, {}));
  const double tested = mean(draw(scene, pictureOf(scene), kTime_ns, {.read_depth = false}));
  EXPECT_NEAR(tested, read, 0.05 * read);
  EXPECT_EQ(mean(draw(scene, pictureOf(scene), kTime_ns, {.surface = wallAt2m, .read_depth = false})), 0.0);
  scene.weather.ground_height_m = kNoGround_m;
  EXPECT_EQ(mean(draw(scene, pictureOf(scene), kTime_ns, {.read_depth = false})), 0.0);
  EXPECT_NEAR(mean(draw(scene, pictureOf(scene), kTime_ns, {})), read, 0.1 * read);  // found by its depth
}

TEST_F(SplashPictures, areTheSameTwiceAndLeaveTheTargetsAlpha) {
  const Scene scene = sceneOnGround(50.0);
  const auto first = draw(scene, pictureOf(scene), kTime_ns, {}),
             second = draw(scene, pictureOf(scene), kTime_ns, {});
  EXPECT_EQ(rg::test::greatestDifference(first, second), 0.0f);
  for (const glm::vec4& pixel : first.pixels) ASSERT_EQ(pixel.w, 0.5f);
}

// Those on a vehicle go with it: seen from it, its bonnet's splashes stay in place while it drives.
TEST_F(SplashPictures, goWithTheVehicleTheyStandOn) {
  const auto at = [](double speed_mps, int64_t after_ns) {
    Scene scene = sceneOnGround(50.0, {2.9, 0, 1.5});
    VehicleState car;
    car.id = 3;
    car.pose.velocity_mps = {speed_mps, 0, 0};
    scene.vehicles.push_back(car);
    scene.views[0].vehicle = 3;
    scene.views[0].eye_velocity_mps = car.pose.velocity_mps;
    const double after_s = static_cast<double>(after_ns) * 1e-9;
    look(scene.views[0], {2.9 + speed_mps * after_s, 0, 1.5}, 0.0, -0.6);
    return scene;
  };
  // A plate 1 m over the ground that reaches to 3 m before the eye.
  const Surface plate = [](const dvec3& eye, const dvec3& ray) {
    return ray.z < 0.0 ? (1.0 - eye.z) / ray.z : 1e9;
  };
  const SplashPicture picture = pictureOf(at(25.0, 0));
  constexpr int64_t kLater_ns = 8'000'000;
  const auto first = draw(at(25.0, picture.time_ns), picture, picture.time_ns, {.surface = plate}),
             later = draw(at(25.0, kLater_ns), picture, kLater_ns, {.surface = plate});
  double both = 0.0, squares = 0.0;
  for (size_t i = 0; i < first.pixels.size(); ++i) {
    both += static_cast<double>(first.pixels[i].x * later.pixels[i].x);
    squares += static_cast<double>(first.pixels[i].x * first.pixels[i].x);
  }
  EXPECT_GT(squares, 0.0);
  EXPECT_GT(both, 0.4 * squares);  // 8 ms of a life of some 70
}

TEST_F(SplashPictures, canBeLookedAt) {
  const char* folder = std::getenv("RG_RAIN_PICTURES");
  if (folder == nullptr) GTEST_SKIP() << "set RG_RAIN_PICTURES to a folder";
  Scene scene = sceneOnGround(50.0, {0, 0, 0.3});
  look(scene.views[0], {0, 0, 0.3}, 0.0, -0.4);
  auto picture = draw(scene, pictureOf(scene), kTime_ns, {.width = 1280, .height = 720});
  ASSERT_TRUE(writePpm(std::string(folder) + "/splashes.ppm", picture));
}

}  // namespace
}  // namespace rg::surroundings::test
