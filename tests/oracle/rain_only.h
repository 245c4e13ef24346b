// The plugin's ABI with nothing behind it but the plugin's own timeline and rain field, so that the host's
// simulation can drive them without a GPU and a test can look at each streak.
#pragma once

#include <memory>

#include "rain/field.h"
#include "rainglass/rainglass.h"
#include "settings.h"
#include "timeline.h"

namespace oracle {

struct RainOnly {
  rg::Timeline timeline;
  uint32_t capacity_drops = 0;
  std::unique_ptr<rg::rain::Field> field;
  uint64_t seed = 1;
  rg::Settings settings;  // of which those of the wind count
  rg::rain::WindProfile profile;
  int64_t next_tick = INT64_MIN;
  glm::dvec3 wind_mps{0.0};  // of the last tick
};

// Its create() makes a RainOnly; panes and wipers are taken and forgotten.
const rg_api& rainOnlyApi();
inline RainOnly& rainOnly(rg_instance* instance) { return *reinterpret_cast<RainOnly*>(instance); }

// Volumes are forgotten too, from now on or no more: what a field without shelter would draw.
void forgetVolumes(bool forget);

}  // namespace oracle
