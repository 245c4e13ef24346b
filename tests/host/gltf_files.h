#pragma once
// Small glTF files made in code: whole ones, and ones broken in a single place.

#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace files {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// A folder that goes with the test.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "rainglass_test_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream stream(path_ / name, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path_ / name;
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    return write(name, Bytes(text.begin(), text.end()));
  }

 private:
  std::filesystem::path path_;
};

template <typename T>
void append(Bytes& bytes, const T& value) {
  Bytes raw(sizeof(T));
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.insert(bytes.end(), raw.begin(), raw.end());
}

/// A document with one buffer that grows.
struct Gltf {
  Json json = {{"asset", {{"version", "2.0"}}}, {"buffers", Json::array({{{"byteLength", 0}}})}};
  Bytes bin;

  int add(const char* list, Json element) {
    json[list].push_back(std::move(element));
    return static_cast<int>(json[list].size()) - 1;
  }

  int addView(const Bytes& bytes) {
    while (bin.size() % 4 != 0) bin.push_back(0);
    const std::size_t at = bin.size();
    bin.insert(bin.end(), bytes.begin(), bytes.end());
    json["buffers"][0]["byteLength"] = bin.size();
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", at}, {"byteLength", bytes.size()}});
  }

  int addFloats(const char* type, std::size_t components, const std::vector<float>& values) {
    Bytes bytes;
    for (const float value : values) append(bytes, value);
    return add("accessors", {{"bufferView", addView(bytes)},
                             {"componentType", 5126},
                             {"count", values.size() / components},
                             {"type", type}});
  }

  template <typename T>
  int addIndices(int component_type, const std::vector<T>& values) {
    Bytes bytes;
    for (const T value : values) append(bytes, value);
    return add("accessors", {{"bufferView", addView(bytes)},
                             {"componentType", component_type},
                             {"count", values.size()},
                             {"type", "SCALAR"}});
  }

  Bytes glb() const {
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    Bytes chunk = bin;
    chunk.resize((chunk.size() + 3) / 4 * 4);
    Bytes out;
    append(out, std::uint32_t{0x46546C67});
    append(out, std::uint32_t{2});
    append(out, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + chunk.size()));
    append(out, static_cast<std::uint32_t>(text.size()));
    append(out, std::uint32_t{0x4E4F534A});
    out.insert(out.end(), text.begin(), text.end());
    append(out, static_cast<std::uint32_t>(chunk.size()));
    append(out, std::uint32_t{0x004E4942});
    out.insert(out.end(), chunk.begin(), chunk.end());
    return out;
  }

  /// As text, with the buffer in `buffer.bin` beside it.
  std::string gltf() const {
    Json text = json;
    text["buffers"][0]["uri"] = "buffer.bin";
    return text.dump();
  }
};

/// 1 x 1 pixel, red 200, green 100, blue 50, no alpha (made with zlib's stored-size output of one row).
Bytes tinyPng();

/// A car with all there is: body, pane, wiper with child, shelter, eye, lamps, wheel, steering wheel, mirror,
/// route, animation.
Gltf wholeCar();

}  // namespace files
