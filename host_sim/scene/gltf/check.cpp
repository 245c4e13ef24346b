#include "scene/gltf/check.h"

#include <array>
#include <limits>

#include "scene/gltf/check_tree.h"

namespace host::gltf {

namespace {

constexpr double kAnyFloat = 3.4e38;
constexpr std::int64_t kLargestCount = std::numeric_limits<std::int32_t>::max();

constexpr std::array kLists = {"accessors", "animations", "buffers",  "bufferViews", "images",  "materials",
                               "meshes",    "nodes",      "samplers", "scenes",      "textures"};
constexpr std::array kExtensions = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                    "KHR_materials_unlit", "KHR_mesh_quantization", "KHR_texture_transform"};

struct Checker {
  const Document& document;
  const Json& json = document.json;

  std::size_t count(const char* list) const { return json.contains(list) ? json[list].size() : 0; }

  /// Calls check(fields, index) for each element of a list.
  template <typename Check>
  void each(const char* list, const char* kind, Check&& check) const {
    for (std::size_t i = 0; i < count(list); ++i) {
      check(Fields(json[list][i], elementOf(document, list, kind, i)), i);
    }
  }

  void asset() const;
  void lists() const;
  void buffer(const Fields& fields) const;
  void view(const Fields& fields) const;
  void accessor(const Fields& fields) const;
  void image(const Fields& fields) const;
  void sampler(const Fields& fields) const;
  void texture(const Fields& fields) const;
  void textureUse(const std::optional<Fields>& fields) const;
  void material(const Fields& fields) const;
  void primitive(const Fields& fields) const;
  void mesh(const Fields& fields, std::size_t index) const;
  void animation(const Fields& fields) const;
  void channel(const Fields& fields, std::size_t samplers) const;
  void lights() const;
};

void oneOf(const Fields& fields, const char* key, std::initializer_list<std::int64_t> allowed) {
  if (!fields.has(key)) return;
  const std::int64_t value = fields.integer(key, 0, kLargestCount);
  for (const std::int64_t a : allowed) {
    if (a == value) return;
  }
  fields.failAt(key, "is " + std::to_string(value) + ", which glTF does not know");
}

void Checker::asset() const {
  const Fields root(json, document.file);
  const std::optional<Fields> asset = root.object("asset");
  if (!asset) root.failAt("asset", "is missing");
  const std::string version = asset->text("version", 16);
  if (!version.starts_with("2.")) asset->failAt("version", "is \"" + version + "\", must be 2.0");
  const std::string least = asset->text("minVersion", 16, "2.0");
  if (least != "2.0") asset->failAt("minVersion", "is \"" + least + "\", only 2.0 is supported");
  for (const Json& name : root.list("extensionsRequired")) {
    if (!name.is_string()) root.failAt("extensionsRequired", "must hold text");
    bool known = false;
    for (const char* extension : kExtensions) known = known || name == extension;
    if (!known)
      root.failAt("extensionsRequired", "names " + name.get<std::string>() + ", which is not supported");
  }
}

void Checker::lists() const {
  const Fields root(json, document.file);
  for (const char* list : kLists) {
    const Json& elements = root.list(list);
    if (elements.size() > 1'000'000) root.failAt(list, "has more than a million elements");
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const Fields element(elements[i], document.file + ": " + list + " " + std::to_string(i));
      element.text("name", std::numeric_limits<std::size_t>::max(), "");
      element.object("extensions");
    }
  }
}

void Checker::buffer(const Fields& fields) const {
  fields.integer("byteLength", 1, kLargestFile_bytes);
  fields.text("uri", std::numeric_limits<std::size_t>::max(), "");
}

void Checker::view(const Fields& fields) const {
  const int buffer = fields.index("buffer", count("buffers"), true);
  const std::int64_t offset = fields.integer("byteOffset", 0, kLargestFile_bytes, 0);
  const std::int64_t length = fields.integer("byteLength", 1, kLargestFile_bytes);
  const std::int64_t buffer_bytes =
      json["buffers"][static_cast<std::size_t>(buffer)]["byteLength"].get<std::int64_t>();
  if (offset + length > buffer_bytes) {
    fields.failAt("byteOffset + byteLength", "is " + std::to_string(offset + length) + ", but buffer " +
                                                 std::to_string(buffer) + " has " +
                                                 std::to_string(buffer_bytes) + " bytes");
  }
  const std::int64_t stride = fields.integer("byteStride", 4, 252, 4);
  if (stride % 4 != 0)
    fields.failAt("byteStride", "is " + std::to_string(stride) + ", must be a multiple of 4");
}

