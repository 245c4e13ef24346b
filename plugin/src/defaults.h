// The ABI's default_* functions, and what the plugin takes for the ends of structs that an older host's
// header does not have.
#pragma once

#include <cstring>
#include <type_traits>

#include "struct_sizes.h"

namespace rg {

// Without sizes and strides, which are the host's.
template <typename T>
T defaults() {
  return {};
}
template <>
rg_create_info defaults();
template <>
rg_vehicle defaults();
template <>
rg_weather defaults();
template <>
rg_view defaults();
template <>
rg_volume_info defaults();
template <>
rg_pane_info defaults();
template <>
rg_wiper_info defaults();
template <>
rg_wash_info defaults();
template <>
rg_airflow defaults();
template <>
rg_target defaults();
template <>
rg_lighting defaults();
template <>
rg_capture_info defaults();

// For a host of that minor: as much as its struct has room for, and nothing for null, as no code can be
// returned.
template <uint32_t kMinor, typename T>
void fillDefaults(T* out) {
  if (out == nullptr) return;
  constexpr size_t kSize = sizeIn<T>(kMinor);
  T all = defaults<T>();
  all.struct_size = uint32_t{kSize};
  if constexpr (std::is_same_v<T, rg_sample>) {
    all.vehicle_stride = sizeIn<rg_vehicle>(kMinor);
    all.view_stride = sizeIn<rg_view>(kMinor);
  }
  std::memcpy(out, &all, kSize);
}

}  // namespace rg
