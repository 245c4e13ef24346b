// What the host's own parts hold, as named values: `visit(f)` of each names them once, for writing and for
// reading.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "scenario.h"

namespace host {

class FieldWriter {
 public:
  nlohmann::json json = nlohmann::json::object();

  template <class T, class... Range>
  void operator()(const char* name, const T& value, const Range&...) {
    if constexpr (std::is_enum_v<T>)
      json[name] = static_cast<int>(value);
    else if constexpr (std::is_same_v<T, glm::dvec3>)
      json[name] = {value.x, value.y, value.z};
    else if constexpr (std::is_same_v<T, glm::dquat>)
      json[name] = {value.x, value.y, value.z, value.w};
    else
      json[name] = value;
  }
  template <class Part>
  void part(const char* name, Part& part) {
    FieldWriter inner;
    part.visit(inner);
    json[name] = std::move(inner.json);
  }
};

// Throws InputError that names the value. One that does not commit only looks.
class FieldReader {
 public:
  FieldReader(const nlohmann::json& from, bool commits) : json_(from), commits_(commits) {}

  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      require(at(name).is_boolean(), name);
      take(value, at(name).template get<bool>());
    } else if constexpr (std::is_same_v<T, std::string>) {
      require(at(name).is_string(), name);
      take(value, at(name).template get<std::string>());
    } else if constexpr (std::is_same_v<T, glm::dvec3> || std::is_same_v<T, glm::dquat>) {
      constexpr auto kCount = static_cast<size_t>(T::length());
      require(at(name).is_array() && at(name).size() == kCount, name);
      T read = value;
      for (size_t i = 0; i < kCount; ++i)
        read[static_cast<glm::length_t>(i)] = number(at(name)[i], name, -kMost, kMost);
      take(value, read);
    } else {
      (*this)(name, value, -kMost, kMost);
    }
  }
  template <class T, class L, class M>
  void operator()(const char* name, T& value, L least, M most) {
    const double read = number(at(name), name, static_cast<double>(least), static_cast<double>(most));
    if constexpr (!std::is_floating_point_v<T>) require(std::floor(read) == read, name);
    take(value, static_cast<T>(read));
  }
  template <class Part>
  void part(const char* name, Part& part) {
    require(at(name).is_object(), name);
    FieldReader inner(at(name), commits_);
    part.visit(inner);
  }

 private:
  static constexpr double kMost = 1e10;

  const nlohmann::json& at(const char* name) const {
    const auto found = json_.find(name);
    require(found != json_.end(), name);
    return *found;
  }
  static void require(bool met, const char* name) {
    if (!met) throw InputError(std::string("\"") + name + "\" is missing or no value of its kind");
  }
  static double number(const nlohmann::json& json, const char* name, double least, double most) {
    require(json.is_number(), name);
    const double read = json.get<double>();
    require(read >= least && read <= most, name);
    return read;
  }
  template <class T>
  void take(T& value, const T& read) const {
    if (commits_) value = read;
  }

  const nlohmann::json& json_;
  bool commits_;
};

template <class Part>
nlohmann::json fieldsOf(Part& part) {
  FieldWriter writer;
  part.visit(writer);
  return std::move(writer.json);
}

// All of them or, where one is wrong, none.
template <class Part>
void setFields(Part& part, const nlohmann::json& fields) {
  if (!fields.is_object()) throw InputError("it holds no simulation");
  for (const bool commits : {false, true}) {
    FieldReader reader(fields, commits);
    part.visit(reader);
  }
}

}  // namespace host
