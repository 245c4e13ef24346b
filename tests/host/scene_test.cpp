// Sound files load as what they say.
#include "scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gltf_files.h"
#include "loaded.h"

namespace {

using files::expectNear;
using files::Gltf;
using files::kRounding;
using files::load;
using files::TempFolder;
using host::Node;
using host::Primitive;
using host::Scene;

const Node& named(const Scene& scene, const char* name) {
  const int index = scene.findNode(name);
  if (index < 0) throw std::runtime_error(std::string("no node ") + name);
  return scene.nodes[static_cast<std::size_t>(index)];
}

const Primitive& firstPrimitive(const Scene& scene, const char* node) {
  return scene.meshes.at(static_cast<std::size_t>(named(scene, node).mesh)).primitives.at(0);
}

/// One primitive of four vertices in the plane z = 0 with its mode, indices and attributes to be chosen.
Gltf sheet(int mode, bool indexed) {
  Gltf g;
  const int positions = g.addFloats("VEC3", 3, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  files::Json primitive = {{"attributes", {{"POSITION", positions}}}, {"mode", mode}};
  if (indexed) primitive["indices"] = g.addIndices<std::uint32_t>(5125, {0, 1, 2, 3});
  g.add("meshes", {{"primitives", {primitive}}});
  g.add("nodes", {{"name", "sheet"}, {"mesh", 0}});
  return g;
}

float area(const Primitive& p) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < p.indices.size(); i += 3) {
    const glm::vec3& a = p.positions_m[p.indices[i]];
    // Signed: a triangle that is turned round counts against the others.
    sum += 0.5F * glm::cross(p.positions_m[p.indices[i + 1]] - a, p.positions_m[p.indices[i + 2]] - a).z;
  }
  return sum;
}

TEST(Scene, textAndBinaryFilesHoldTheSame) {
  const Gltf g = files::wholeCar();
  const TempFolder folder;
  folder.write("buffer.bin", g.bin);
  const Scene text = host::loadScene(folder.write("model.gltf", g.gltf()));
  const Scene binary = host::loadScene(folder.write("model.glb", g.glb()));
  ASSERT_EQ(text.nodes.size(), binary.nodes.size());
  ASSERT_EQ(text.meshes.size(), binary.meshes.size());
  for (std::size_t m = 0; m < text.meshes.size(); ++m) {
    EXPECT_EQ(text.meshes[m].primitives[0].positions_m, binary.meshes[m].primitives[0].positions_m);
    EXPECT_EQ(text.meshes[m].primitives[0].indices, binary.meshes[m].primitives[0].indices);
  }
  EXPECT_EQ(text.images.at(0).rgba, binary.images.at(0).rgba);
}

TEST(Scene, worldMatricesAreProductsAlongTheTree) {
  const Scene scene = load(files::wholeCar());
  expectNear(glm::vec3(named(scene, "wiper_l").scene_from_node[3]), {0.5F, 1.0F, 2.0F});
  // The wiper is turned a quarter about x: its +y points along the body's +z; the blade sits half a metre
  // along its +x.
  expectNear(glm::vec3(named(scene, "wiper_l").scene_from_node[1]), {0.0F, 0.0F, 1.0F});
  expectNear(glm::vec3(named(scene, "blade").scene_from_node[3]), {1.0F, 1.0F, 2.0F});
  EXPECT_EQ(scene.findNode("aside"), -1) << "a node outside the scene";
}

TEST(Scene, parentsComeBeforeChildren) {
  const Scene scene = load(files::wholeCar());
  std::vector<bool> seen(scene.nodes.size(), false);
  for (const int i : scene.order) {
    const Node& node = scene.nodes[static_cast<std::size_t>(i)];
    EXPECT_TRUE(node.in_scene);
    EXPECT_TRUE(node.parent < 0 || seen[static_cast<std::size_t>(node.parent)]);
    seen[static_cast<std::size_t>(i)] = true;
  }
}

