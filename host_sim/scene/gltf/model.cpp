#include "scene/gltf/model.h"

#include <map>
#include <optional>

#include "image/decode.h"
#include "scene/gltf/check.h"

namespace host::gltf {

namespace {

constexpr std::int64_t kMostPixels = 256LL << 20;  // of all images together: 1 GiB

/// What tinygltf asks for while it parses. It knows resources by number only.
struct Supply {
  const Document& document;
  std::map<std::string, Bytes> resources;
  std::int64_t pixels = 0;
  std::optional<SceneError> error;  // of a callback: thrown once tinygltf has returned
};

std::string resourceName(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

bool resourceExists(const std::string& path, void* user) {
  return static_cast<Supply*>(user)->resources.contains(resourceName(path));
}

std::string resourcePath(const std::string& path, void*) { return path; }

bool readResource(std::vector<unsigned char>* out, std::string*, const std::string& path, void* user) {
  auto& resources = static_cast<Supply*>(user)->resources;
  const auto found = resources.find(resourceName(path));
  if (found == resources.end()) return false;
  *out = std::move(found->second);
  resources.erase(found);  // each is asked for once
  return true;
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

bool decodeImage(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void* user) {
  auto& supply = *static_cast<Supply*>(user);
  const std::string where = elementOf(supply.document, "images", "image", static_cast<std::size_t>(index));
  try {
    Pixels pixels = decodePixels({bytes, static_cast<std::size_t>(size)});
    supply.pixels += static_cast<std::int64_t>(pixels.width_px) * pixels.height_px;
    if (supply.pixels > kMostPixels) fail(where, "takes all images together above 256 million pixels");
    image->width = pixels.width_px;
    image->height = pixels.height_px;
    image->component = 4;
    image->bits = 8;
    image->pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    image->image = std::move(pixels.rgba);
    return true;
  } catch (const SceneError& error) {
    supply.error = error;
  } catch (const std::exception& error) {
    supply.error = SceneError(where + ": " + error.what());
  }
  return false;
}

Bytes bufferBytes(const Document& document, std::size_t index) {
  const std::string where = elementOf(document, "buffers", "buffer", index);
  const Json& buffer = document.json["buffers"][index];
  const auto size = buffer["byteLength"].get<std::size_t>();
  const bool is_chunk = !buffer.contains("uri");
  if (is_chunk && (index != 0 || !document.has_bin))
    fail(where, "has no uri, and there is no binary chunk for it");
  Bytes bytes = is_chunk ? document.bin : readUri(buffer["uri"].get<std::string>(), document.folder, where);
  if (bytes.size() < size) {
    fail(where, "byteLength is " + std::to_string(size) + ", but only " + std::to_string(bytes.size()) +
                    " bytes are there");
  }
  bytes.resize(size);  // a chunk is padded; a file may be longer
  return bytes;
}

// Skins, cameras, morph targets, sparse accessors and extras are not used; tinygltf is not to trip over them
// either.
Json trimmed(const Document& document) {
  static constexpr std::array kKept = {"asset",     "scene",       "scenes",     "nodes",     "meshes",
                                       "accessors", "bufferViews", "materials",  "buffers",   "textures",
                                       "images",    "samplers",    "animations", "extensions"};
  Json json = Json::object();
  for (const char* key : kKept) {
    if (document.json.contains(key)) json[key] = document.json[key];
  }
  for (auto& list : json) {
    for (Json& element : list) {
      if (!list.is_array() || !element.is_object()) continue;
      for (const char* key : {"extras", "skin", "camera", "weights", "sparse"}) element.erase(key);
    }
  }
  if (json.contains("meshes")) {
    for (Json& mesh : json["meshes"]) {
      for (Json& primitive : mesh["primitives"]) {
        for (const char* key : {"extras", "targets", "extensions"}) primitive.erase(key);
      }
    }
  }
  return json;
}

// Every buffer and image gets a number in place of its uri.
void replaceUris(Json& json, Supply& supply) {
  const auto give = [&](Json& element, Bytes bytes) {
    const std::string name = "resource" + std::to_string(supply.resources.size());
    supply.resources.emplace(name, std::move(bytes));
    element["uri"] = name;
  };
  const Document& document = supply.document;
  for (std::size_t i = 0; json.contains("buffers") && i < json["buffers"].size(); ++i) {
    give(json["buffers"][i], bufferBytes(document, i));
  }
  for (std::size_t i = 0; json.contains("images") && i < json["images"].size(); ++i) {
    Json& image = json["images"][i];
    if (!image.contains("uri")) continue;
    const std::string where = elementOf(document, "images", "image", i);
    Bytes bytes = readUri(image["uri"].get<std::string>(), document.folder, where);
    if (bytes.empty()) fail(where, "is an empty file");
    give(image, std::move(bytes));
  }
}

bool isComplete(const Document& document, const tinygltf::Model& model) {
  const auto count = [&](const char* list) {
    return document.json.contains(list) ? document.json[list].size() : 0;
  };
  for (const tinygltf::Image& image : model.images) {
    if (image.image.empty()) return false;
  }
  for (std::size_t i = 0; i < model.buffers.size(); ++i) {
    if (model.buffers[i].data.size() != document.json["buffers"][i]["byteLength"].get<std::size_t>())
      return false;
  }
  return model.buffers.size() == count("buffers") && model.bufferViews.size() == count("bufferViews") &&
         model.accessors.size() == count("accessors") && model.meshes.size() == count("meshes") &&
         model.nodes.size() == count("nodes") && model.materials.size() == count("materials") &&
         model.textures.size() == count("textures") && model.images.size() == count("images") &&
         model.samplers.size() == count("samplers") && model.scenes.size() == count("scenes") &&
         model.animations.size() == count("animations");
}

std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

tinygltf::Model parseModel(const Document& document) {
  Supply supply{document, {}, 0, {}};
  Json json = trimmed(document);
  replaceUris(json, supply);
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({resourceExists, resourcePath, readResource, writeNothing, &supply});
  loader.SetImageLoader(decodeImage, &supply);
  const std::string text = json.dump();
  json = nullptr;
  tinygltf::Model model;
  std::string error;
  std::string warning;
  const bool loaded = loader.LoadASCIIFromString(&model, &error, &warning, text.c_str(),
                                                 static_cast<unsigned>(text.size()), "");
  if (supply.error) throw *supply.error;
  if (!loaded) fail(document.file, "tinygltf: " + firstLine(error));
  if (!isComplete(document, model)) fail(document.file, "tinygltf has not read all of it");
  return model;
}

}  // namespace host::gltf
