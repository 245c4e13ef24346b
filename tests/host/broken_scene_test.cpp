// Files broken in one place each: one line that names the file and the element, as text and as binary.
#include <gtest/gtest.h>

#include <limits>

#include "broken_files.h"
#include "loaded.h"
#include "scene/scene.h"

namespace {

using files::Bytes;
using files::complaint;
using files::Gltf;
using files::Json;
using files::TempFolder;

void expectOneLine(const std::string& message, const std::string& file, const std::string& expected) {
  EXPECT_EQ(message.rfind(file + ": ", 0), 0U) << "names the file first: " << message;
  EXPECT_NE(message.find(expected), std::string::npos) << "expected \"" << expected << "\" in: " << message;
  EXPECT_EQ(message.find_first_of("\n\r\t"), std::string::npos) << message;
}

Json& node(Gltf& g, std::size_t i) { return g.json["nodes"][i]; }
Json& meaning(Gltf& g, std::size_t i) { return node(g, i)["extras"]["rainglass"]; }
Json& primitive(Gltf& g, std::size_t mesh) { return g.json["meshes"][mesh]["primitives"][0]; }
Json& accessorOf(Gltf& g, std::size_t mesh, const char* attribute) {
  return g.json["accessors"][primitive(g, mesh)["attributes"][attribute].get<std::size_t>()];
}

/// Overwrites a float of an accessor's first element.
void poke(Gltf& g, const Json& accessor, float value) {
  const Json& view = g.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
  std::memcpy(g.bin.data() + view["byteOffset"].get<std::size_t>(), &value, sizeof(value));
}

// Node 0 body, 1 wiper_l, 2 blade, 3 glass (pane), 4 cabin (shelter), 5 eye, 6 beam, 7 brake, 8 wheel_fl, 9
// steering, 10 mirror, 11 way (route). Mesh 0 quad, 1 cube, 2 glowing cube.
}  // namespace

