// What the film's kernels share: the film itself, ridges, the orders of a step and the report of it.
#include "shared/glass_film.glsl"

layout(std140, binding = 0) uniform StepInfo { FilmStepInfo info; };
layout(std430, binding = 1) buffer Ridges {
  int ridge_pl[kMaxGlassWipers * kBladeSegments];
  int ridge_before_pl[kMaxGlassWipers * kBladeSegments];  // as it was when the step's sweeps began
  uint wiped_pl;                                          // thrown off so far, modulo 2^32
};

layout(location = 0) uniform int count;

// In a test build one kernel loses 1 % of what passes through it.
int passed(int volume_pl) {
#ifdef RG_LEAK
  return volume_pl - volume_pl / 100;
#else
  return volume_pl;
#endif
}

ivec2 cellOf(int texel) { return ivec2(texel % info.columns, texel / info.columns); }
