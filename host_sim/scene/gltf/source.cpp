#include "scene/gltf/source.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene/gltf/check.h"

namespace host::gltf {

namespace {

struct Span {
  const std::uint8_t* data;
  std::size_t stride;
  std::size_t count;
};

Span spanOf(const Source& source, int index, std::size_t element_bytes, const std::string& user) {
  const auto at = static_cast<std::size_t>(index);
  const tinygltf::Accessor& accessor = source.model.accessors[at];
  const std::string name = "accessor " + std::to_string(index);
  if (source.document.json["accessors"][at].contains("sparse"))
    fail(user, name + " is sparse, which is not supported");
  if (accessor.bufferView < 0) fail(user, name + " has no bufferView");
  const tinygltf::BufferView& view =
      source.model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const tinygltf::Buffer& buffer = source.model.buffers.at(static_cast<std::size_t>(view.buffer));
  const std::size_t stride = view.byteStride == 0 ? element_bytes : view.byteStride;
  const std::size_t begin = view.byteOffset + accessor.byteOffset;
  // checkDocument() has bounded each of these to 2^31 at most, so nothing wraps in 64 bits.
  if (accessor.count == 0 || begin + (accessor.count - 1) * stride + element_bytes > buffer.data.size()) {
    fail(user, name + " reaches beyond its buffer");
  }
  return {buffer.data.data() + begin, stride, accessor.count};
}

template <typename T>
float scaled(const std::uint8_t* from, bool normalized) {
  T value;
  std::memcpy(&value, from, sizeof(T));  // may be unaligned
  if constexpr (std::is_floating_point_v<T>) {
    return value;
  } else {
    const auto number = static_cast<float>(value);
    return normalized ? std::max(number / static_cast<float>(std::numeric_limits<T>::max()), -1.0F) : number;
  }
}

float component(const std::uint8_t* from, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled<std::int8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled<std::uint8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled<std::int16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled<std::uint16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return scaled<std::uint32_t>(from, normalized);
    default:
      return scaled<float>(from, false);
  }
}

std::uint32_t unsignedAt(const std::uint8_t* from, std::size_t bytes) {
  std::uint32_t value = 0;  // glTF is little-endian
  for (std::size_t i = 0; i < bytes; ++i) value |= static_cast<std::uint32_t>(from[i]) << (8 * i);
  return value;
}

}  // namespace

int Source::components(int accessor) const {
  return tinygltf::GetNumComponentsInType(
      static_cast<std::uint32_t>(model.accessors[static_cast<std::size_t>(accessor)].type));
}

std::vector<float> Source::floats(int accessor, int components, const std::string& user) const {
  const tinygltf::Accessor& a = model.accessors.at(static_cast<std::size_t>(accessor));
  const bool is_vector =
      a.type == TINYGLTF_TYPE_SCALAR || (a.type >= TINYGLTF_TYPE_VEC2 && a.type <= TINYGLTF_TYPE_VEC4);
  if (!is_vector || this->components(accessor) != components) {
    fail(user,
         "accessor " + std::to_string(accessor) + " must have " + std::to_string(components) + " components");
  }
  const std::size_t size = componentSize_bytes(a.componentType);
  const auto n = static_cast<std::size_t>(components);
  const Span span = spanOf(*this, accessor, n * size, user);
  std::vector<float> values;
  values.reserve(span.count * n);
  for (std::size_t i = 0; i < span.count * n; ++i) {
    values.push_back(
        component(span.data + i / n * span.stride + i % n * size, a.componentType, a.normalized));
    if (std::isfinite(values.back())) continue;
    fail(user, "accessor " + std::to_string(accessor) + " holds a number that is not finite, in element " +
                   std::to_string(i / n));
  }
  return values;
}

std::vector<std::uint32_t> Source::integers(int accessor, const std::string& user) const {
  const tinygltf::Accessor& a = model.accessors.at(static_cast<std::size_t>(accessor));
  const bool is_unsigned = a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                           a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                           a.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (a.type != TINYGLTF_TYPE_SCALAR || !is_unsigned) {
    fail(user, "accessor " + std::to_string(accessor) + " must hold unsigned integers");
  }
  const std::size_t size = componentSize_bytes(a.componentType);
  const Span span = spanOf(*this, accessor, size, user);
  std::vector<std::uint32_t> values(span.count);
  for (std::size_t i = 0; i < span.count; ++i) values[i] = unsignedAt(span.data + i * span.stride, size);
  return values;
}

}  // namespace host::gltf
