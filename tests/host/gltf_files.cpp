#include "gltf_files.h"

namespace files {

namespace {

// Unit cube's corners: bit 0 is x, bit 1 is y, bit 2 is z.
std::vector<float> cubeCorners(float low, float high) {
  std::vector<float> corners;
  for (unsigned i = 0; i < 8; ++i) {
    for (unsigned axis = 0; axis < 3; ++axis) corners.push_back((i >> axis & 1U) != 0 ? high : low);
  }
  return corners;
}

const std::vector<std::uint8_t> kCubeTriangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};

int addCube(Gltf& g) {
  const int positions = g.addFloats("VEC3", 3, cubeCorners(-0.5F, 0.5F));
  const int indices = g.addIndices<std::uint8_t>(5121, kCubeTriangles);
  return g.add("meshes",
               {{"name", "cube"},
                {"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}});
}

// 1.5 x 0.8 m in the plane z = 0, facing +z.
int addQuad(Gltf& g, int material) {
  const int positions =
      g.addFloats("VEC3", 3, {-0.75F, -0.4F, 0, 0.75F, -0.4F, 0, 0.75F, 0.4F, 0, -0.75F, 0.4F, 0});
  const int normals = g.addFloats("VEC3", 3, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  const int uv = g.addFloats("VEC2", 2, {0, 1, 1, 1, 1, 0, 0, 0});
  const int indices = g.addIndices<std::uint16_t>(5123, {0, 1, 2, 0, 2, 3});
  const Json attributes = {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", uv}};
  return g.add("meshes", {{"name", "quad"},
                          {"primitives",
                           {{{"attributes", attributes}, {"indices", indices}, {"material", material}}}}});
}

void addMaterials(Gltf& g) {
  const int image =
      g.add("images", {{"name", "paint"}, {"mimeType", "image/png"}, {"bufferView", g.addView(tinyPng())}});
  const int sampler =
      g.add("samplers", {{"magFilter", 9728}, {"minFilter", 9984}, {"wrapS", 33071}, {"wrapT", 33648}});
  const int texture = g.add("textures", {{"source", image}, {"sampler", sampler}});
  g.add("materials",
        {{"name", "glass"},
         {"alphaMode", "BLEND"},
         {"doubleSided", true},
         {"normalTexture", {{"index", texture}, {"scale", 0.5}}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.25, 0.5, 0.75, 0.125}},
           {"metallicFactor", 0.0},
           {"roughnessFactor", 0.0625},
           {"baseColorTexture",
            {{"index", texture}, {"extensions", {{"KHR_texture_transform", {{"scale", {2.0, 3.0}}}}}}}}}}});
  g.add("materials", {{"name", "glow"},
                      {"emissiveFactor", {1.0, 0.5, 0.0}},
                      {"alphaMode", "MASK"},
                      {"alphaCutoff", 0.25},
                      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}}});
}

int addNode(Gltf& g, const char* name, Json meaning, Json more = Json::object()) {
  more["name"] = name;
  if (!meaning.is_null()) more["extras"]["rainglass"] = std::move(meaning);
  return g.add("nodes", more);
}

void addAnimation(Gltf& g, int node) {
  const int times = g.addFloats("SCALAR", 1, {1, 3});
  const int places = g.addFloats("VEC3", 3, {0, 0, 0, 2, 4, 6});
  const int turns = g.addFloats("VEC4", 4, {0, 0, 0, 1, 0, 0.70710678F, 0, 0.70710678F});
  g.add("animations",
        {{"name", "door"},
         {"samplers", {{{"input", times}, {"output", places}}, {{"input", times}, {"output", turns}}}},
         {"channels",
          {{{"sampler", 0}, {"target", {{"node", node}, {"path", "translation"}}}},
           {{"sampler", 1}, {"target", {{"node", node}, {"path", "rotation"}}}}}}});
}

void addLights(Gltf& g) {
  g.json["extensionsUsed"] = {"KHR_lights_punctual"};
  g.json["extensionsRequired"] = {"KHR_lights_punctual"};
  g.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"},
       {"name", "low beam"},
       {"color", {1.0, 0.9, 0.8}},
       {"intensity", 900.0},
       {"range", 60.0},
       {"spot", {{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}}}};
}

}  // namespace

Bytes tinyPng() {
  return {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48,
          0x44, 0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00,
          0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78,
          0x9c, 0x63, 0x38, 0x91, 0x62, 0x04, 0x00, 0x03, 0x56, 0x01, 0x5f, 0xe8, 0x17, 0x84,
          0x52, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
}

Gltf wholeCar() {
  Gltf g;
  addMaterials(g);
  addLights(g);
  const int quad = addQuad(g, 0);
  const int cube = addCube(g);
  Json glowing = g.json["meshes"][static_cast<std::size_t>(cube)];
  glowing["primitives"][0]["material"] = 1;
  const int lamp = g.add("meshes", glowing);
  // Node 0: all hang below it, 1 m up and 2 m to the front (glTF: y up, z front).
  addNode(g, "body", nullptr, {{"translation", {0, 1, 2}}, {"children", {1, 3, 4, 5, 6, 7, 8, 9}}});
  addNode(g, "wiper_l",
          {{"type", "wiper"},
           {"name", "left"},
           {"pane", "windscreen"},
           {"arm_m", 0.5},
           {"blade_m", 0.6},
           {"blade_angle_deg", 90},
           {"sweep_deg", -100}},
          {{"translation", {0.5, 0, 0}}, {"rotation", {0.70710678, 0, 0, 0.70710678}}, {"children", {2}}});
  addNode(g, "blade", nullptr, {{"mesh", cube}, {"translation", {0.5, 0, 0}}});
  addNode(g, "glass", {{"type", "pane"}, {"name", "windscreen"}, {"glass", "dirty"}}, {{"mesh", quad}});
  addNode(g, "cabin", {{"type", "shelter"}, {"name", "cabin"}}, {{"mesh", cube}, {"scale", {2, 1, 2}}});
  addNode(g, "eye", {{"type", "eye"}, {"pitch_deg", -3}, {"fov_deg", 70}}, {{"translation", {0.4, 0.2, -1}}});
  addNode(g, "beam", {{"type", "light"}, {"role", "head"}},
          {{"rotation", {0, 1, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  addNode(g, "brake", {{"type", "light"}, {"role", "brake"}}, {{"mesh", lamp}, {"translation", {0, 0, -3}}});
  addNode(g, "wheel_fl", {{"type", "wheel"}, {"radius_m", 0.31}, {"steers", 1}},
          {{"translation", {0.8, -0.7, 0.5}}});
  addNode(g, "steering", {{"type", "steering_wheel"}, {"ratio", 14}},
          {{"rotation", {-0.70710678, 0, 0, 0.70710678}}});
  addNode(g, "mirror", {{"type", "mirror"}, {"name", "inside"}},
          {{"mesh", quad}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 2, 0, 1}}});
  addNode(g, "way", {{"type", "route"}, {"points_m", {0, 0, 0, 10, 1, 0, 20, 0, -5}}, {"closed", true}});
  addNode(g, "aside", nullptr, {{"mesh", quad}});
  addAnimation(g, 2);
  g.add("scenes", {{"nodes", {0, 10, 11}}});
  g.json["scene"] = 0;
  return g;
}

}  // namespace files