std::int64_t componentsOf(const std::string& type) {
  constexpr std::array<std::pair<const char*, std::int64_t>, 7> kTypes = {
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  for (const auto& [name, components] : kTypes) {
    if (type == name) return components;
  }
  return 0;
}

void Checker::accessor(const Fields& fields) const {
  const auto size = static_cast<std::int64_t>(
      componentSize_bytes(static_cast<int>(fields.integer("componentType", 0, 10000))));
  if (size == 0) fields.failAt("componentType", "is unknown");
  const std::int64_t components = componentsOf(fields.text("type", 16));
  if (components == 0) fields.failAt("type", "is unknown");
  const std::int64_t elements = fields.integer("count", 1, kLargestCount);
  const std::int64_t offset = fields.integer("byteOffset", 0, kLargestFile_bytes, 0);
  if (fields.json().contains("normalized") && !fields.json()["normalized"].is_boolean()) {
    fields.failAt("normalized", "must be true or false");
  }
  const int view = fields.index("bufferView", count("bufferViews"));
  if (view < 0) return;  // refused where it is used
  const Json& view_json = json["bufferViews"][static_cast<std::size_t>(view)];
  const std::int64_t stride = view_json.value("byteStride", components * size);
  if (stride < components * size) fields.failAt("bufferView", "has a byteStride smaller than one element");
  const std::int64_t end = offset + (elements - 1) * stride + components * size;
  const std::int64_t view_bytes = view_json["byteLength"].get<std::int64_t>();
  if (end > view_bytes) {
    fields.failAt("count", "is " + std::to_string(elements) + ", which needs " + std::to_string(end) +
                               " bytes, but bufferView " + std::to_string(view) + " has " +
                               std::to_string(view_bytes));
  }
}

void Checker::image(const Fields& fields) const {
  if (fields.has("uri") == fields.has("bufferView"))
    fields.failAt("uri", "or bufferView must be given, and not both");
  fields.text("uri", std::numeric_limits<std::size_t>::max(), "");
  fields.index("bufferView", count("bufferViews"));
}

void Checker::sampler(const Fields& fields) const {
  oneOf(fields, "magFilter", {9728, 9729});
  oneOf(fields, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
  oneOf(fields, "wrapS", {10497, 33071, 33648});
  oneOf(fields, "wrapT", {10497, 33071, 33648});
}

void Checker::texture(const Fields& fields) const {
  fields.index("sampler", count("samplers"));
  fields.index("source", count("images"));
}

void Checker::textureUse(const std::optional<Fields>& fields) const {
  if (!fields) return;
  fields->index("index", count("textures"), true);
  fields->integer("texCoord", 0, 1, 0);
  fields->number("scale", -kAnyFloat, kAnyFloat, 1.0);
  fields->number("strength", 0.0, 1.0, 1.0);
  const std::optional<Fields> extensions = fields->object("extensions");
  const std::optional<Fields> transform =
      extensions ? extensions->object("KHR_texture_transform") : std::nullopt;
  if (!transform) return;
  transform->numbers("offset", 2, 2);
  transform->numbers("scale", 2, 2);
  transform->number("rotation", -kAnyFloat, kAnyFloat, 0.0);
  transform->integer("texCoord", 0, 1, 0);
}

void checkFactors(const Fields& fields, const char* key, std::size_t count) {
  for (const float factor : fields.numbers(key, count, count)) {
    if (factor < 0.0F || factor > 1.0F) fields.failAt(key, "holds a number outside 0..1");
  }
}

void Checker::material(const Fields& fields) const {
  if (const std::optional<Fields> pbr = fields.object("pbrMetallicRoughness")) {
    checkFactors(*pbr, "baseColorFactor", 4);
    pbr->number("metallicFactor", 0.0, 1.0, 1.0);
    pbr->number("roughnessFactor", 0.0, 1.0, 1.0);
    textureUse(pbr->object("baseColorTexture"));
    textureUse(pbr->object("metallicRoughnessTexture"));
  }
  checkFactors(fields, "emissiveFactor", 3);
  for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"})
    textureUse(fields.object(key));
  const std::string alpha = fields.text("alphaMode", 16, "OPAQUE");
  if (alpha != "OPAQUE" && alpha != "MASK" && alpha != "BLEND") fields.failAt("alphaMode", "is unknown");
  fields.number("alphaCutoff", 0.0, kAnyFloat, 0.5);
  if (fields.has("doubleSided") && !fields.json()["doubleSided"].is_boolean()) {
    fields.failAt("doubleSided", "must be true or false");
  }
  const std::optional<Fields> extensions = fields.object("extensions");
  const std::optional<Fields> glow =
      extensions ? extensions->object("KHR_materials_emissive_strength") : std::nullopt;
  if (glow) glow->number("emissiveStrength", 0.0, 1e6, 1.0);
}

void Checker::primitive(const Fields& fields) const {
  const std::optional<Fields> attributes = fields.object("attributes");
  if (!attributes || !attributes->has("POSITION")) fields.failAt("attributes.POSITION", "is missing");
  for (const auto& item : attributes->json().items())
    attributes->index(item.key().c_str(), count("accessors"));
  fields.index("indices", count("accessors"));
  fields.index("material", count("materials"));
  fields.integer("mode", 0, 6, 4);
}

void Checker::mesh(const Fields& fields, std::size_t index) const {
  const Json& primitives = fields.list("primitives");
  if (primitives.empty()) fields.failAt("primitives", "is empty");
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    primitive(Fields(primitives[i], elementOf(document, "meshes", "mesh", index),
                     "primitives[" + std::to_string(i) + "]."));
  }
}

void Checker::channel(const Fields& fields, std::size_t samplers) const {
  fields.index("sampler", samplers, true);
  const std::optional<Fields> target = fields.object("target");
  if (!target) fields.failAt("target", "is missing");
  target->index("node", count("nodes"));
  target->text("path", 64);
}

void Checker::animation(const Fields& fields) const {
  const Json& samplers = fields.list("samplers");
  for (std::size_t i = 0; i < samplers.size(); ++i) {
    const Fields sampler(samplers[i], fields.where(), "samplers[" + std::to_string(i) + "].");
    sampler.index("input", count("accessors"), true);
    sampler.index("output", count("accessors"), true);
    const std::string kind = sampler.text("interpolation", 16, "LINEAR");
    if (kind != "LINEAR" && kind != "STEP" && kind != "CUBICSPLINE")
      sampler.failAt("interpolation", "is unknown");
  }
  const Json& channels = fields.list("channels");
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channel(Fields(channels[i], fields.where(), "channels[" + std::to_string(i) + "]."), samplers.size());
  }
}

