// From the ABI's structs to the plugin's own: nothing a host gives is used before it passed here. All
// functions throw ApiError that names the field, and have no other effect.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "defaults.h"
#include "error.h"
#include "struct_sizes.h"
#include "tick.h"
#include "timeline.h"

namespace rg {

inline constexpr uint32_t kLargestStruct =
    4096;  // bytes; a struct_size above this is a mistake, not a newer header
inline constexpr double kWidestOpening_m = 10.0;

// How much of a struct of that size is known here: as this header or one before it says; a longer one's end
// is a later header's. Refuses sizes that fit none.
template <typename T>
size_t knownSize(uint32_t struct_size, const char* name) {
  const bool older = std::ranges::find(kSizes<T>, struct_size, &SizeSince::bytes) != kSizes<T>.end();
  if (!older && (struct_size < sizeof(T) || struct_size > kLargestStruct)) {
    refuse(std::string(name) + ".struct_size is " + std::to_string(struct_size) + ", must be " +
               std::to_string(sizeof(T)) + " or what another header says",
           RG_ERROR_BAD_STRUCT);
  }
  return struct_size < sizeof(T) ? struct_size : sizeof(T);
}

// A struct of any ABI version; what an older one lacks is as by default.
template <typename T>
T readStruct(const T* in, const char* name) {
  if (in == nullptr) refuse(std::string(name) + " is null");
  T all = defaults<T>();
  std::memcpy(&all, in, knownSize<T>(in->struct_size, name));
  return all;
}

// Element i of an array with a stride in bytes; checkArray has seen that all its elements are aligned.
template <typename T>
const T* element(const T* items, size_t stride, size_t i) {
  const void* at = reinterpret_cast<const unsigned char*>(items) + i * stride;
  return static_cast<const T*>(at);
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
