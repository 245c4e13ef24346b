#pragma once
// Reading JSON objects with every key's type and range checked, so that a wrong one gives one line that names
// file, element and key.

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace host::gltf {

using Json = nlohmann::json;

constexpr std::size_t kLongestName_bytes = 63;  // of a name that is used or shown

/// Throws SceneError("WHERE: WHAT") as one printable line of at most 500 bytes.
[[noreturn]] void fail(const std::string& where, const std::string& what);

/// `FILE: KIND INDEX "NAME"`, without the name when there is none.
std::string elementName(const std::string& file, const std::string& kind, std::size_t index,
                        const std::string& name);

/// The object's "name" if it is text, else nothing.
std::string nameOf(const Json& object);

/// One JSON object. `where` names the element, `prefix` is what its keys are called behind
/// ("extras.rainglass.").
class Fields {
 public:
  /// Fails when `object` is none. The object must outlive this.
  Fields(const Json& object, std::string where, std::string prefix = "");

  bool has(const char* key) const { return object_->contains(key); }
  double number(const char* key, double lowest, double highest, std::optional<double> otherwise = {}) const;
  std::int64_t integer(const char* key, std::int64_t lowest, std::int64_t highest,
                       std::optional<std::int64_t> otherwise = {}) const;
  /// An index into a list of `count` elements; -1 where the key is missing and not `required`.
  int index(const char* key, std::size_t count, bool required = false) const;
  /// true, false, 1 or 0 (Blender 3.4 keeps custom booleans as integers).
  bool flag(const char* key, bool otherwise) const;
  std::string text(const char* key, std::size_t longest_bytes,
                   const std::optional<std::string>& otherwise = {}) const;
  /// Between `fewest` and `most` numbers that are finite as float; nothing where the key is missing.
  std::vector<float> numbers(const char* key, std::size_t fewest, std::size_t most) const;
  /// All elements of a list of indices; nothing where the key is missing.
  std::vector<int> indices(const char* key, std::size_t count) const;
  /// The list under the key, or an empty one where it is missing.
  const Json& list(const char* key) const;
  /// The object under the key; nothing where it is missing.
  std::optional<Fields> object(const char* key) const;
  /// Fails when there is a key that is not one of these.
  void allowOnly(std::initializer_list<const char*> keys) const;

  [[noreturn]] void failAt(const std::string& key, const std::string& what) const;
  const Json& json() const { return *object_; }
  const std::string& where() const { return where_; }

 private:
  const Json* find(const char* key) const;
  const Json& require(const char* key) const;

  const Json* object_;
  std::string where_;
  std::string prefix_;
};

}  // namespace host::gltf