void checkLight(const Fields& fields) {
  const std::string type = fields.text("type", 32);
  if (type != "directional" && type != "point" && type != "spot") fields.failAt("type", "is unknown");
  checkFactors(fields, "color", 3);
  fields.number("intensity", 0.0, kAnyFloat, 1.0);
  fields.number("range", 1e-6, kAnyFloat, 1.0);
  const std::optional<Fields> spot = fields.object("spot");
  if (type == "spot" && !spot) fields.failAt("spot", "is missing");
  if (!spot) return;
  constexpr double kQuarterTurn = 1.5708;  // pi/2, rounded up as exporters do
  const double outer = spot->number("outerConeAngle", 1e-6, kQuarterTurn, 0.785398);
  const double inner = spot->number("innerConeAngle", 0.0, kQuarterTurn, 0.0);
  if (inner > outer) spot->failAt("innerConeAngle", "is larger than outerConeAngle");
}

void Checker::lights() const {
  const Fields root(json, document.file);
  const std::optional<Fields> extensions = root.object("extensions");
  const std::optional<Fields> punctual =
      extensions ? extensions->object("KHR_lights_punctual") : std::nullopt;
  const Json& lights = punctual ? punctual->list("lights") : root.list("no_such_list");
  for (std::size_t i = 0; i < lights.size(); ++i) {
    checkLight(Fields(lights[i], elementName(document.file, "light", i, nameOf(lights[i]))));
  }
  each("nodes", "node", [&](const Fields& fields, std::size_t) {
    const std::optional<Fields> used = fields.object("extensions");
    const std::optional<Fields> light = used ? used->object("KHR_lights_punctual") : std::nullopt;
    if (light) light->index("light", lights.size(), true);
  });
}

}  // namespace

std::string elementOf(const Document& document, const char* list, const char* kind, std::size_t index) {
  return elementName(document.file, kind, index, nameOf(document.json[list][index]));
}

std::size_t componentSize_bytes(int component_type) {
  switch (component_type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

void checkDocument(const Document& document) {
  const Checker c{document};
  c.asset();
  c.lists();
  c.each("buffers", "buffer", [&](const Fields& f, std::size_t) { c.buffer(f); });
  c.each("bufferViews", "bufferView", [&](const Fields& f, std::size_t) { c.view(f); });
  c.each("accessors", "accessor", [&](const Fields& f, std::size_t) { c.accessor(f); });
  c.each("images", "image", [&](const Fields& f, std::size_t) { c.image(f); });
  c.each("samplers", "sampler", [&](const Fields& f, std::size_t) { c.sampler(f); });
  c.each("textures", "texture", [&](const Fields& f, std::size_t) { c.texture(f); });
  c.each("materials", "material", [&](const Fields& f, std::size_t) { c.material(f); });
  c.each("meshes", "mesh", [&](const Fields& f, std::size_t i) { c.mesh(f, i); });
  c.each("animations", "animation", [&](const Fields& f, std::size_t) { c.animation(f); });
  c.lights();
  checkTree(document);
}

}  // namespace host::gltf
