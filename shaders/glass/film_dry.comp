// Tiles whose turn it is dry, and film on them breaks up: a group for each, an invocation for each strip. Before the flow; those asleep stay so, which
// is why the film's other copy is written too. Apart from the flow, as software GL runs through branches that nobody takes.
#include "glass/film_buffers.glsl"
layout(local_size_x = kTileSize * kTileSize / kStripSize) in;
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles
layout(std430, binding = 3) buffer Film { ivec4 film[]; };
layout(std430, binding = 7) writeonly buffer Other { ivec4 other[]; };
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };
layout(std430, binding = 4) readonly buffer Awake {
  AwakeTiles awake[2], drying[2];
  int listed[];
};
layout(std430, binding = 6) buffer Lying { uvec4 beads[]; };

shared int dried_pl;
shared uint film_low_pl, film_high, beads_pl;

void dryStrip(int tile) {
  const int kStrips = kTileSize / kStripSize;
  ivec2 corner = ivec2(tile % tilesAcross(), tile / tilesAcross());
  int lane = int(gl_LocalInvocationIndex), column = lane % kStrips, row = lane / kStrips;
  int strip = (corner.y * kTileSize + row) * tilesAcross() * kStrips + corner.x * kStrips + column;
  int texel = (corner.y * kTileSize + row) * info.columns + corner.x * kTileSize + column * kStripSize;
  int low = corner.y * (tilesAcross() + 1) + corner.x, high = low + tilesAcross() + 1;
  vec4 m[4] = vec4[4](imageLoad(metric, low), imageLoad(metric, low + 1), imageLoad(metric, high), imageLoad(metric, high + 1));
  ivec4 film_pl = film[strip];
  uvec4 lying = beads[strip];
  int sum = 0;
  uint low_sum = 0u, high_sum = 0u, beads_sum = 0u;
  for (int k = 0; k < kStripSize; ++k) {
    vec2 f = (vec2(column * kStripSize + k, row) + 0.5) / float(kTileSize);
    // As the flow has it: along rows first.
    vec4 here = between(between(m[0], m[1], f.x), between(m[2], m[3], f.x), f.y);
    FilmTexel left = dried(film_pl[k], beadsOf(lying[k]), uint(texel + k), here, info);
    sum += left.gone_pl;
    uint whole = uint(max(left.film_pl, 0));
    low_sum += whole & 0xffffu;
    high_sum += whole >> 16u;
    beads_sum += uint(left.beads.volume_pl);
    film_pl[k] = left.film_pl;
    lying[k] = packedBeads(left.beads);
  }
  film[strip] = film_pl;
  other[strip] = film_pl;
  beads[strip] = lying;
  atomicAdd(dried_pl, sum);
  atomicAdd(film_low_pl, low_sum);
  atomicAdd(film_high, high_sum);
  atomicAdd(beads_pl, beads_sum);
}

void main() {
  uint place = gl_WorkGroupID.y * kTilesInRow + gl_WorkGroupID.x;
  if (place >= drying[turn].number) return;
  int t = listed[uint(count) + place];
  bool first = gl_LocalInvocationIndex == 0u;
  if (first) {
    dried_pl = 0;
    film_low_pl = film_high = beads_pl = 0u;
  }
  barrier();
  dryStrip(t);
  barrier();
  if (!first) return;
  states[t].dried_pl = dried_pl;
  states[t].film_low_pl = int(film_low_pl);
  states[t].film_high = int(film_high);
  states[t].beads_pl = beads_pl;
  tiles[t] = FilmTile(-1, 0, film_low_pl, film_high, 0, 0, dried_pl, beads_pl);  // the flow knows better where it comes
}
