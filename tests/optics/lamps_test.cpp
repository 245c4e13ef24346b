// Lamps in drops, against rays traced one by one, and in the haze of droplets.
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "environment.h"
#include "flat_pane.h"
#include "gl_fixture.h"

namespace rg::test {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double kIndex = 1.333;  // of water
const double kSlope = glm::radians(30.0);
const dvec3 kEyeAt_m(-0.65, 0.0, 0.0);  // forwardView's

double meanFresnel(double cos_in, double cos_out, double n_in, double n_out) {
  const double rs = (n_in * cos_in - n_out * cos_out) / (n_in * cos_in + n_out * cos_out);
  const double rp = (n_out * cos_in - n_in * cos_out) / (n_out * cos_in + n_in * cos_out);
  return 0.5 * (rs * rs + rp * rp);
}

struct Bent {
  dvec3 direction{0.0};
  double share = 0.0;  // that goes through; 0: all is reflected
};

// Snell's law; `normal` against the ray.
Bent bend(const dvec3& d, const dvec3& normal, double n_in, double n_out) {
  const double cos_in = -glm::dot(d, normal);
  const double sin2 = (n_in / n_out) * (n_in / n_out) * (1.0 - cos_in * cos_in);
  if (sin2 >= 1.0) return {};
  const double cos_out = std::sqrt(1.0 - sin2);
  const dvec3 out = n_in / n_out * d + (n_in / n_out * cos_in - cos_out) * normal;
  return {glm::normalize(out), 1.0 - meanFresnel(cos_in, cos_out, n_in, n_out)};
}

// A cap on the flat pane, seen from the eye through the glass.
struct Drop {
  double radius_m, contact_rad;
  dvec3 outward = FlatPane::Axes(kSlope).outward;
  // Where a ray from the eye goes that enters by the base and leaves by the cap at the first face.
  Bent through(const dvec3& d) const {
    const double t = -glm::dot(kEyeAt_m, outward) / glm::dot(d, outward);
    const dvec3 on_base = kEyeAt_m + t * d;
    if (glm::length(on_base) >= radius_m) return {};
    const Bent within = bend(d, -outward, 1.0, kIndex);
    const double sphere_m = radius_m / std::sin(contact_rad);
    const dvec3 centre = -outward * (sphere_m * std::cos(contact_rad));
    const dvec3 from_centre = on_base - centre;
    const double b = glm::dot(from_centre, within.direction);
    const double s = -b + std::sqrt(b * b - glm::dot(from_centre, from_centre) + sphere_m * sphere_m);
    const dvec3 normal = (from_centre + s * within.direction) / sphere_m;
    Bent out = bend(within.direction, -normal, kIndex, 1.0);
    out.share *= within.share;
    return out;
  }
};

class LampsSeen : public GlTest {
 protected:
  LampsSeen() : black_(makeCube(gl, 8, [](const glm::vec3&) { return glm::vec3(0.0f); })) {}

  Scene dark(glm::ivec2 size_px, double fov_rad) {
    Scene scene;
    scene.size_px = size_px;
    scene.view = forwardView(size_px, fov_rad);
    scene.light.environment_cube = black_.name();
    scene.light.cabin_share = 0.05f;
    return scene;
  }
  static dvec3 rayOf(dvec2 px, glm::ivec2 size_px, double fov_rad) {
    const double per_px = 2.0 * std::tan(0.5 * fov_rad) / size_px.x;
    return glm::normalize(dvec3(1.0, -(px.x - 0.5 * size_px.x) * per_px, (px.y - 0.5 * size_px.y) * per_px));
  }

