#include "scene/gltf/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace host::gltf {

namespace {

constexpr std::size_t kLongestLine_bytes = 500;

std::string shorten(const std::string& text, std::size_t longest_bytes) {
  return text.size() <= longest_bytes ? text : text.substr(0, longest_bytes) + "...";
}

// Names come from the file: control characters would break the line or the terminal.
std::string printable(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  return text;
}

std::string format(double number) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.7g", number);
  return text.data();
}

std::string show(const Json& value) {
  if (value.is_number_float()) return format(value.get<double>());
  if (value.is_number() || value.is_boolean()) return value.dump();
  if (value.is_string())
    return "\"" + shorten(value.get_ref<const std::string&>(), kLongestName_bytes) + "\"";
  if (value.is_null()) return "null";
  return value.is_array() ? "a list" : "an object";
}

bool finiteAsFloat(double number) {
  return std::abs(number) <= static_cast<double>(std::numeric_limits<float>::max());  // false for NaN
}

}  // namespace

void fail(const std::string& where, const std::string& what) {
  throw SceneError(printable(shorten(where + ": " + what, kLongestLine_bytes)));
}

std::string elementName(const std::string& file, const std::string& kind, std::size_t index,
                        const std::string& name) {
  std::string text = file + ": " + kind + " " + std::to_string(index);
  if (!name.empty()) text += " \"" + shorten(name, kLongestName_bytes) + "\"";
  return text;
}

std::string nameOf(const Json& object) {
  if (!object.is_object()) return "";
  const auto it = object.find("name");
  return it != object.end() && it->is_string() ? it->get<std::string>() : "";
}

Fields::Fields(const Json& object, std::string where, std::string prefix)
    : object_(&object), where_(std::move(where)), prefix_(std::move(prefix)) {
  if (object.is_object()) return;
  const std::string self = prefix_.empty() ? "" : prefix_.substr(0, prefix_.size() - 1) + " ";
  fail(where_, self + "is " + show(object) + ", must be an object");
}

void Fields::failAt(const std::string& key, const std::string& what) const {
  fail(where_, prefix_ + key + " " + what);
}

const Json* Fields::find(const char* key) const {
  const auto it = object_->find(key);
  return it == object_->end() ? nullptr : &*it;
}

const Json& Fields::require(const char* key) const {
  const Json* value = find(key);
  if (value == nullptr) failAt(key, "is missing");
  return *value;
}

double Fields::number(const char* key, double lowest, double highest, std::optional<double> otherwise) const {
  if (otherwise && !has(key)) return *otherwise;
  const Json& value = require(key);
  if (!value.is_number()) failAt(key, "is " + show(value) + ", must be a number");
  const double number = value.get<double>();
  if (!(number >= lowest && number <= highest)) {
    failAt(key, "is " + show(value) + ", must be " + format(lowest) + ".." + format(highest));
  }
  return number;
}

std::int64_t Fields::integer(const char* key, std::int64_t lowest, std::int64_t highest,
                             std::optional<std::int64_t> otherwise) const {
  if (otherwise && !has(key)) return *otherwise;
  const Json& value = require(key);
  if (!value.is_number_integer()) failAt(key, "is " + show(value) + ", must be an integer");
  const bool too_large =
      value.is_number_unsigned() &&
      value.get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const std::int64_t number = too_large ? 0 : value.get<std::int64_t>();
  if (too_large || number < lowest || number > highest) {
    failAt(key, "is " + show(value) + ", must be " + std::to_string(lowest) + ".." + std::to_string(highest));
  }
  return number;
}

int Fields::index(const char* key, std::size_t count, bool required) const {
  if (!required && !has(key)) return -1;
  const Json& value = require(key);
  if (!value.is_number_integer()) failAt(key, "is " + show(value) + ", must be an index");
  // Negative numbers wrap to huge ones.
  if (value.get<std::uint64_t>() >= count || value.get<std::uint64_t>() > std::numeric_limits<int>::max()) {
    failAt(key, "is " + show(value) + ", but there are only " + std::to_string(count));
  }
  return value.get<int>();
}

bool Fields::flag(const char* key, bool otherwise) const {
  const Json* value = find(key);
  if (value == nullptr) return otherwise;
  if (value->is_boolean()) return value->get<bool>();
  if (*value == 0) return false;
  if (*value == 1) return true;
  failAt(key, "is " + show(*value) + ", must be true or false");
}

std::string Fields::text(const char* key, std::size_t longest_bytes,
                         const std::optional<std::string>& otherwise) const {
  if (otherwise && !has(key)) return *otherwise;
  const Json& value = require(key);
  if (!value.is_string()) failAt(key, "is " + show(value) + ", must be text");
  std::string text = value.get<std::string>();
  if (text.size() > longest_bytes) {
    failAt(key, "has " + std::to_string(text.size()) + " bytes, at most " + std::to_string(longest_bytes) +
                    " are allowed");
  }
  return text;
}

std::vector<float> Fields::numbers(const char* key, std::size_t fewest, std::size_t most) const {
  const Json& values = list(key);
  if (!has(key)) return {};
  if (values.size() < fewest || values.size() > most) {
    const std::string range = fewest == most ? std::to_string(fewest) : std::to_string(fewest) + " or more";
    failAt(key, "has " + std::to_string(values.size()) + " numbers, must have " + range);
  }
  std::vector<float> numbers;
  numbers.reserve(values.size());
  for (const Json& value : values) {
    if (!value.is_number() || !finiteAsFloat(value.get<double>())) {
      failAt(key, "holds " + show(value) + ", must hold finite numbers");
    }
    numbers.push_back(value.get<float>());
  }
  return numbers;
}

std::vector<int> Fields::indices(const char* key, std::size_t count) const {
  std::vector<int> indices;
  for (const Json& value : list(key)) {
    if (!value.is_number_integer() || value.get<std::uint64_t>() >= count) {
      failAt(key, "holds " + show(value) + ", but there are only " + std::to_string(count));
    }
    indices.push_back(value.get<int>());
  }
  return indices;
}

const Json& Fields::list(const char* key) const {
  static const Json kEmpty = Json::array();
  const Json* value = find(key);
  if (value == nullptr) return kEmpty;
  if (!value->is_array()) failAt(key, "is " + show(*value) + ", must be a list");
  return *value;
}

std::optional<Fields> Fields::object(const char* key) const {
  const Json* value = find(key);
  if (value == nullptr) return {};
  return Fields(*value, where_, prefix_ + key + ".");
}

void Fields::allowOnly(std::initializer_list<const char*> keys) const {
  for (const auto& item : object_->items()) {
    if (std::find(keys.begin(), keys.end(), item.key()) == keys.end())
      failAt(shorten(item.key(), 63), "is not a known key");
  }
}

}  // namespace host::gltf
