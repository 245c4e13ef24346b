// What is too small to be traced drop by drop shows in the mean what drops do: as much light, from where it
// comes.
#include <algorithm>
#include <cmath>

#include "look.h"
#include "shared/glass_beads.glsl"

namespace rg::test {
namespace {

using shared::GlassDropRecord;

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
    EXPECT_NEAR(bead_light / drop_light, 1.0, 0.12) << size_px.x;
    scene.picture = paint(size_px, [](int, int) { return glm::vec3(1.0f); });
    const double bead_specks = darkestOf(draw(gl, look, scene, {&beads.pane, 1})),
                 drop_specks = darkestOf(draw(gl, look, scene, {&drops.pane, 1}));
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

}  // namespace
}  // namespace rg::test
