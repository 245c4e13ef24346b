// What the kernels share in which a group is a tile, an invocation for each texel: those for GPUs.
#include "glass/film_buffers.glsl"

const int kTileTexels = kTileSize * kTileSize;
layout(local_size_x = kTileTexels) in;

ivec2 tileAt(int t) { return ivec2(t % tilesAcross(), t / tilesAcross()); }
int lane() { return int(gl_LocalInvocationIndex); }
ivec2 laneAt() { return ivec2(lane() % kTileSize, lane() / kTileSize); }

// Of a texel of a tile: its number, and its place in the film.
int texelOf(ivec2 tile, ivec2 at) { return (tile.y * kTileSize + at.y) * info.columns + tile.x * kTileSize + at.x; }
int placeIn(ivec2 tile, ivec2 at) { return ((tile.y * kTileSize + at.y) * tilesAcross() + tile.x) * kTileSize + at.x; }

// A texel's place between the edges of its tile.
float fraction(int at) { return (float(at & (kTileSize - 1)) + 0.5) / float(kTileSize); }

shared ivec4 summands[kTileTexels];

// The group's sum, for its first invocation. In two stages of sixteen: with atomics all would wait for one address.
ivec4 summed(ivec4 own) {
  const int kStage = 16;
  summands[lane()] = own;
  barrier();
  if (lane() < kStage) {
    for (int k = lane() + kStage; k < kTileTexels; k += kStage) own += summands[k];
    summands[lane()] = own;
  }
  barrier();
  if (lane() == 0) {
    for (int k = 1; k < kStage; ++k) own += summands[k];
  }
  return own;
}

// As a tile tells it: low and high part of a texel's film, its beads.
ivec3 toldOf(int film_pl, int beads_pl) {
  int whole = max(film_pl, 0);
  return ivec3(whole & 0xffff, whole >> 16, beads_pl);
}
