// The renderer on a scene made here: what it must keep to whatever the models are.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "host_render/boxes.h"
#include "render/renderer.h"

namespace host {
namespace {

constexpr glm::ivec2 kSize{160, 90};

/// Grey ground; a red box 10 m ahead (+x) that hides part of a green one at 20 m.
Scene twoBoxes() {
  Scene scene;
  scene.materials = {paint(glm::vec3(0.2F)), paint({0.7F, 0.02F, 0.02F}), paint({0.02F, 0.7F, 0.02F})};
  add(scene, box({-100, -1, -100}, {100, 0, 100}, 0));
  add(scene, box({20, 0, -3}, {21, 3, 3}, 2));
  add(scene, box({10, 0, -1}, {11, 2, 1}, 1));
  return scene;
}

struct Drawn : testing::Test {
  std::unique_ptr<Context> context = makeHeadlessContext(true);
  Renderer renderer{*context};
  Target target{*context, kSize};
  Picture picture{*context, kSize};
  Sky sky;

  std::vector<std::uint8_t> draw(glm::dvec3 origin_m = glm::dvec3(0.0),
                                 std::span<const InstanceId> whole = {}) {
    const glm::dvec3 eye = origin_m + glm::dvec3(0.0, 0.0, 1.5);
    const View view{glm::lookAt(glm::dvec3(0.0, 0.0, 1.5), glm::dvec3(1.0, 0.0, 1.4), glm::dvec3(0, 0, 1)) *
                        glm::translate(glm::dmat4(1.0), -origin_m),
                    reversedPerspective(1.0, kSize)};
    renderer.beginFrame(sky, eye);
    renderer.drawWorld(view, target, whole);
    renderer.toneMap(target, picture.framebuffer(), exposureFor(renderer.adaptingLuminance(eye)));
    EXPECT_EQ(context->glErrors(), 0U);
    return picture.read();
  }
  static glm::ivec3 at(const std::vector<std::uint8_t>& rgb, int x, int y) {
    const auto i = static_cast<std::size_t>(3 * (y * kSize.x + x));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

TEST_F(Drawn, nearHidesFar) {
  renderer.addInstance(renderer.addScene(twoBoxes(), SceneFrame::Road));
  sky.rain_mm_h = 5.0;
  const auto rgb = draw();
  const glm::ivec3 middle = at(rgb, 80, 48), beside = at(rgb, 99, 30);
  EXPECT_GT(middle.x, 2 * middle.y);
  EXPECT_GT(beside.y, 2 * beside.x);
}

TEST_F(Drawn, isTheSameAThousandKilometresAway) {
  const InstanceId road = renderer.addInstance(renderer.addScene(twoBoxes(), SceneFrame::Road));
  sky.rain_mm_h = 5.0;
  const auto here = draw();
  const glm::dvec3 far_m(1.024e6, -1.024e6, 0.0);
  Placement far_away;
  far_away.world_from_host = glm::translate(glm::dmat4(1.0), far_m);
  renderer.place(road, far_away);
  const auto there = draw(far_m);
  int worst = 0;
  for (std::size_t i = 0; i < here.size(); ++i)
    worst = std::max(worst, std::abs(int{here[i]} - int{there[i]}));
  EXPECT_LE(worst, 1);  // the eye's own position is rounded to 0.1 nm there; one grey level of rounding
}

TEST_F(Drawn, aCarSeenFromOutsideHasItsWipers) {
  Scene body;  // a car's file looks along +z
  body.materials = {paint({0.7F, 0.02F, 0.02F}), paint({0.02F, 0.7F, 0.02F})};
  add(body, box({-3, 0, 20}, {3, 3, 21}, 1));
  add(body, box({-1, 0, 10}, {1, 2, 11}, 0));
  body.nodes.back().meaning = WiperMeaning{};
  const InstanceId car = renderer.addInstance(renderer.addScene(body, SceneFrame::Car));
  sky.rain_mm_h = 5.0;
  const auto rgb = draw(glm::dvec3(0.0), {&car, 1});
  const glm::ivec3 middle = at(rgb, 80, 48), beside = at(rgb, 99, 30);
  EXPECT_GT(middle.x, 2 * middle.y);
  EXPECT_GT(beside.y, 2 * beside.x);
}

// A mirror 3 m ahead, facing the eye: on the left it shows the green box that stands behind the eye on the
// left, and nothing of the red one that stands behind the mirror; on the right what of its car is there.
TEST_F(Drawn, aCarsMirrorShowsWhatStandsBeforeItAndItsOwnCar) {
  Scene scene = twoBoxes();
  scene.meshes[1].primitives = {box({-10, 0, -4}, {-9, 3, -2}, 2)};
  scene.meshes[2].primitives = {box({4, 0, -3}, {5, 3, 3}, 1)};
  renderer.addInstance(renderer.addScene(scene, SceneFrame::Road));
  Scene body;
  body.materials = {paint({0.02F, 0.02F, 0.7F}), paint({0.7F, 0.02F, 0.02F})};
  body.materials[1].double_sided = true;
  add(body, box({-4, 0, -10}, {-2, 3, -9}, 0));
  add(body, box({-1, 0.7F, 3}, {1, 2.3F, 3.001F}, 1));  // the mirror's own face, in its plane
  const InstanceId car = renderer.addInstance(renderer.addScene(body, SceneFrame::Car));
  const std::array<glm::vec3, 4> corners{
      {{3.0F, 1.0F, 0.7F}, {3.0F, -1.0F, 0.7F}, {3.0F, -1.0F, 2.3F}, {3.0F, 1.0F, 2.3F}}};
  const std::array<std::uint32_t, 6> triangles{0, 1, 2, 0, 2, 3};
  renderer.addMirror(car, corners, triangles, {-1.0F, 0.0F, 0.0F});
  sky.rain_mm_h = 5.0;
  draw();
  renderer.drawMirrors(
      {glm::lookAt(glm::dvec3(0.0, 0.0, 1.5), glm::dvec3(1.0, 0.0, 1.4), glm::dvec3(0, 0, 1)),
       reversedPerspective(1.0, kSize)},
      target);
  renderer.toneMap(target, picture.framebuffer(), exposureFor(renderer.adaptingLuminance({0.0, 0.0, 1.5})));
  const auto rgb = picture.read();
  EXPECT_EQ(context->glErrors(), 0U);
  const int left = 80 - static_cast<int>(80.0 * 3.0 * 3.0 / 15.5 / (3.0 * std::tan(0.5)));
  EXPECT_GT(at(rgb, left, 32).y, 2 * at(rgb, left, 32).x) << "green, where its image lies";
  const glm::ivec3 right = at(rgb, 160 - left, 32), beside = at(rgb, 8, 32);
  EXPECT_GT(right.z, 2 * right.x) << "its car, and nothing red";
  EXPECT_GT(beside.x, 2 * beside.y) << "beside it there is";
}

// Far away, or in a small picture.
TEST_F(Drawn, aMirrorOfAFewPixelsIsDrawn) {
  const InstanceId road = renderer.addInstance(renderer.addScene(twoBoxes(), SceneFrame::Road));
  const std::array<glm::vec3, 3> corners{{{3.0F, 0.05F, 1.4F}, {3.0F, -0.05F, 1.4F}, {3.0F, 0.0F, 1.5F}}};
  renderer.addMirror(road, corners, std::array<std::uint32_t, 3>{0, 1, 2}, {-1.0F, 0.0F, 0.0F});
  const auto without = draw();
  renderer.drawMirrors(
      {glm::lookAt(glm::dvec3(0.0, 0.0, 1.5), glm::dvec3(1.0, 0.0, 1.4), glm::dvec3(0, 0, 1)),
       reversedPerspective(1.0, kSize)},
      target);
  renderer.toneMap(target, picture.framebuffer(), exposureFor(renderer.adaptingLuminance({0.0, 0.0, 1.5})));
  EXPECT_NE(picture.read(), without);
  EXPECT_EQ(context->glErrors(), 0U);
}

TEST_F(Drawn, theSunCastsShadowsAndRainHidesIt) {
  Scene scene = twoBoxes();
  add(scene, box({4, 6, -3}, {8, 6.5F, 3}, 0));  // a slab above the ground ahead
  renderer.addInstance(renderer.addScene(scene, SceneFrame::Road));
  sky.to_sun = {0.0F, 0.0F, 1.0F};
  const auto sunny = draw();
  const int lit = at(sunny, 20, 48).y, shaded = at(sunny, 80, 66).y;
  EXPECT_GT(lit, shaded + 40);
  sky.rain_mm_h = 5.0;
  const auto rainy = draw();
  EXPECT_LT(std::abs(at(rainy, 20, 48).y - at(rainy, 80, 66).y), 25);
}

TEST_F(Drawn, wetGroundIsDarkerWhereItDoesNotMirror) {
  Scene scene;
  scene.materials = {paint(glm::vec3(0.3F))};  // roughness 1: no film stands on it
  add(scene, box({-100, -1, -100}, {100, 0, 100}, 0));
  renderer.addInstance(renderer.addScene(scene, SceneFrame::Road));
  sky.rain_mm_h = 5.0;
  const int dry = at(draw(), 80, 85).y;
  sky.wetness = 1.0;
  const int wet = at(draw(), 80, 85).y;
  EXPECT_LT(wet, dry - 10);  // Lekner & Dorf: 0.30 -> 0.19
  EXPECT_GT(wet, dry / 2);
}

TEST_F(Drawn, aShelterIsDarkInside) {
  Scene scene = twoBoxes();
  for (const auto& [min, max] : {std::pair(glm::vec3(-20, 0, -5), glm::vec3(8, 6, -4.5F)),
                                 std::pair(glm::vec3(-20, 0, 4.5F), glm::vec3(8, 6, 5)),
                                 std::pair(glm::vec3(-20, 5.5F, -5), glm::vec3(8, 6, 5))}) {
    add(scene, box(min, max, 0));
  }
  add(scene, box({-20, 0.05F, -4.4F}, {8, 5.4F, 4.4F}, 0));
  scene.nodes.back().meaning = ShelterMeaning{"tunnel"};
  renderer.addInstance(renderer.addScene(scene, SceneFrame::Road));
  sky.rain_mm_h = 5.0;
  renderer.beginFrame(sky, glm::dvec3(0.0));
  EXPECT_LT(renderer.skyVisibility({-10, 0, 1.5}), 0.3);
  EXPECT_GT(renderer.skyVisibility({30, 0, 1.5}), 0.99);
  EXPECT_LT(renderer.adaptingLuminance({-10, 0, 1.5}), 0.6 * renderer.adaptingLuminance({30, 0, 1.5}));
  EXPECT_EQ(context->glErrors(), 0U);
}

// A lamp ahead of a car lights the ground before it, and not the ground behind it, which the eye looks down
// on.
TEST_F(Drawn, aCarHidesLampsFromTheGroundBehindIt) {
  Scene scene;
  scene.materials = {paint(glm::vec3(0.3F))};
  add(scene, box({-100, -1, -100}, {100, 0, 100}, 0));
  scene.lights.emplace_back().intensity = 20000.0F;
  Node lamp;
  lamp.in_scene = true;
  lamp.light = 0;
  lamp.meaning = LightMeaning{LightRole::Street};
  lamp.local[3] = lamp.scene_from_node[3] = {14.0F, 3.0F, 0.0F, 1.0F};
  lamp.has_matrix = true;
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  scene.order.push_back(static_cast<int>(scene.nodes.size()));
  scene.nodes.push_back(lamp);
  const InstanceId road = renderer.addInstance(renderer.addScene(scene, SceneFrame::Road));
  Scene body;
  body.materials = {paint(glm::vec3(0.2F))};
  add(body, box({-1, 0.2F, -2}, {1, 1.4F, 2}, 0));
  const InstanceId car = renderer.addInstance(renderer.addScene(body, SceneFrame::Car));
  Placement placed;
  placed.world_from_host = glm::translate(glm::dmat4(1.0), glm::dvec3(8.0, 0.0, 0.0));
  renderer.place(car, placed);
  sky.rain_mm_h = 5.0;
  sky.to_sun = {0.0F, 1.0F, -1.0F};  // night

  Placement with, without;
  without.lamp_levels[static_cast<std::size_t>(LightRole::Street)] = 0.0F;
  const auto by_lamp = [&](int x, int y) {
    renderer.place(road, with);
    const int lit = at(draw(), x, y).y;
    renderer.place(road, without);
    return lit - at(draw(), x, y).y;
  };
  EXPECT_GT(by_lamp(10, 75), 10) << "beside it";
  EXPECT_LT(by_lamp(80, 75), by_lamp(10, 75) / 5) << "behind it";
}

TEST_F(Drawn, aPictureOfTheSurroundingsIsSeenWhereItLies) {
  // Red ahead (+x, the middle column), blue elsewhere.
  constexpr int width = 64, height = 32;
  std::vector<float> rgb;
  for (int i = 0; i < width * height; ++i) {
    const bool ahead = std::abs(i % width - width / 2) < 12;
    rgb.insert(rgb.end(), {ahead ? 1.0F : 0.0F, 0.0F, ahead ? 0.0F : 1.0F});
  }
  renderer.setEnvironment(rgb, width, height);
  draw();
  renderer.encodeSrgb(target, picture.framebuffer());
  const glm::ivec3 middle = at(picture.read(), 80, 45);
  EXPECT_GE(middle.x, 253);  // half floats and two filterings
  EXPECT_LE(middle.z, 2);
}

TEST_F(Drawn, smoothingBlendsASlantedEdgeInPlaceAndLeavesTheRest) {
  // Bright above a line that rises one pixel in five, dark below it.
  constexpr float kDark = 0.2F, kBright = 8.0F, kExposure = 0.5F;
  const auto line = [](int x) { return 30 + x / 5; };
  std::vector<glm::vec4> before, after(static_cast<std::size_t>(kSize.x * kSize.y));
  for (int i = 0; i < kSize.x * kSize.y; ++i)
    before.emplace_back(glm::vec3(i / kSize.x >= line(i % kSize.x) ? kBright : kDark), 1.0F);
  const GladGLContext& gl = context->gl();
  gl.TextureSubImage2D(target.colour(), 0, 0, 0, kSize.x, kSize.y, GL_RGBA, GL_FLOAT, before.data());
  renderer.smooth(target, static_cast<double>(kExposure));
  gl.GetTextureImage(target.colour(), 0, GL_RGBA, GL_FLOAT,
                     static_cast<GLsizei>(after.size() * sizeof(glm::vec4)), after.data());
  EXPECT_EQ(context->glErrors(), 0U);

  const auto seen = [&](float radiance) { return radiance / (1.0F / kExposure + radiance); };
  int blended = 0;
  double moved = 0.0;
  for (int y = 0; y < kSize.y; ++y) {
    for (int x = 20; x < kSize.x - 20; ++x) {
      const auto i = static_cast<std::size_t>(y * kSize.x + x);
      const float now = after[i].x;
      EXPECT_GE(now, kDark * 0.99F);  // half floats and the way there and back
      EXPECT_LE(now, kBright * 1.01F);
      if (std::abs(y - line(x)) > 3) {
        EXPECT_NEAR(now, before[i].x, 1e-3F * before[i].x) << x << " " << y;  // half floats
      }
      blended += now > 2.0F * kDark && now < 0.5F * kBright ? 1 : 0;
      moved += static_cast<double>(seen(now) - seen(before[i].x));
    }
  }
  EXPECT_GT(blended, 60);  // of 120 columns, at least every second has a pixel between
  // The edge stays where it is: what is added on one side is taken on the other, to a tenth of a pixel.
  EXPECT_LT(std::abs(moved) / static_cast<double>(seen(kBright) - seen(kDark)) / 120.0, 0.1);
}

TEST_F(Drawn, captureClearsWhatWasThere) {
  renderer.addInstance(renderer.addScene(twoBoxes(), SceneFrame::Road));
  sky.rain_mm_h = 5.0;
  renderer.beginFrame(sky, glm::dvec3(0.0));
  const glm::dmat4 ahead = glm::lookAt(glm::dvec3(0, 0, 1.5), glm::dvec3(1, 0, 1.5), glm::dvec3(0, 0, 1));
  const glm::dmat4 up = glm::lookAt(glm::dvec3(0, 0, 1.5), glm::dvec3(0, 0, 2.5), glm::dvec3(1, 0, 0));
  renderer.drawScene(target.framebuffer(), kSize, ahead, reversedPerspective(1.0, kSize));
  renderer.drawScene(target.framebuffer(), kSize, up, reversedPerspective(1.0, kSize));
  renderer.toneMap(target, picture.framebuffer(), 0.2);
  const glm::ivec3 middle = at(picture.read(), 80, 45);
  EXPECT_LT(std::abs(middle.x - middle.z), 40);  // grey sky, no box
  EXPECT_GT(middle.y, 40);
  EXPECT_EQ(context->glErrors(), 0U);
}

}  // namespace
}  // namespace host