TEST(Scene, materialsKeepFactorsTexturesAndModes) {
  const Scene scene = load(files::wholeCar());
  ASSERT_EQ(scene.materials.size(), 3U) << "two and the default one";
  const host::Material& glass = scene.materials[0];
  EXPECT_EQ(glass.base_colour, glm::vec4(0.25F, 0.5F, 0.75F, 0.125F));
  EXPECT_EQ(glass.metallic, 0.0F);
  EXPECT_EQ(glass.roughness, 0.0625F);
  EXPECT_EQ(glass.alpha_mode, host::AlphaMode::Blend);
  EXPECT_TRUE(glass.double_sided);
  ASSERT_TRUE(glass.base_colour_map);
  EXPECT_EQ(glass.base_colour_map.scale, glm::vec2(2.0F, 3.0F));
  EXPECT_EQ(glass.base_colour_map.sampler.mag_filter, 9728U);
  EXPECT_EQ(glass.base_colour_map.sampler.min_filter, 9984U);
  EXPECT_EQ(glass.base_colour_map.sampler.wrap_s, 33071U);
  EXPECT_EQ(glass.base_colour_map.sampler.wrap_t, 33648U);
  EXPECT_EQ(glass.normal_scale, 0.5F);
  EXPECT_FALSE(glass.emissive_map);
  const host::Material& glow = scene.materials[1];
  EXPECT_EQ(glow.emissive, glm::vec3(4.0F, 2.0F, 0.0F));
  EXPECT_EQ(glow.alpha_mode, host::AlphaMode::Mask);
  EXPECT_EQ(glow.alpha_cutoff, 0.25F);
  EXPECT_EQ(scene.materials[2].base_colour, glm::vec4(1.0F));
}

TEST(Scene, imagesAreDecodedToRgba) {
  const Scene scene = load(files::wholeCar());
  ASSERT_EQ(scene.images.size(), 1U);
  EXPECT_EQ(scene.images[0].width_px, 1);
  EXPECT_EQ(scene.images[0].rgba, (files::Bytes{200, 100, 50, 255}));
}

TEST(Scene, lightsKeepTheirNumbers) {
  const Scene scene = load(files::wholeCar());
  ASSERT_EQ(scene.lights.size(), 1U);
  const host::Light& light = scene.lights[0];
  EXPECT_EQ(light.kind, host::LightKind::Spot);
  EXPECT_EQ(light.intensity, 900.0F);
  EXPECT_EQ(light.range_m, 60.0F);
  EXPECT_EQ(light.inner_cone_rad, 0.2F);
  EXPECT_EQ(light.outer_cone_rad, 0.5F);
  EXPECT_EQ(light.colour, glm::vec3(1.0F, 0.9F, 0.8F));
  EXPECT_EQ(named(scene, "beam").light, 0);
}

TEST(Scene, missingNormalsAreThoseOfTheFaces) {
  const Scene scene = load(files::wholeCar());
  const Primitive& cube = firstPrimitive(scene, "cabin");
  ASSERT_EQ(cube.positions_m.size(), 36U) << "each triangle has vertices of its own";
  for (std::size_t v = 0; v < cube.positions_m.size(); ++v) {
    EXPECT_NEAR(glm::length(cube.normals[v]), 1.0F, kRounding);
    // Outward, on a cube about the origin: half its side along the normal.
    EXPECT_NEAR(glm::dot(cube.normals[v], cube.positions_m[v]), 0.5F, kRounding);
  }
  expectNear(cube.min_m, glm::vec3(-0.5F));
  expectNear(cube.max_m, glm::vec3(0.5F));
}

TEST(Scene, missingTangentsFollowTheTexture) {
  const Scene scene = load(files::wholeCar());
  const Primitive& quad = firstPrimitive(scene, "glass");
  ASSERT_EQ(quad.tangents.size(), 4U);
  for (const glm::vec4& tangent : quad.tangents) {
    expectNear(glm::vec3(tangent), {1.0F, 0.0F, 0.0F});
    // The bitangent points up the picture, towards smaller v: +y here.
    expectNear(glm::cross(glm::vec3(0.0F, 0.0F, 1.0F), glm::vec3(tangent)) * tangent.w, {0.0F, 1.0F, 0.0F});
  }
}

TEST(Scene, stripsFansAndBareVerticesBecomeTriangles) {
  const Scene strip = load(sheet(5, true));
  EXPECT_FLOAT_EQ(area(firstPrimitive(strip, "sheet")), 1.0F);
  EXPECT_FLOAT_EQ(area(firstPrimitive(load(sheet(5, false)), "sheet")), 1.0F);
  const Scene fan = load(sheet(6, false));  // 0 1 2 and 0 2 3: the second is turned round
  EXPECT_EQ(firstPrimitive(fan, "sheet").indices.size(), 6U);
  EXPECT_FLOAT_EQ(area(firstPrimitive(fan, "sheet")), 0.0F);
  EXPECT_FLOAT_EQ(area(firstPrimitive(load(sheet(4, false)), "sheet")), 0.5F)
      << "the fourth vertex makes no triangle";
}

TEST(Scene, pointsAndLinesAreLeftOutWithAWarning) {
  const Scene scene = load(sheet(1, false));
  EXPECT_TRUE(scene.meshes.at(0).primitives.empty());
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_NE(scene.warnings[0].find("mesh 0"), std::string::npos);
}

