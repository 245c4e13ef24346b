// What is seen through a wet pane, against the laws of optics.
#include "look.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "shared/glass_crater.glsl"

namespace rg::test {
namespace {

using shared::GlassDropRecord;

TEST_F(Look, cleanGlassPassesThePictureToTheBit) {
  FlatPane pane(gl, kRake, 0.8, 64);
  pane.putFilm([](double, double) { return 1e-7; });  // what a wiper leaves
  Scene scene = inside({160, 90});
  std::mt19937 random(1);
  scene.picture =
      paint(scene.size_px, [&](int, int) { return glm::vec3(static_cast<float>(random() % 1024)) / 512.0f; });
  EXPECT_EQ(greatestDifference(draw(gl, look, scene, {&pane.pane, 1}), draw(gl, look, scene, {})), 0.0f);
}

// Deviation of the view ray by a film whose thickness grows along an axis, in units of its slope: physics.md
// 6, 60 degrees of incidence.
class FilmWedge : public Look {
 protected:
  glm::dvec2 deviationPerSlope(double slope_u, double slope_v) {
    FlatPane pane(gl, kRake, 0.8, 256);
    // Thick enough not to bead up anywhere near the middle.
    pane.putFilm([&](double u, double v) { return std::max(2e-3 + slope_u * u + slope_v * v, 0.0); });
    Scene scene = inside({640, 360});
    scene.picture =
        paint(scene.size_px, [](int x, int y) { return glm::vec3(x - 320, y - 180, 0.0f) / 64.0f; });
    const Picture seen = draw(gl, look, scene, {&pane.pane, 1});
    const Picture plain = draw(gl, look, scene, {});
    const glm::vec4 moved = 64.0f * (seen.at(320, 180) - plain.at(320, 180));
    const double px_per_rad = 320.0 / std::tan(0.5 * kFov);
    return glm::dvec2(moved.x, moved.y) / px_per_rad;
  }
};

TEST_F(FilmWedge, bendsTheViewInThePlaneOfIncidenceBy103Percent) {
  const double slope = 0.01;
  const glm::dvec2 deviation = deviationPerSlope(0.0, slope);
  EXPECT_NEAR(deviation.y / slope, 1.03,
              0.05);  // the law is of first order; half-float colours hold 0.03 of the slope
  EXPECT_NEAR(deviation.x / slope, 0.0, 0.03);
}

TEST_F(FilmWedge, bendsTheViewAcrossThePlaneOfIncidenceBy51Percent) {
  const double slope = 0.01;
  const glm::dvec2 deviation = deviationPerSlope(slope, 0.0);
  EXPECT_NEAR(deviation.x / slope, 0.51, 0.04);
  EXPECT_NEAR(deviation.y / slope, 0.0, 0.03);
}

TEST_F(Look, inAUniformWorldWaterIsInvisible) {
  // Every ray ends in the same light, so whatever is bent, reflected or split, as much must arrive: a white
  // furnace.
  FlatPane pane(gl, kRake, 0.8, 200);
  pane.putFilm([](double u, double v) { return 60e-6 * (1.0 + std::sin(90.0 * u) * std::cos(70.0 * v)); });
  std::vector<GlassDropRecord> drops = scatter(pane, 150, 3e-3, glm::radians(35.0), 2);
  for (const GlassDropRecord& drop : scatter(pane, 150, 2e-3, glm::radians(95.0), 3)) drops.push_back(drop);
  for (size_t k = 0; k < drops.size(); k += 3) {
    drops[k].elongation = 1.8f;
    drops[k].corner = k % 2 == 0 ? 1.0f : -0.6f;
  }
  // Left of the middle such as are seen one by one, right of it such as are not.
  pane.putBeads([](double u, double) { return u < 0.0 ? 2 : 40; }, 0.3, glm::radians(25.0));
  pane.putDrops(drops);
  const gl::TextureCube cube = makeCube(gl, 8, [](const glm::vec3&) { return glm::vec3(1.0f); });
  Scene scene = inside({640, 360});
  scene.light.environment_cube = cube.name();
  scene.picture = paint(scene.size_px, [](int, int) { return glm::vec3(1.0f); });
  // Rays are given up when 1 % is left of them, and shares below 0.4 % are not looked up.
  EXPECT_LT(greatestDifference(draw(gl, look, scene, {&pane.pane, 1}), draw(gl, look, scene, {})), 0.025f);
}

// Seen face on, to its left, its right, and from both signs of its corner.
TEST_F(Look, oneThatRunsIsBroadestAheadAndAsLargeAsItsBase) {
  constexpr double kRadius_m = 0.03;
  FlatPane pane(gl, glm::half_pi<double>(), 0.8, 64);
  const gl::TextureCube cube = makeCube(gl, 8, [](const glm::vec3&) { return glm::vec3(1.0f); });
  Scene scene = inside({320, 180});
  scene.light.environment_cube = cube.name();
  for (const float ahead : {1.0f, -1.0f}) {
    for (const float corner : {1.0f, 0.5f, -1.0f}) {
      GlassDropRecord drop = pane.cap(0.0, 0.0, kRadius_m, glm::radians(40.0));
      drop.elongation = 1.5f;
      drop.corner = corner;
      drop.heading = {corner < 0.0f ? -ahead : ahead, 0.0f};
      pane.putDrops({&drop, 1});
      const Picture seen = draw(gl, look, scene, {&pane.pane, 1});
      int first = 320, last = -1, area = 0;
      double balance = 0.0;  // about the picture's middle, where the record's place is
      std::vector<int> wide(320, 0);
      for (int x = 0; x < 320; ++x) {
        for (int y = 0; y < 180; ++y) wide[static_cast<size_t>(x)] += seen.at(x, y).x > 0.5f ? 1 : 0;
        if (wide[static_cast<size_t>(x)] == 0) continue;
        first = std::min(first, x), last = x;
        area += wide[static_cast<size_t>(x)];
        balance += (x + 0.5 - 160.0) * wide[static_cast<size_t>(x)];
      }
      const double px_per_m = 160.0 / std::tan(0.5 * kFov) / 0.65;
      EXPECT_NEAR(area / (glm::pi<double>() * std::pow(kRadius_m * px_per_m, 2.0)), 1.0, 0.03);
      EXPECT_NEAR(0.5 * (first + last + 1), 160.0, 1.0);
      EXPECT_GT(balance / area * static_cast<double>(ahead),
                0.03 * static_cast<double>(std::abs(corner)) * (last - first));
      const auto broadest = std::max_element(wide.begin(), wide.end()) - wide.begin();
      EXPECT_GT(static_cast<float>(broadest - 160) * ahead, 0.0f);
    }
  }
}

TEST_F(Look, aCraterBendsTheViewWhereThereIsFilmAndNowhereElse) {
  FlatPane pane(gl, kRake, 0.8, 256);
  Scene scene = inside({640, 360});
  scene.picture = paint(scene.size_px, checks);
  shared::CraterRecord crater{};
  crater.position_m = glm::vec2(0.4f, 0.4f);
  crater.width_m = 8e-3f;
  crater.film_m = 150e-6f;
  crater.levelling_m4_s = shared::craterLevelling_m4_s(crater.film_m);
  const auto changed = [&](double film_m) {
    pane.putFilm([&](double, double) { return film_m; });
    pane.pane.crater_count = 0;
    const Picture without = draw(gl, look, scene, {&pane.pane, 1});
    const gl::Buffer buffer(gl, std::span<const shared::CraterRecord>(&crater, 1));
    pane.pane.crater_buffer = buffer.name();
    pane.pane.crater_count = 1;
    const Picture with = draw(gl, look, scene, {&pane.pane, 1});
    std::pair<int, int> near_far{0, 0};
    for (int y = 0; y < with.height; ++y) {
      for (int x = 0; x < with.width; ++x) {
        if (glm::distance(with.at(x, y), without.at(x, y)) < 1e-3f) continue;
        // The eye is 0.65 m before the pane's middle: so far across does the crater reach, 3.5 widths.
        const double f_px = 0.5 * with.width * scene.view.clipFromEye[0][0];
        const bool near = std::abs(x + 0.5 - 0.5 * with.width) < 1.1 * f_px * 3.5 * 8e-3 / 0.65;
        ++(near ? near_far.first : near_far.second);
      }
    }
    return near_far;
  };
  const auto [bent, beyond] = changed(150e-6);
  EXPECT_GT(bent, 100);
  EXPECT_EQ(beyond, 0);
  EXPECT_EQ(changed(0.0).first, 0) << "a blade has taken the film";
  crater.age_s = 1e5f;
  EXPECT_EQ(changed(150e-6).first, 0) << "levelled long ago";
}

// Tiles that have nothing to be seen are left out, others are drawn with what they have.
TEST_F(Look, aPaneCutIntoTilesShowsTheSame) {
  FlatPane pane(gl, kRake, 0.8, 250);
  // Film above, up to the very edge of its tiles; beads to the right; drops here and there; the rest is dry.
  pane.putFilm([](double, double v) { return v > 0.0608 ? 4e-5 : 1e-7; });
  pane.putBeads([](double u, double v) { return u > 0.1 && v < 0.2 ? 3 : 0; }, 0.3, glm::radians(25.0));
  pane.putDrops(scatter(pane, 100, 3e-3, glm::radians(60.0), 4));
  glass::LookBlade blade;
  blade.middle_m = glm::vec3(-0.2 * pane.up);
  blade.along = glm::vec3(pane.right);
  blade.ahead = glm::vec3(pane.up);
  blade.blade_m = 0.3f;
  const std::vector<int32_t> pieces(shared::kBladeSegments * shared::kMaxGlassWipers, 20000000);
  const gl::Buffer ridges(gl, std::span<const int32_t>(pieces));
  pane.pane.blades = {blade};
  pane.pane.ridge_buffer = ridges.name();
  Scene scene = inside({640, 360});
  scene.picture = paint(scene.size_px, checks);
  std::vector<glass::LookView> views{scene.view, scene.view};
  views[1].eyeFromWorld = glm::lookAt(glm::dvec3(1.0, 0.0, 0.6), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
  std::vector<Picture> whole;
  for (const glass::LookView& view : views) {
    scene.view = view;
    whole.push_back(draw(gl, look, scene, {&pane.pane, 1}));
    EXPECT_GT(greatestDifference(whole.back(), draw(gl, look, scene, {})), 0.5f);
  }
  pane.cutIntoPieces();
  for (size_t k = 0; k < views.size(); ++k) {
    scene.view = views[k];
    const Picture tiled = draw(gl, look, scene, {&pane.pane, 1});
    int others = 0;
    for (int y = 0; y < 360; ++y) {
      for (int x = 0; x < 640; ++x)
        others += glm::distance(tiled.at(x, y), whole[k].at(x, y)) > 0.02f ? 1 : 0;
    }
    // Places on the glass are rounded otherwise in small triangles: a check's edge may fall to the other
    // side. (llvmpipe: 124 of them, an NVIDIA H200: 322.)
    EXPECT_LT(others, 640 * 360 / 500);
  }
}

TEST_F(Look, everyDepthConventionShowsTheSame) {
  FlatPane pane(gl, kRake, 0.8, 64);
  pane.putFilm([](double u, double) { return 2e-4 * (1.0 + std::sin(80.0 * u)); });
  pane.putDrops(scatter(pane, 200, 3e-3, glm::radians(60.0), 4));
  Scene scene = inside({320, 180});
  scene.picture = paint(scene.size_px, checks);
  const Picture usual = draw(gl, look, scene, {&pane.pane, 1});
  glm::dmat4& clip = scene.view.clipFromEye;  // infinite, reversed, 0 .. 1
  clip[2] = glm::dvec4(0.0, 0.0, 0.0, -1.0);
  clip[3] = glm::dvec4(0.0, 0.0, 0.05, 0.0);
  scene.view.clip_zero_to_one = scene.view.reversed_depth = true;
  EXPECT_LT(greatestDifference(usual, draw(gl, look, scene, {&pane.pane, 1})), 0.02f);
  scene.depth = 0.9f;  // something stands between eye and glass
  EXPECT_EQ(greatestDifference(draw(gl, look, scene, {&pane.pane, 1}), draw(gl, look, scene, {})), 0.0f);
}

TEST_F(Look, farFromTheWorldsOriginNothingTrembles) {
  FlatPane pane(gl, kRake, 0.8, 64);
  pane.putDrops(scatter(pane, 200, 2e-3, glm::radians(60.0), 5));
  Scene scene = inside({320, 180});
  scene.picture = paint(scene.size_px, checks);
  const Picture near = draw(gl, look, scene, {&pane.pane, 1});
  const glm::dmat4 away = glm::translate(glm::dmat4(1.0), glm::dvec3(1e6, -2e6, 30.0));
  scene.view.eyeFromWorld = scene.view.eyeFromWorld * glm::inverse(away);
  pane.pane.worldFromVehicle = away;
  // Doubles hold 2e-10 m there: far below a pixel, but a sample on an edge may fall to its other side.
  EXPECT_LT(greatestDifference(near, draw(gl, look, scene, {&pane.pane, 1})), 0.02f);
}

TEST_F(Look, mirroredUvsShowTheSameDrops) {
  const auto seen = [&](bool mirrored) {
    FlatPane pane(gl, kRake, 0.8, 64, mirrored);
    std::vector<GlassDropRecord> drops = scatter(pane, 100, 3e-3, glm::radians(60.0), 7);
    for (GlassDropRecord& drop : drops) drop.seed = 0;
    pane.putDrops(drops);
    Scene scene = inside({320, 180});
    scene.picture = paint(scene.size_px, checks);
    return draw(gl, look, scene, {&pane.pane, 1});
  };
  EXPECT_LT(greatestDifference(seen(false), seen(true)), 0.02f);  // as far as texture coordinates round
}

TEST_F(Look, aPaneSeenFromOutsideShowsTheSkyInItsDryGlass) {
  FlatPane pane(gl, kRake, 0.8, 64);
  Scene scene;
  scene.size_px = {160, 90};
  scene.view.eyeFromWorld =
      glm::lookAt(glm::dvec3(1.0, 0.0, 0.6), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
  scene.view.clipFromEye = forwardView(scene.size_px, glm::radians(20.0)).clipFromEye;
  scene.view.viewport_px = {0, 0, 160, 90};
  scene.picture = paint(scene.size_px, [](int, int) { return glm::vec3(0.5f); });
  const gl::TextureCube sky =
      makeCube(gl, 32, [](const glm::vec3& d) { return glm::vec3(d.z > 0.0f ? 2.0f : 0.0f); });
  scene.light.environment_cube = sky.name();
  const Picture seen = draw(gl, look, scene, {&pane.pane, 1});
  // The pane's normal (.5, 0, .87) against the view: about 28 degrees of incidence; two faces of index 1.52
  // give back 8.3 %.
  const double reflected = 0.083;
  EXPECT_NEAR(static_cast<double>(seen.at(80, 45).x), 0.5 * (1.0 - reflected) + 2.0 * reflected, 0.01);
}

}  // namespace
}  // namespace rg::test
