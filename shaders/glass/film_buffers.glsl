// What the film's kernels share: the film itself, ridges, the state of its tiles and the orders of a step.
#include "shared/glass_film.glsl"

layout(std140, binding = 0) uniform StepInfo { FilmStepInfo info; };
layout(std430, binding = 1) buffer Ridges {
  int ridge_pl[kMaxGlassWipers * kBladeSegments];
  uint thrown_pl[kMaxGlassWipers * kBladeSegments]; // off the pane so far, modulo 2^32: a piece holds less, and leaves no more than once a step
};

// Water below the pin lies still. A tile is looked at when some on it or on a tile beside it may flow, when it was given or lost water, and
// when it is its turn to dry; and once more, as the film is in one buffer and then in the other.
struct TileState {
  int stirs[2]; // holds water that may flow, or was changed from outside: as this turn's kernels ask, and as they tell the next
  int awake; // in the last step
  int lies[3]; // of its last report: low and high part of the film, beads
};
layout(std430, binding = 5) buffer States { TileState states[]; };

layout(location = 0) uniform int count;
layout(location = 1) uniform int turn; // of two, one for every other step

const int kStrips = kTileSize / kStripSize; // of a tile's row

int tilesAcross() { return (info.columns + kTileSize - 1) / kTileSize; }

// The film lies in rows of whole tiles.
int placeOf(int texel) { return texel / info.columns * (tilesAcross() * kTileSize) + texel % info.columns; }

void wake(int texel) { states[texel / info.columns / kTileSize * tilesAcross() + texel % info.columns / kTileSize].stirs[turn] = 1; }

// In a test build one of these loses 1 % of what passes through it: FilmKernel of pane_gl.h.
const int kTake = 1, kAdd = 2, kRidge = 3, kSweep = 4, kLeave = 5, kFlow = 6, kBeadAdd = 7, kBead = 8;
#ifdef RG_LEAKS
layout(location = 8) uniform int leaky_kernel;
#endif
int passed(int kernel, int volume_pl) {
#ifdef RG_LEAKS
  if (kernel == leaky_kernel) return volume_pl - volume_pl / 100;
#endif
  return volume_pl;
}

// A texel's film and beads after a change, and what was taken of both.
struct Changed { int film_pl; Beads beads; int taken_pl; };
Changed changedBy(FilmChange change, int film_pl, Beads lying) {
  int taken = shareOf(film_pl, change.share_65536), taken_beads = shareOf(lying.volume_pl, change.share_65536);
  Changed now;
  now.film_pl = film_pl + passed(kAdd, change.added_pl) - taken;
  now.beads = joinedBy(withoutPart(lying, taken_beads), passed(kBeadAdd, change.beads_pl), change.beads, now.film_pl);
  now.taken_pl = passed(kTake, taken + taken_beads);
  return now;
}
