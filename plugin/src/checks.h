// From the ABI's structs to the plugin's own: nothing a host gives is used before it passed here. All
// functions throw ApiError that names the field, and have no other effect.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "error.h"
#include "tick.h"
#include "timeline.h"

namespace rg {

inline constexpr uint32_t kLargestStruct =
    4096;  // bytes; a struct_size above this is a mistake, not a newer header

// A struct of the first ABI version or a later, longer one; unknown fields at its end are ignored.
template <typename T>
T readStruct(const T* in, const char* name) {
  if (in == nullptr) refuse(std::string(name) + " is null");
  if (in->struct_size < sizeof(T) || in->struct_size > kLargestStruct) {
    refuse(std::string(name) + ".struct_size is " + std::to_string(in->struct_size) + ", must be " +
               std::to_string(sizeof(T)) + " or what a later header says",
           RG_ERROR_BAD_STRUCT);
  }
  T out;
  std::memcpy(&out, in, sizeof(T));
  return out;
}

// Element i of an array with a stride in bytes.
template <typename T>
const T* element(const T* items, size_t stride, size_t i) {
  return reinterpret_cast<const T*>(reinterpret_cast<const unsigned char*>(items) + i * stride);
}

void checkArray(const void* items, uint64_t count, size_t stride, size_t element_size, size_t alignment,
                uint64_t most, const char* name);
// `element_size` bytes of each element are read; elements are aligned as T.
template <typename T>
void checkArray(const T* items, uint64_t count, size_t stride, size_t element_size, uint64_t most,
                const char* name) {
  checkArray(items, count, stride, element_size, alignof(T), most, name);
}
void checkTime(int64_t time_ns, const char* name);
void checkRange(double value, double least, double most, const char* name);
std::string readName(const char* name, const char* field);

Sample readSample(const rg_sample* in, const Sample* before);
ViewState readView(const rg_view* in);
rg_create_info readCreateInfo(const rg_create_info* in);

}  // namespace rg