namespace files {

const std::vector<Break> kBreaks = {
    // The document as such.
    {"noAsset", [](Gltf& g) { g.json.erase("asset"); }, "asset is missing"},
    {"version1", [](Gltf& g) { g.json["asset"]["version"] = "1.0"; }, "asset.version is \"1.0\""},
    {"versionIsANumber", [](Gltf& g) { g.json["asset"]["version"] = 2.0; },
     "asset.version is 2, must be text"},
    {"newerMinVersion", [](Gltf& g) { g.json["asset"]["minVersion"] = "2.1"; }, "asset.minVersion"},
    {"unknownRequiredExtension",
     [](Gltf& g) { g.json["extensionsRequired"].push_back("KHR_draco_mesh_compression"); },
     "extensionsRequired names KHR_draco_mesh_compression"},
    {"nodesAreAnObject", [](Gltf& g) { g.json["nodes"] = Json::object(); },
     "nodes is an object, must be a list"},
    {"nodeIsANumber", [](Gltf& g) { g.json["nodes"][2] = 5; }, "nodes 2"},
    {"nameIsANumber", [](Gltf& g) { g.json["meshes"][0]["name"] = 5; }, "meshes 0"},
    {"deepNesting",
     [](Gltf& g) {
       Json deep = 1;
       for (int i = 0; i < 100; ++i) deep = Json::array({std::move(deep)});
       g.json["extras"] = std::move(deep);
     },
     "nested deeper"},
    {"sceneBeyond", [](Gltf& g) { g.json["scene"] = 3; }, "scene is 3"},
    {"emptyScene", [](Gltf& g) { g.json["scenes"][0]["nodes"] = Json::array(); }, "no node to show"},
    // Buffers and views.
    {"viewBeyondBuffer", [](Gltf& g) { g.json["bufferViews"][1]["byteLength"] = 1 << 20; },
     "bufferView 1: byteOffset + byteLength"},
    {"viewOffsetNegative", [](Gltf& g) { g.json["bufferViews"][1]["byteOffset"] = -4; },
     "bufferView 1: byteOffset is -4"},
    {"viewOffsetWraps",
     [](Gltf& g) { g.json["bufferViews"][1]["byteOffset"] = std::numeric_limits<std::uint64_t>::max() - 3; },
     "bufferView 1: byteOffset"},
    {"viewWithoutLength", [](Gltf& g) { g.json["bufferViews"][1].erase("byteLength"); },
     "bufferView 1: byteLength is missing"},
    {"viewOfNoBuffer", [](Gltf& g) { g.json["bufferViews"][1]["buffer"] = 7; }, "bufferView 1: buffer is 7"},
    {"viewStrideOdd", [](Gltf& g) { g.json["bufferViews"][1]["byteStride"] = 6; },
     "bufferView 1: byteStride is 6"},
    {"viewStrideTooSmall", [](Gltf& g) { g.json["bufferViews"][1]["byteStride"] = 4; },
     "byteStride smaller than one element"},
    {"bufferLongerThanItsBytes", [](Gltf& g) { g.json["buffers"][0]["byteLength"] = g.bin.size() + 100; },
     "buffer 0: byteLength"},
    {"bufferIsHuge", [](Gltf& g) { g.json["buffers"][0]["byteLength"] = 1LL << 40; }, "buffer 0: byteLength"},
    {"bufferIsEmpty", [](Gltf& g) { g.json["buffers"][0]["byteLength"] = 0; }, "buffer 0: byteLength"},
    {"secondBufferHasNoBytes",
     [](Gltf& g) {
       g.add("buffers", {{"byteLength", 4}});
     },
     "buffer 1: has no uri"},
    {"bufferUriIsANumber",
     [](Gltf& g) {
       g.add("buffers", {{"byteLength", 4}, {"uri", 4}});
     },
     "buffer 1: uri is 4, must be text"},
    // Accessors.
    {"accessorBeyondView", [](Gltf& g) { accessorOf(g, 0, "POSITION")["count"] = 5; },
     "accessor 0: count is 5"},
    {"accessorCountWraps", [](Gltf& g) { accessorOf(g, 0, "POSITION")["count"] = 0x7fffffff; },
     "accessor 0: count"},
    {"accessorCountZero", [](Gltf& g) { accessorOf(g, 0, "POSITION")["count"] = 0; },
     "accessor 0: count is 0"},
    {"accessorOffsetBeyond", [](Gltf& g) { accessorOf(g, 0, "POSITION")["byteOffset"] = 44; },
     "accessor 0: count"},
    {"accessorOfNoView", [](Gltf& g) { accessorOf(g, 0, "POSITION")["bufferView"] = 99; },
     "accessor 0: bufferView is 99"},
    {"accessorWithoutView", [](Gltf& g) { accessorOf(g, 0, "POSITION").erase("bufferView"); },
     "has no bufferView"},
    {"accessorTypeUnknown", [](Gltf& g) { accessorOf(g, 0, "POSITION")["type"] = "VEC5"; },
     "accessor 0: type is unknown"},
    {"componentTypeUnknown", [](Gltf& g) { accessorOf(g, 0, "POSITION")["componentType"] = 5130; },
     "accessor 0: componentType"},
    {"positionsAreVec4", [](Gltf& g) { accessorOf(g, 0, "POSITION")["type"] = "VEC2"; },
     "mesh 0 \"quad\": primitives[0]: POSITION"},
    {"sparseAccessor",
     [](Gltf& g) {
       accessorOf(g, 0, "POSITION")["sparse"] = {
           {"count", 1}, {"indices", {{"bufferView", 0}}}, {"values", {{"bufferView", 0}}}};
     },
     "accessor 0 is sparse"},
    {"positionIsNan",
     [](Gltf& g) { poke(g, accessorOf(g, 0, "POSITION"), std::numeric_limits<float>::quiet_NaN()); },
     "mesh 0 \"quad\": primitives[0]: POSITION: accessor 0 holds a number that is not finite"},
    {"uvIsInfinite",
     [](Gltf& g) { poke(g, accessorOf(g, 0, "TEXCOORD_0"), std::numeric_limits<float>::infinity()); },
     "TEXCOORD_0: accessor 2"},
    // Meshes.
    {"indexBeyondVertices",
     [](Gltf& g) {
       accessorOf(g, 0, "POSITION")["count"] = 3;
       accessorOf(g, 0, "NORMAL")["count"] = 3;
       accessorOf(g, 0, "TEXCOORD_0")["count"] = 3;
     },
     "mesh 0 \"quad\": primitives[0]: index 5 is 3"},
    {"attributesOfDifferentLength", [](Gltf& g) { accessorOf(g, 0, "NORMAL")["count"] = 3; },
     "primitives[0]: NORMAL has 3 elements"},
    {"indicesAreFloats", [](Gltf& g) { primitive(g, 0)["indices"] = 2; },
     "indices: accessor 2 must hold unsigned integers"},
    {"attributeOfNoAccessor", [](Gltf& g) { primitive(g, 0)["attributes"]["NORMAL"] = 99; },
     "mesh 0 \"quad\": primitives[0].attributes.NORMAL is 99"},
    {"noPositions", [](Gltf& g) { primitive(g, 0)["attributes"].erase("POSITION"); },
     "primitives[0].attributes.POSITION is missing"},
    {"noPrimitives", [](Gltf& g) { g.json["meshes"][0]["primitives"] = Json::array(); },
     "mesh 0 \"quad\": primitives is empty"},
    {"modeUnknown", [](Gltf& g) { primitive(g, 0)["mode"] = 7; }, "primitives[0].mode is 7"},
    {"materialBeyond", [](Gltf& g) { primitive(g, 0)["material"] = 2; }, "primitives[0].material is 2"},
    // Materials, textures, images, lights.
    {"textureBeyond", [](Gltf& g) { g.json["materials"][0]["normalTexture"]["index"] = 5; },
     "material 0 \"glass\": normalTexture.index is 5"},
    {"textureSourceBeyond", [](Gltf& g) { g.json["textures"][0]["source"] = 5; }, "texture 0: source is 5"},
    {"textureSamplerBeyond", [](Gltf& g) { g.json["textures"][0]["sampler"] = -1; },
     "texture 0: sampler is -1"},
    {"thirdUvSet", [](Gltf& g) { g.json["materials"][0]["normalTexture"]["texCoord"] = 2; },
     "normalTexture.texCoord is 2"},
    {"filterUnknown", [](Gltf& g) { g.json["samplers"][0]["minFilter"] = 9730; },
     "sampler 0: minFilter is 9730"},
    {"roughnessOutOfRange",
     [](Gltf& g) { g.json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 2; },
     "pbrMetallicRoughness.roughnessFactor is 2, must be 0..1"},
    {"colourHasThree",
     [](Gltf& g) {
       g.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1};
     },
     "baseColorFactor has 3 numbers"},
    {"alphaModeUnknown", [](Gltf& g) { g.json["materials"][1]["alphaMode"] = "SHINE"; },
     "material 1 \"glow\": alphaMode"},
    {"imageIsNoPicture", [](Gltf& g) { g.json["images"][0]["bufferView"] = 2; },
     "image 0 \"paint\": image is neither PNG nor JPEG"},
    {"imageIsCutOff", [](Gltf& g) { g.json["bufferViews"][0]["byteLength"] = 40; },
     "image 0 \"paint\": PNG is broken"},
    {"imageHasNoSource", [](Gltf& g) { g.json["images"][0].erase("bufferView"); },
     "image 0 \"paint\": uri or bufferView"},
    {"imageViewBeyond", [](Gltf& g) { g.json["images"][0]["bufferView"] = 999; },
     "image 0 \"paint\": bufferView is 999"},
    {"imageIsABomb",
     [](Gltf& g) {
       // IHDR says 60000 x 60000; its checksum (of type and data) is left to be wrong or right: both must
       // fail.
       for (const std::size_t at : {16U, 20U}) g.bin[at + 2] = 0xea, g.bin[at + 3] = 0x60;
     },
     "image 0 \"paint\": PNG is broken"},
    {"lightTypeUnknown",
     [](Gltf& g) { g.json["extensions"]["KHR_lights_punctual"]["lights"][0]["type"] = "laser"; },
     "light 0 \"low beam\": type is unknown"},
    {"lightBeyond", [](Gltf& g) { node(g, 6)["extensions"]["KHR_lights_punctual"]["light"] = 1; },
     "node 6 \"beam\": extensions.KHR_lights_punctual.light is 1"},
    {"coneTooWide",
     [](Gltf& g) { g.json["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["outerConeAngle"] = 2; },
     "light 0 \"low beam\": spot.outerConeAngle is 2"},
    // Nodes.
    {"childBeyond", [](Gltf& g) { node(g, 0)["children"].push_back(77); },
     "node 0 \"body\": children holds 77"},
    {"meshBeyond", [](Gltf& g) { node(g, 2)["mesh"] = 9; }, "node 2 \"blade\": mesh is 9"},
    {"nodeIsItsOwnChild", [](Gltf& g) { node(g, 12)["children"] = {12}; },
     "node 12 \"aside\": is its own ancestor"},
    {"ringOfNodes",
     [](Gltf& g) {
       node(g, 10)["children"] = {12};
       node(g, 12)["children"] = {10};
     },
     "is its own ancestor"},
    {"twoParents", [](Gltf& g) { node(g, 12)["children"] = {2}; },
     "node 2 \"blade\": is a child of node 1 and of node 12"},
    {"rootWithParent", [](Gltf& g) { g.json["scenes"][0]["nodes"].push_back(2); },
     "scene 0: nodes lists node 2"},
    {"longChain",
     [](Gltf& g) {
       for (int i = 0; i < 300; ++i) {
         const std::size_t next = g.json["nodes"].size() + 1;
         g.add("nodes", i < 299 ? Json{{"children", {next}}} : Json::object());
       }
     },
     "has more than 255 ancestors"},
    {"matrixOfTwelve", [](Gltf& g) { node(g, 10)["matrix"] = std::vector<int>(12, 1); },
     "node 10 \"mirror\": matrix has 12 numbers"},
    {"matrixAndScale",
     [](Gltf& g) {
       node(g, 10)["scale"] = {1, 1, 1};
     },
     "node 10 \"mirror\": matrix is given beside"},
    {"matrixOverflowsFloat", [](Gltf& g) { node(g, 10)["matrix"][12] = 1e300; },
     "node 10 \"mirror\": matrix holds 1e+300"},
    {"placeOverflows",
     [](Gltf& g) {
       node(g, 0)["scale"] = {3e38, 3e38, 3e38};
       node(g, 1)["translation"] = {100, 0, 0};
     },
     "node 1 \"wiper_l\": its place is not finite"},
    {"rotationOfNoLength",
     [](Gltf& g) {
       node(g, 1)["rotation"] = {0, 0, 0, 0};
     },
     "node 1 \"wiper_l\": rotation has length 0"},
    {"translationIsText", [](Gltf& g) { node(g, 1)["translation"] = "up"; },
     "node 1 \"wiper_l\": translation is \"up\""},
    // Animations.
    {"channelOfNoNode", [](Gltf& g) { g.json["animations"][0]["channels"][0]["target"]["node"] = 50; },
     "animation 0 \"door\": channels[0].target.node is 50"},
    {"channelOfNoSampler", [](Gltf& g) { g.json["animations"][0]["channels"][0]["sampler"] = 2; },
     "animation 0 \"door\": channels[0].sampler is 2"},
    {"samplerOfNoAccessor", [](Gltf& g) { g.json["animations"][0]["samplers"][0]["input"] = 200; },
     "animation 0 \"door\": samplers[0].input is 200"},
    {"interpolationUnknown",
     [](Gltf& g) { g.json["animations"][0]["samplers"][0]["interpolation"] = "WILD"; },
     "samplers[0].interpolation"},
    {"pathUnknown", [](Gltf& g) { g.json["animations"][0]["channels"][0]["target"]["path"] = "colour"; },
     "channels[0]: target.path \"colour\""},
    {"splineWithTooFewValues",
     [](Gltf& g) { g.json["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; },
     "channels[0]: has 2 values, its keys need 6"},
    {"rotationOfThree",
     [](Gltf& g) { g.json["animations"][0]["channels"][0]["target"]["path"] = "rotation"; },
     "channels[0]: output: accessor"},
    {"timesRunBack",
     [](Gltf& g) {
       poke(g, g.json["accessors"][g.json["animations"][0]["samplers"][0]["input"].get<std::size_t>()], 4.0F);
     },
     "times of keys do not increase"},
    {"matrixIsAnimated", [](Gltf& g) { g.json["animations"][0]["channels"][0]["target"]["node"] = 10; },
     "moves node 10, which has a matrix"},
    // extras.rainglass
    {"typeUnknown", [](Gltf& g) { meaning(g, 3)["type"] = "window"; },
     "node 3 \"glass\": extras.rainglass.type is \"window\""},
    {"typeMissing", [](Gltf& g) { meaning(g, 3).erase("type"); },
     "node 3 \"glass\": extras.rainglass.type is missing"},
    {"meaningIsText", [](Gltf& g) { meaning(g, 3) = "pane"; },
     "node 3 \"glass\": extras.rainglass is \"pane\", must be an object"},
    {"keyUnknown", [](Gltf& g) { meaning(g, 1)["arm"] = 0.5; },
     "node 1 \"wiper_l\": extras.rainglass.arm is not a known key"},
    {"keyMissing", [](Gltf& g) { meaning(g, 1).erase("blade_m"); },
     "node 1 \"wiper_l\": extras.rainglass.blade_m is missing"},
    {"armTooLong", [](Gltf& g) { meaning(g, 1)["arm_m"] = 9; },
     "node 1 \"wiper_l\": extras.rainglass.arm_m is 9, must be 0.05..2"},
    {"armIsText", [](Gltf& g) { meaning(g, 1)["arm_m"] = "long"; },
     "extras.rainglass.arm_m is \"long\", must be a number"},
    {"sweepTooSmall", [](Gltf& g) { meaning(g, 1)["sweep_deg"] = 2; },
     "extras.rainglass.sweep_deg must be 5..180 in size"},
    {"nameTooLong", [](Gltf& g) { meaning(g, 3)["name"] = std::string(64, 'a'); },
     "extras.rainglass.name has 64 bytes"},
    {"nameEmpty", [](Gltf& g) { meaning(g, 3)["name"] = ""; }, "extras.rainglass.name is empty"},
    {"namesTwice",
     [](Gltf& g) {
       node(g, 12)["extras"]["rainglass"] = {{"type", "pane"}, {"name", "windscreen"}};
       g.json["scenes"][0]["nodes"].push_back(12);
     },
     "there is a pane \"windscreen\" already"},
    {"wiperOfNoPane", [](Gltf& g) { meaning(g, 1)["pane"] = "rear"; },
     "node 1 \"wiper_l\": extras.rainglass.pane is \"rear\""},
    {"wiperMirrored",
     [](Gltf& g) {
       node(g, 1)["scale"] = {1, -1, 1};
     },
     "node 1 \"wiper_l\": extras.rainglass: a wiper must not be mirrored"},
    {"glassUnknown", [](Gltf& g) { meaning(g, 3)["glass"] = "waxed"; },
     "extras.rainglass.glass is \"waxed\", must be one of uncoated, dirty"},
    {"paneWithoutMesh", [](Gltf& g) { node(g, 3).erase("mesh"); },
     "node 3 \"glass\": extras.rainglass: a pane needs a mesh"},
    {"paneWithoutUv", [](Gltf& g) { primitive(g, 0)["attributes"].erase("TEXCOORD_0"); },
     "node 3 \"glass\": extras.rainglass: a pane needs TEXCOORD_0"},
    {"paneOfNoSize",
     [](Gltf& g) {
       node(g, 3)["scale"] = {1, 0, 1};
     },
     "node 3 \"glass\": extras.rainglass: a pane is scaled to nothing"},
    {"shelterIsFlat", [](Gltf& g) { node(g, 4)["mesh"] = 0; },
     "node 4 \"cabin\": extras.rainglass: a shelter is flat"},
    {"eyeTwice",
     [](Gltf& g) {
       meaning(g, 9) = {{"type", "eye"}};
     },
     "node 9 \"steering\": extras.rainglass: there is another eye"},
    {"cameraTwice",
     [](Gltf& g) {
       meaning(g, 5) = meaning(g, 9) = {{"type", "camera"}, {"name", "lens"}};
     },
     "node 9 \"steering\": extras.rainglass.name: there is a camera \"lens\" already"},
    {"cameraWithoutName",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "camera"}};
     },
     "node 5 \"eye\": extras.rainglass.name"},
    {"cameraLooksFarRound",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "camera"}, {"name", "lens"}, {"yaw_deg", 270}};
     },
     "node 5 \"eye\": extras.rainglass.yaw_deg is 270, must be -180..180"},
    {"fovTooWide", [](Gltf& g) { meaning(g, 5)["fov_deg"] = 180; },
     "node 5 \"eye\": extras.rainglass.fov_deg is 180, must be 20..120"},
    {"routeOfOnePoint",
     [](Gltf& g) {
       meaning(g, 11)["points_m"] = {0, 0, 0};
     },
     "node 11 \"way\": extras.rainglass.points_m has 3 numbers"},
    {"routeOfHalfAPoint", [](Gltf& g) { meaning(g, 11)["points_m"].push_back(1); },
     "points_m has 10 numbers, must have a multiple of 3"},
    {"routeStandsStill", [](Gltf& g) { meaning(g, 11)["points_m"] = {0, 0, 0, 0, 0, 0}; },
     "points_m has the same point twice"},
    {"routeHoldsNull", [](Gltf& g) { meaning(g, 11)["points_m"][4] = nullptr; },
     "points_m holds null, must hold finite numbers"},
    {"closedIsTwo", [](Gltf& g) { meaning(g, 11)["closed"] = 2; },
     "extras.rainglass.closed is 2, must be true or false"},
    {"roleUnknown", [](Gltf& g) { meaning(g, 6)["role"] = "disco"; },
     "node 6 \"beam\": extras.rainglass.role is \"disco\""},
    {"lightOfNothing", [](Gltf& g) { node(g, 7)["mesh"] = 1; },
     "node 7 \"brake\": extras.rainglass: a light needs"},
    {"wheelTooSmall", [](Gltf& g) { meaning(g, 8)["radius_m"] = 0; },
     "node 8 \"wheel_fl\": extras.rainglass.radius_m is 0"},
    {"needleOfNothing",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "needle"}, {"full", 240}, {"sweep_deg", -264}};
     },
     "node 5 \"eye\": extras.rainglass.shows is missing"},
    {"needleOfAnUnknownReading",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "needle"}, {"shows", "fuel"}, {"full", 240}, {"sweep_deg", -264}};
     },
     "extras.rainglass.shows is \"fuel\", must be one of speed_kmh, engine_rpm"},
    {"needleOfNoScale",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "needle"}, {"shows", "speed_kmh"}, {"full", 0}, {"sweep_deg", -264}};
     },
     "extras.rainglass.full is 0, must be 1..100000"},
    {"needleThatDoesNotTurn",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "needle"}, {"shows", "speed_kmh"}, {"full", 240}};
     },
     "extras.rainglass.sweep_deg is missing"},
    {"needleMirrored",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "needle"}, {"shows", "speed_kmh"}, {"full", 240}, {"sweep_deg", -264}};
       node(g, 5)["scale"] = {1, -1, 1};
     },
     "node 5 \"eye\": extras.rainglass: a needle must not be mirrored"},
    {"digitOfHalfAPlace",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "digit"}, {"shows", "speed_kmh"}, {"place", 0.5}};
     },
     "node 5 \"eye\": extras.rainglass.place is 0.5"},
    {"digitOfMillions",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "digit"}, {"shows", "speed_kmh"}, {"place", 6}};
     },
     "extras.rainglass.place is 6, must be 0..5"},
    {"digitMirrored",
     [](Gltf& g) {
       meaning(g, 5) = {{"type", "digit"}, {"shows", "engine_rpm"}, {"place", 0}};
       node(g, 5)["scale"] = {1, -1, 1};
     },
     "node 5 \"eye\": extras.rainglass: a digit must not be mirrored"},
    {"mirrorWithoutMesh", [](Gltf& g) { node(g, 10).erase("mesh"); },
     "node 10 \"mirror\": extras.rainglass: a mirror needs a mesh"},
    {"wetMirrorWithoutUv",
     [](Gltf& g) {
       meaning(g, 10)["wet"] = true;
       node(g, 3).erase("extras");
       node(g, 1).erase("extras");
       primitive(g, 0)["attributes"].erase("TEXCOORD_0");
     },
     "node 10 \"mirror\": extras.rainglass: a mirror that is wet needs TEXCOORD_0"},
    {"wetIsText", [](Gltf& g) { meaning(g, 10)["wet"] = "yes"; },
     "extras.rainglass.wet is \"yes\", must be true or false"},
};

void PrintTo(const Break& b, std::ostream* out) { *out << b.name; }

}  // namespace files

namespace {

class BrokenScene : public testing::TestWithParam<files::Break> {};

TEST_P(BrokenScene, isRefusedInOneLineWhetherTextOrBinary) {
  Gltf g = files::wholeCar();
  GetParam().apply(g);
  const TempFolder folder;
  folder.write("buffer.bin", g.bin);
  expectOneLine(complaint(folder.write("car.glb", g.glb())), "car.glb", GetParam().expected);
  if (files::onlyBinary(GetParam())) return;
  expectOneLine(complaint(folder.write("car.gltf", g.gltf())), "car.gltf", GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(All, BrokenScene, testing::ValuesIn(files::kBreaks),
                         [](const auto& test) { return test.param.name; });

}  // namespace
