// What is seen through a wet pane, against the laws of optics.
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "environment.h"
#include "flat_pane.h"
#include "gl_fixture.h"
#include "shared/glass_crater.glsl"

namespace rg::test {
namespace {

using shared::GlassDropRecord;

const double kRake = glm::radians(30.0);
const double kFov = glm::radians(40.0);

std::vector<glm::vec4> paint(glm::ivec2 size_px, const std::function<glm::vec3(int x, int y)>& color) {
  std::vector<glm::vec4> pixels;
  for (int y = 0; y < size_px.y; ++y) {
    for (int x = 0; x < size_px.x; ++x) pixels.emplace_back(color(x, y), 1.0f);
  }
  return pixels;
}

std::vector<GlassDropRecord> scatter(const FlatPane& pane, int count, double radius_m, double contact_rad,
                                     uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-0.12, 0.12);
  std::vector<GlassDropRecord> drops;
  for (int k = 0; k < count; ++k) {
    drops.push_back(pane.cap(place(random), place(random), radius_m, contact_rad));
    drops.back().seed = static_cast<uint32_t>(k) * 7919u + 1u;
  }
  return drops;
}

glm::vec3 checks(int x, int y) { return glm::vec3(static_cast<float>((x / 8 + y / 8) % 2)); }

class Look : public GlTest {
 protected:
  Scene inside(glm::ivec2 size_px) const {
    Scene scene;
    scene.size_px = size_px;
    scene.view = forwardView(size_px, kFov);
    return scene;
  }
  glass::GlassLook look{gl};
};

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

// A pupil's points see drops elsewhere before what is far away: the picture is the mean of theirs, here
// of 37.
TEST_F(Look, dropsOutOfFocusAreTheMeanOfWhatThePupilsPointsSee) {
  FlatPane pane(gl, kRake, 0.8, 128);
  pane.putDrops(scatter(pane, 40, 4e-3, glm::radians(50.0), 5));
  pane.putBeads([](double u, double v) { return std::abs(u) < 0.02 && std::abs(v) < 0.03 ? 1 : 0; }, 0.2,
                glm::radians(40.0));
  const gl::TextureCube cube =
      makeCube(gl, 16, [](const glm::vec3& towards) { return glm::vec3(towards.z > 0.0f ? 1.0f : 0.1f); });
  Scene scene = inside({192, 108});
  const glm::vec3 behind(0.4f, 0.5f, 0.6f);
  scene.picture = paint(scene.size_px, [&](int, int) { return behind; });
  scene.light.environment_cube = cube.name();
  scene.depths.assign(scene.picture.size(), 1.0f);
  constexpr double kPupil_m = 0.01;
  look.settings.pupil_m = static_cast<float>(kPupil_m);
  const Picture unsharp = draw(gl, look, scene, {&pane.pane, 1});

  look.settings.pupil_m = 0.0f;
  Picture mean, sharp;
  int eyes = 0;
  for (int k = 0; k < 49; ++k) {
    const glm::dvec2 at = glm::dvec2(k % 7 - 3, k / 7 - 3) / 7.0 * kPupil_m;
    if (glm::length(at) > 0.5 * kPupil_m) continue;
    scene.view = forwardView(scene.size_px, kFov, {-0.65, at.x, at.y});
    const Picture seen = draw(gl, look, scene, {&pane.pane, 1});
    if (glm::length(at) == 0.0) sharp = seen;
    if (mean.pixels.empty()) mean = {seen.width, seen.height, std::vector<glm::vec4>(seen.pixels.size())};
    for (size_t p = 0; p < seen.pixels.size(); ++p) mean.pixels[p] += seen.pixels[p];
    ++eyes;
  }
  double wrong = 0.0, sharp_wrong = 0.0, drawn = 0.0, light = 0.0, mean_light = 0.0;
  for (size_t p = 0; p < mean.pixels.size(); ++p) {
    const glm::dvec3 oracle = glm::dvec3(mean.pixels[p]) / static_cast<double>(eyes);
    const glm::dvec3 got(unsharp.pixels[p]);
    wrong += glm::dot(got - oracle, got - oracle);
    sharp_wrong += glm::dot(glm::dvec3(sharp.pixels[p]) - oracle, glm::dvec3(sharp.pixels[p]) - oracle);
    drawn += glm::dot(oracle - glm::dvec3(behind), oracle - glm::dvec3(behind));
    light += got.x - static_cast<double>(behind.x);
    mean_light += oracle.x - static_cast<double>(behind.x);
  }
  // A few texels stand for the disc, and the drops' own light is as the pupil's middle sees it.
  EXPECT_LT(std::sqrt(wrong / drawn), 0.45);
  EXPECT_GT(std::sqrt(sharp_wrong / drawn), 2.0);
  EXPECT_NEAR(light / mean_light, 1.0, 0.03);
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

// Something black in the picture's left half, bright sky all around; what wet glass makes of it.
class NearThing : public Look {
 protected:
  // Film that bends views by some 30 pixels to either side, drops, and the thing where `along_m(row)`
  // of the view says.
  Picture seenWith(bool reversed, double film_m, int drops, const std::function<double(int y)>& along_m) {
    FlatPane pane(gl, kRake, 0.8, 64);
    pane.putFilm([&](double u, double) { return film_m * (1.0 + std::sin(80.0 * u)); });
    if (drops > 0) pane.putDrops(scatter(pane, drops, 3e-3, glm::radians(60.0), 8));
    const gl::TextureCube white = makeCube(gl, 8, [](const glm::vec3&) { return glm::vec3(1.0f); });
    Scene scene = inside({320, 180});
    scene.light.environment_cube = white.name();
    scene.picture = paint(scene.size_px, [](int x, int) { return glm::vec3(x < 160 ? 0.0f : 1.0f); });
    if (reversed) {
      scene.view.clipFromEye[2] = glm::dvec4(0.0, 0.0, 0.0, -1.0);
      scene.view.clipFromEye[3] = glm::dvec4(0.0, 0.0, 0.05, 0.0);
      scene.view.clip_zero_to_one = scene.view.reversed_depth = true;
    }
    for (int y = 0; y < 180; ++y) {
      const glm::dvec4 clip = scene.view.clipFromEye * glm::dvec4(0.0, 0.0, -along_m(y), 1.0);
      const double ndc = clip.z / clip.w;
      const auto thing = static_cast<float>(reversed ? ndc : 0.5 * ndc + 0.5);
      for (int x = 0; x < 320; ++x) scene.depths.push_back(x < 160 ? thing : reversed ? 0.0f : 1.0f);
    }
    return draw(gl, look, scene, {&pane.pane, 1});
  }
  // A blade's plane `behind_m` off the glass.
  static std::function<double(int)> blade(double behind_m) {
    return [=](int y) {
      const FlatPane::Axes axes(kRake);
      const glm::dvec3 eye_m(-0.65, 0.0, 0.0);
      // Where the pixels' rays, which all lean by the row alone, meet that plane.
      const double rise = (y + 0.5 - 90.0) / 160.0 * std::tan(0.5 * kFov);
      return (behind_m - glm::dot(eye_m, axes.outward)) / glm::dot(glm::dvec3(1.0, 0.0, rise), axes.outward);
    };
  }
  // Mean light of the left half's middle strip, with drops and film in front of it.
  double lightOfBlade(double behind_m, bool reversed) {
    const Picture seen = seenWith(reversed, 2e-4, 1500, blade(behind_m));
    double sum = 0.0;
    for (int y = 60; y < 120; ++y) {
      for (int x = 40; x < 150; ++x) sum += static_cast<double>(seen.at(x, y).x);
    }
    return sum / (60.0 * 110.0);
  }
  // The darkest that wavy film makes the right half, where the sky is.
  static double darkestBeside(const Picture& seen) {
    double least = 1.0;
    for (int y = 60; y < 120; ++y) {
      for (int x = 161; x < 300; ++x) least = std::min(least, static_cast<double>(seen.at(x, y).x));
    }
    return least;
  }
};

// A pillar stands before the glass, a blade close behind it: neither is drawn into the view beside it. Steep
// film reflects the cabin a little, which is dark by it.
TEST_F(NearThing, pillarAndBladeHaveNoFringe) {
  const auto pillar = [](int) { return 0.3; };
  for (const bool reversed : {false, true}) {
    EXPECT_GT(darkestBeside(seenWith(reversed, 2e-3, 0, pillar)), 0.95) << reversed;
    EXPECT_GT(darkestBeside(seenWith(reversed, 2e-3, 0, blade(0.03))), 0.95) << reversed;
  }
}

// ... but what stands far off is bent into it, as by any lens.
TEST_F(NearThing, whatStandsFarOffIsSeenBent) {
  EXPECT_LT(darkestBeside(seenWith(false, 2e-3, 0, blade(20.0))), 0.1);
}

TEST_F(NearThing, aBladeCloseBehindWetGlassStaysWholeInEveryDepthConvention) {
  EXPECT_LT(lightOfBlade(0.03, false), 0.01);
  EXPECT_LT(lightOfBlade(0.03, true), 0.01);
}

TEST_F(NearThing, whatStandsFartherOffIsLookedPastByDrops) {
  EXPECT_GT(lightOfBlade(2.0, false), 0.2);
  EXPECT_NEAR(lightOfBlade(2.0, true), lightOfBlade(2.0, false), 0.02);
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

double lightTaken(const Picture& with, const Picture& without) {
  double sum = 0.0;
  for (size_t k = 0; k < with.pixels.size(); ++k)
    sum += std::abs(static_cast<double>(without.pixels[k].x - with.pixels[k].x));
  return sum / static_cast<double>(with.pixels.size());
}

TEST_F(Look, dropsBelowAPixelCoverAsMuchAsTheyAre) {
  // Against a white sky with nothing else in the world drops are dark, so what they take from the picture is
  // their area.
  FlatPane pane(gl, kRake, 0.8, 64);
  std::vector<GlassDropRecord> drops = scatter(pane, 1500, 0.5e-3, glm::radians(60.0), 6);
  for (GlassDropRecord& drop : drops) drop.seed = 0;
  pane.putDrops(drops);
  const gl::TextureCube black = makeCube(gl, 8, [](const glm::vec3&) { return glm::vec3(0.0f); });
  const auto taken = [&](glm::ivec2 size_px) {
    Scene scene = inside(size_px);
    scene.light.environment_cube = black.name();
    scene.picture = paint(size_px, [](int, int) { return glm::vec3(1.0f); });
    return lightTaken(draw(gl, look, scene, {&pane.pane, 1}), draw(gl, look, scene, {}));
  };
  const double resolved = taken({1920, 1080});  // 2.8 pixels wide
  ASSERT_GT(resolved, 0.002);
  EXPECT_NEAR(taken({320, 180}) / resolved, 1.0, 0.25);  // a box a pixel wide stands for a disc
  EXPECT_NEAR(taken({160, 90}) / resolved, 1.0, 0.25);
}

// Share of a texel that its beads cover, of equal ones' share: sizes differ, and what is large covers less
// than as much water in small ones.
double coverOf(int number, double share) {
  const auto mean = static_cast<float>(std::sqrt(share / (glm::pi<double>() * number)));
  int covered = 0, places = 0;
  for (uint32_t texel = 0; texel < 300; ++texel) {
    for (int k = 0; k < 400; ++k, ++places) {
      const glm::vec2 place((static_cast<float>(k % 20) + 0.5f) / 20.0f,
                            (static_cast<float>(k / 20) + 0.5f) / 20.0f);
      const shared::SeatedBead bead = shared::seatedBead(texel, place, number, mean);
      covered += glm::distance(place, bead.middle) < bead.size * mean ? 1 : 0;
    }
  }
  return covered / share / places;
}

// Beads that are dark take as much light as they cover, whatever a pixel is; those too small to be seen one
// by one blur and take none.
TEST_F(Look, beadsCoverAsMuchAsTheyAre) {
  FlatPane pane(gl, kRake, 0.8, 256);
  const double share = 0.25;
  const gl::TextureCube black = makeCube(gl, 8, [](const glm::vec3&) { return glm::vec3(0.0f); });
  const auto taken = [&](int number, glm::ivec2 size_px) {
    pane.putBeads([&](double, double) { return number; }, share, glm::radians(25.0));
    Scene scene = inside(size_px);
    scene.light.environment_cube = black.name();
    scene.picture = paint(size_px, [](int, int) { return glm::vec3(1.0f); });
    return lightTaken(draw(gl, look, scene, {&pane.pane, 1}),
                      draw(gl, look, scene, {}));  // the pane fills the picture
  };
  for (const int number : {1, 4}) {
    const double seen = taken(number, {1920, 1080}) / share, law = coverOf(number, share);
    std::printf("%d: %g of equal ones' share, %g\n", number, seen, law);
    EXPECT_NEAR(seen / law, 1.0, 0.1) << number;  // of the smallest a part is a blur; parts cut faded edges
  }
  EXPECT_NEAR(taken(1, {960, 540}) / share, 1.0, 0.12);
  EXPECT_LT(taken(64, {160, 90}), 0.01);
}

// How dark the darkest hundredth of the pixels is.
double darkestOf(Picture picture) {
  const auto hundredth = picture.pixels.begin() + static_cast<std::ptrdiff_t>(picture.pixels.size() / 100);
  std::nth_element(picture.pixels.begin(), hundredth, picture.pixels.end(),
                   [](const glm::vec4& a, const glm::vec4& b) { return a.x < b.x; });
  return static_cast<double>(hundredth->x);
}

// A bead's light is a short way to what is traced through a drop of its size and shape: in the mean over many
// they show as much of a bright sky, a dim ground and a dark cabin, seen large or of about a pixel.
TEST_F(Look, beadsShowInTheMeanWhatDropsOfTheirShapeDo) {
  constexpr int kTexels = 100;
  constexpr double kTexel_m = 3e-3, kCovered = 0.12;
  const double contact_rad = glm::radians(30.0);
  const gl::TextureCube sky =
      makeCube(gl, 32, [](const glm::vec3& d) { return glm::vec3(d.z > 0.0f ? 1.0f : 0.2f); });
  const double radius_m = kTexel_m * std::sqrt(kCovered / glm::pi<double>());
  FlatPane beads(gl, kRake, kTexels * kTexel_m, kTexels), drops(gl, kRake, kTexels * kTexel_m, kTexels);
  beads.putBeads([](double, double) { return 1; }, kCovered, contact_rad);
  std::vector<GlassDropRecord> records;
  for (int y = 2; y < kTexels - 2; ++y) {
    for (int x = 2; x < kTexels - 2; ++x) {
      const auto mean = static_cast<float>(radius_m / kTexel_m);
      const shared::SeatedBead seat =
          shared::seatedBead(static_cast<uint32_t>(y * kTexels + x), glm::vec2(0.0f), 1, mean);
      const glm::dvec2 place(shared::gridPlace(glm::vec2(x, y) + seat.middle));
      records.push_back(drops.cap((place.x / kTexels - 0.5) * kTexels * kTexel_m,
                                  (place.y / kTexels - 0.5) * kTexels * kTexel_m, radius_m, contact_rad));
    }
  }
  drops.putDrops(records);
  for (const glm::ivec2 size_px : {glm::ivec2(1920, 1080), glm::ivec2(640, 360), glm::ivec2(480, 270)}) {
    Scene scene = inside(size_px);
    scene.view = forwardView(size_px, glm::radians(20.0));
    scene.light.environment_cube = sky.name();
    scene.picture = paint(size_px, [](int, int) { return glm::vec3(0.0f); });
    const double bead_light = lightTaken(draw(gl, look, scene, {&beads.pane, 1}), draw(gl, look, scene, {})),
                 drop_light = lightTaken(draw(gl, look, scene, {&drops.pane, 1}), draw(gl, look, scene, {}));
    std::printf("%d: %g %g\n", size_px.x, bead_light, drop_light);
    EXPECT_NEAR(bead_light / drop_light, 1.0, 0.12) << size_px.x;
    scene.picture = paint(size_px, [](int, int) { return glm::vec3(1.0f); });
    const double bead_specks = darkestOf(draw(gl, look, scene, {&beads.pane, 1})),
                 drop_specks = darkestOf(draw(gl, look, scene, {&drops.pane, 1}));
    std::printf("%d: %g %g\n", size_px.x, bead_specks, drop_specks);
    EXPECT_GT(bead_specks, drop_specks - 0.1) << size_px.x;
  }
}

// A lone bead shows the world upside down, as a drop does.
TEST_F(Look, aBeadShowsTheSkyBelowAndTheGroundAbove) {
  FlatPane pane(gl, glm::radians(90.0), 0.8, 64);
  pane.putBeads([](double u, double v) { return std::abs(u) < 0.1 && std::abs(v) < 0.1 ? 1 : 0; }, 0.4,
                glm::radians(60.0));
  const gl::TextureCube sky =
      makeCube(gl, 32, [](const glm::vec3& d) { return glm::vec3(d.z > 0.0f ? 1.0f : 0.0f); });
  Scene scene = inside({1280, 720});
  scene.light.environment_cube = sky.name();
  scene.picture = paint(scene.size_px, [](int, int y) { return glm::vec3(y > 360 ? 1.0f : 0.0f); });
  const Picture with = draw(gl, look, scene, {&pane.pane, 1}), without = draw(gl, look, scene, {});
  int brighter_below = 0, darker_above = 0, other = 0;
  for (int y = 0; y < 720; ++y) {
    for (int x = 0; x < 1280; ++x) {
      const float change = with.at(x, y).x - without.at(x, y).x;
      if (std::abs(change) < 0.5f || std::abs(y - 360) < 3) continue;
      (y > 360 ? darker_above : brighter_below) += 1;
      other += (y > 360) == (change > 0.0f) ? 1 : 0;
    }
  }
  EXPECT_GT(brighter_below, 4500);
  EXPECT_GT(darker_above, 4500);
  EXPECT_EQ(other, 0);
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
