// What the film's kernels share: the film itself, ridges, the orders of a step and the report of it.
#include "shared/glass_film.glsl"

layout(std140, binding = 0) uniform StepInfo { FilmStepInfo info; };
layout(std430, binding = 1) buffer Ridges {
  int ridge_pl[kMaxGlassWipers * kBladeSegments];
  uint wiped_pl;                                          // thrown off so far, modulo 2^32
};


// Water below the pin lies still. A tile is looked at when some on it or on a tile beside it may flow, when it was given or lost water, and
// when it is its turn to dry.
struct TileState {
  int stirs; // holds water that may flow, or was changed from outside
  int awake; // in this step
  uint film_low_pl, film_high; // of its last report
};
layout(std430, binding = 5) buffer States { TileState states[]; };

layout(location = 0) uniform int count;

void wake(int texel) {
  int tiles_across = (info.columns + kTileSize - 1) / kTileSize;
  states[texel / info.columns / kTileSize * tiles_across + texel % info.columns / kTileSize].stirs = 1;
}

// In a test build one kernel loses 1 % of what passes through it.
int passed(int volume_pl) {
#ifdef RG_LEAK
  return volume_pl - volume_pl / 100;
#else
  return volume_pl;
#endif
}

ivec2 cellOf(int texel) { return ivec2(texel % info.columns, texel / info.columns); }