  glass::GlassLook look{gl};
  gl::TextureCube black_;
};

struct Case {
  double contact_deg;
  dvec3 lamp_m;
};
class HighlightInADrop : public LampsSeen, public ::testing::WithParamInterface<Case> {};

// A drop 37 pixels in radius, the lamp at a place of its upside-down world. Place and energy of what the drop
// shows there as brute force has them.
TEST_P(HighlightInADrop, liesWhereRaysMeetTheLampAndHoldsItsLight) {
  const glm::ivec2 size_px(320, 180);
  const double fov_rad = glm::radians(3.0);
  const Drop drop{4e-3, glm::radians(GetParam().contact_deg)};
  const dvec3 towards = glm::normalize(GetParam().lamp_m);
  const double irradiance = 500.0 / glm::dot(GetParam().lamp_m, GetParam().lamp_m);

  constexpr int kSub = 8;                     // rays along a pixel
  const double beam_rad = glm::radians(1.5);  // rays that end so near the lamp stand for those that meet it
  dvec2 expected_px(0.0);
  double expected = 0.0;
  for (int y = 0; y < size_px.y * kSub; ++y) {
    for (int x = 0; x < size_px.x * kSub; ++x) {
      const dvec2 px = (dvec2(x, y) + 0.5) / static_cast<double>(kSub);
      const Bent ray = drop.through(rayOf(px, size_px, fov_rad));
      if (ray.share == 0.0 || glm::dot(ray.direction, towards) < std::cos(beam_rad)) continue;
      expected += ray.share;
      expected_px += ray.share * px;
    }
  }
  ASSERT_GT(expected, 0.0);
  expected_px /= expected;
  const double solid_angle = glm::two_pi<double>() * (1.0 - std::cos(beam_rad));
  expected *= irradiance / solid_angle / (kSub * kSub);

  FlatPane pane(gl, kSlope, 0.8, 64);
  const shared::GlassDropRecord cap = pane.cap(0.0, 0.0, drop.radius_m, drop.contact_rad);
  pane.putDrops({&cap, 1});
  Scene scene = dark(size_px, fov_rad);
  scene.light.lamps.push_back({GetParam().lamp_m, glm::vec3(0.0f), glm::vec3(500.0f)});
  const Picture seen = draw(gl, look, scene, {&pane.pane, 1});
  double found = 0.0;
  dvec2 found_px(0.0);
  for (int y = 0; y < size_px.y; ++y) {
    for (int x = 0; x < size_px.x; ++x) {
      const dvec2 px(x + 0.5, y + 0.5);
      if (glm::distance(px, expected_px) > 12.0)
        continue;  // other highlights, by reflection within, lie farther
      found += static_cast<double>(seen.at(x, y).x);
      found_px += static_cast<double>(seen.at(x, y).x) * px;
    }
  }
  ASSERT_GT(found, 0.0);
  found_px /= found;
  // The kernel, some three pixels wide, leans towards where the drop shows the world larger.
  EXPECT_LT(glm::distance(found_px, expected_px), 1.0);
  EXPECT_NEAR(found / expected, 1.0, 0.15);  // near the rim it leans over the edge
}

INSTANTIATE_TEST_SUITE_P(Lamps, HighlightInADrop,
                         ::testing::Values(Case{40.0, {20.0, 3.5, 0.6}}, Case{60.0, {15.0, 3.5, 0.6}},
                                           Case{60.0, {8.0, -3.0, 1.5}}, Case{80.0, {30.0, -6.0, 0.0}},
                                           Case{80.0, {10.0, 6.0, 1.0}}));

// As many small drops in few pixels and in many: as much light of the lamp.
TEST_F(LampsSeen, smallDropsHoldAsMuchLightAtEverySize) {
  FlatPane pane(gl, kSlope, 0.8, 64);
  std::vector<shared::GlassDropRecord> drops;
  for (int k = 0; k < 400; ++k)
    drops.push_back(pane.cap(0.2 * std::fmod(0.618034 * k, 1.0) - 0.1, 0.2 * (k + 0.5) / 400 - 0.1, 1e-3,
                             glm::radians(60.0)));
  pane.putDrops(drops);
  const auto mean = [&](glm::ivec2 size_px) {
    Scene scene = dark(size_px, glm::radians(40.0));
    scene.light.lamps.push_back({{20.0, 3.5, 0.6}, glm::vec3(0.0f), glm::vec3(500.0f)});
    const Picture seen = draw(gl, look, scene, {&pane.pane, 1});
    double sum = 0.0;
    for (const glm::vec4& p : seen.pixels) sum += static_cast<double>(p.x);
    return sum / static_cast<double>(seen.pixels.size());
  };
  const double resolved = mean({1920, 1080});  // a drop is 8 pixels wide
  ASSERT_GT(resolved, 0.0);
  // One of a pixel's width shows the mean of twelve rays, whose kernels are as wide as half its view.
  EXPECT_NEAR(mean({320, 180}) / resolved, 1.0, 0.3);
  EXPECT_NEAR(mean({160, 90}) / resolved, 1.0, 0.3);
}

// What shines elsewhere, or not at all, changes no bit: the drops are drawn as without lamps.
TEST_F(LampsSeen, darkLampsChangeNothing) {
  FlatPane pane(gl, kSlope, 0.8, 64);
  const shared::GlassDropRecord cap = pane.cap(0.0, 0.0, 4e-3, glm::radians(60.0));
  pane.putDrops({&cap, 1});
  Scene scene = dark({320, 180}, glm::radians(3.0));
  const gl::TextureCube sky = makeCube(gl, 32, [](const glm::vec3& d) { return 0.5f * (d + 1.0f); });
  scene.light.environment_cube = sky.name();
  const Picture without = draw(gl, look, scene, {&pane.pane, 1});
  scene.light.lamps.push_back({{15.0, 3.5, 0.6}, glm::vec3(0.0f), glm::vec3(0.0f)});
  scene.light.lamps.push_back({{15.0, 3.5, 0.6}, glm::vec3(1.0f, 0.0f, 0.0f), glm::vec3(500.0f), 0.9f, 0.8f});
  EXPECT_EQ(greatestDifference(draw(gl, look, scene, {&pane.pane, 1}), without), 0.0f);
}

// Without an environment drops look into the visible picture, which shows the lamps that lie in it.
TEST_F(LampsSeen, aLampInTheVisiblePictureIsNotShownTwice) {
  FlatPane pane(gl, kSlope, 0.8, 64);
  const shared::GlassDropRecord cap = pane.cap(0.0, 0.0, 4e-3, glm::radians(20.0));
  pane.putDrops({&cap, 1});
  const auto light = [&](const dvec3& lamp_m) {
    Scene scene = dark({320, 180}, glm::radians(60.0));
    scene.light.environment_cube = 0;
    scene.light.lamps.push_back({lamp_m, glm::vec3(0.0f), glm::vec3(500.0f)});
    double sum = 0.0;
    for (const glm::vec4& p : draw(gl, look, scene, {&pane.pane, 1}).pixels) sum += static_cast<double>(p.x);
    return sum;
  };
  EXPECT_EQ(light({20.0, 0.0, 0.0}), 0.0);
  EXPECT_GT(light({5.0, 4.0, 8.0}), 0.0);
}

// Haze spreads a lamp's light and keeps it: beads too small to be seen one by one cover some of all the
// picture.
TEST_F(LampsSeen, hazeMakesAHaloOfAllTheLightItTakesFromTheLamp) {
  FlatPane pane(gl, kSlope, 0.8, 256);
  pane.putBeads([](double, double) { return 60; }, 0.4, glm::radians(25.0));
  const glm::ivec2 size_px(640, 360);
  Scene scene = dark(size_px, glm::radians(40.0));
  scene.light.lamps.push_back({{20.0, 0.0, 0.0}, glm::vec3(0.0f), glm::vec3(500.0f)});
  scene.picture.assign(640 * 360, glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
  for (int k = 0; k < 4; ++k)
    scene.picture[static_cast<size_t>((180 + k / 2) * 640 + 320 + k % 2)] = glm::vec4(1000.0f);
  const Picture plain = draw(gl, look, scene, {}), hazy = draw(gl, look, scene, {&pane.pane, 1});
  double lamp = 0.0, direct = 0.0, halo = 0.0;
  for (int y = 0; y < size_px.y; ++y) {
    for (int x = 0; x < size_px.x; ++x) {
      const bool in_lamp = std::abs(x - 320) <= 2 && std::abs(y - 180) <= 2;
      (in_lamp ? direct : halo) += static_cast<double>(hazy.at(x, y).x);
      lamp += static_cast<double>(plain.at(x, y).x);
    }
  }
  const double covered = 1.0 - direct / lamp;
  EXPECT_GT(covered, 0.3);
  EXPECT_LT(covered, 0.6);
  EXPECT_NEAR(halo / (covered * lamp), 1.0, 0.1);  // mips are boxes, read between their middles
}

}  // namespace
}  // namespace rg::test