TEST(Scene, normalisedIntegersAndStridesAreRead) {
  Gltf g = sheet(4, false);
  // Colours as bytes, 4 to an element, every 8 bytes; the accessor begins 4 bytes into its view.
  files::Bytes bytes(36, 0);
  for (std::size_t v = 0; v < 4; ++v) bytes[4 + 8 * v] = static_cast<std::uint8_t>(51 * v);
  const int view = g.addView(bytes);
  g.json["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = 8;
  const int colours = g.add("accessors", {{"bufferView", view},
                                          {"byteOffset", 4},
                                          {"componentType", 5121},
                                          {"normalized", true},
                                          {"count", 4},
                                          {"type", "VEC4"}});
  g.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colours;
  const Scene scene = load(g);
  const Primitive& p = firstPrimitive(scene, "sheet");
  ASSERT_EQ(p.colours.size(), 3U);
  EXPECT_FLOAT_EQ(p.colours[1].x, 0.2F);
  EXPECT_FLOAT_EQ(p.colours[2].x, 0.4F);
}

TEST(Scene, animationMovesItsNodeAndWhatHangsOnIt) {
  const Scene scene = load(files::wholeCar());
  ASSERT_EQ(scene.animations.size(), 1U);
  EXPECT_EQ(scene.animations[0].duration_s, 3.0F);
  std::vector<host::Pose> poses = scene.restPoses();
  host::animate(scene.animations[0], 2.0F, poses);
  const auto blade = static_cast<std::size_t>(scene.findNode("blade"));
  expectNear(poses[blade].translation_m, {1.0F, 2.0F, 3.0F});
  // Half of a quarter turn about y.
  expectNear(poses[blade].rotation * glm::vec3(0.0F, 0.0F, 1.0F), {std::sqrt(0.5F), 0.0F, std::sqrt(0.5F)});
  // In the wiper's frame (x, y, z) is the body's (x, -z, y).
  expectNear(glm::vec3(scene.sceneFromNode(poses)[blade][3]), {0.5F + 1.0F, 1.0F - 3.0F, 2.0F + 2.0F});
}

host::AnimationChannel ramp(host::Interpolation interpolation) {
  host::AnimationChannel channel;
  channel.interpolation = interpolation;
  channel.times_s = {1.0F, 3.0F};
  channel.values = {glm::vec4(10.0F), glm::vec4(20.0F)};
  return channel;
}

TEST(AnimationChannel, holdsItsEnds) {
  for (const auto kind : {host::Interpolation::Step, host::Interpolation::Linear}) {
    EXPECT_EQ(ramp(kind).at(0.0F).x, 10.0F);
    EXPECT_EQ(ramp(kind).at(1.0F).x, 10.0F);
    EXPECT_EQ(ramp(kind).at(3.0F).x, 20.0F);
    EXPECT_EQ(ramp(kind).at(99.0F).x, 20.0F);
  }
}

TEST(AnimationChannel, stepsOrRunsStraight) {
  EXPECT_EQ(ramp(host::Interpolation::Step).at(2.999F).x, 10.0F);
  EXPECT_FLOAT_EQ(ramp(host::Interpolation::Linear).at(1.5F).x, 12.5F);
}

TEST(AnimationChannel, cubicSplineReproducesACubic) {
  // f(t) = t^3 - 2 t between 1 and 3: any cubic is its own Hermite spline.
  const auto f = [](float t) { return t * t * t - 2.0F * t; };
  const auto slope = [](float t) { return 3.0F * t * t - 2.0F; };
  host::AnimationChannel channel;
  channel.interpolation = host::Interpolation::CubicSpline;
  channel.times_s = {1.0F, 3.0F};
  for (const float t : channel.times_s) {
    channel.values.insert(channel.values.end(), {glm::vec4(slope(t)), glm::vec4(f(t)), glm::vec4(slope(t))});
  }
  for (float t = 1.0F; t <= 3.0F; t += 0.125F) EXPECT_NEAR(channel.at(t).x, f(t), 1e-4F) << t;
}

TEST(AnimationChannel, rotationsTakeTheShortWayAndStayUnit) {
  host::AnimationChannel channel;
  channel.property = host::AnimatedProperty::Rotation;
  channel.times_s = {0.0F, 1.0F};
  const float angle_rad = 0.8F;
  // The second key is the negative of a turn by 0.8 about z: the same rotation, the long way round as it
  // stands.
  channel.values = {glm::vec4(0, 0, 0, 1),
                    -glm::vec4(0, 0, std::sin(angle_rad / 2), std::cos(angle_rad / 2))};
  const glm::vec4 half = channel.at(0.5F);
  EXPECT_NEAR(glm::length(half), 1.0F, kRounding);
  EXPECT_NEAR(std::abs(half.z), std::sin(angle_rad / 4), kRounding);
}

}  // namespace
