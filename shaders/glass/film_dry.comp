// Tiles whose turn it is dry, and film on them breaks up: invocations walk up a column of strips each. After the flow, as it left the film; those
// asleep stay so, and nothing brings one copy of their film to the other, so both are written. Apart from the flow, as software GL runs through branches
// that nobody takes.
#include "glass/film_lists.glsl"
layout(local_size_x = kGroup) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // the film's buffer below
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles (PaneMap::nodeMetric)
layout(rgba32ui, binding = 3) readonly uniform uimageBuffer lying; // the beads' buffer below
layout(std430, binding = 3) writeonly buffer Film { ivec4 film[]; };
layout(std430, binding = 7) writeonly buffer Other { ivec4 other[]; };
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };
layout(std430, binding = 4) readonly buffer Awake {
  AwakeTiles awake[2], drying[2];
  int listed[];
};
layout(std430, binding = 6) writeonly buffer Lying { uvec4 beads[]; };

// What is left on a tile, and what has dried of it.
struct Left { int dried_pl; uint film_low_pl, film_high, beads_pl; };
shared Left left_on[kTilesInDryGroup];

Left dryStrips(int tile, int column, bool asleep) {
  ivec2 corner = ivec2(tile % tilesAcross(), tile / tilesAcross());
  int low = corner.y * (tilesAcross() + 1) + corner.x, high = low + tilesAcross() + 1;
  vec4 m[4] = vec4[4](imageLoad(metric, low), imageLoad(metric, low + 1), imageLoad(metric, high), imageLoad(metric, high + 1));
  Left sums = Left(0, 0u, 0u, 0u);
  int row = 0;
  do {
    int strip = stripAt(corner.x * kTileSize, corner.y * kTileSize + row) + column;
    int texel = (corner.y * kTileSize + row) * info.columns + corner.x * kTileSize + column * kStripSize;
    ivec4 was = imageLoad(before, strip);
    uvec4 had = imageLoad(lying, strip);
    vec4 here = betweenNodes(m[0], m[1], m[2], m[3], vec2(placeAcross(column * kStripSize), placeUp(row)));
    int film_pl[kStripSize];
    uint has[kStripSize];
    for (int k = 0; k < kStripSize; ++k) {
      FilmTexel left = dried(was[k], beadsOf(had[k]), uint(texel + k), here, info);
      sums.dried_pl += left.gone_pl;
      uint whole = uint(max(left.film_pl, 0));
      sums.film_low_pl += whole & 0xffffu;
      sums.film_high += whole >> 16u;
      sums.beads_pl += uint(left.beads.volume_pl);
      film_pl[k] = left.film_pl;
      has[k] = packedBeads(left.beads);
    }
    ivec4 is = ivec4(film_pl[0], film_pl[1], film_pl[2], film_pl[3]);
    uvec4 lie = uvec4(has[0], has[1], has[2], has[3]);
    film[strip] = is;
    if (asleep) other[strip] = is;
    if (lie != had) beads[strip] = lie;
  } while (++row < kTileSize);
  return sums;
}

void main() {
  int tile_in_group = int(gl_LocalInvocationIndex) / kStrips, column = int(gl_LocalInvocationIndex) % kStrips;
  uint place = groupInRows() * uint(kTilesInDryGroup) + uint(tile_in_group);
  bool here = place < drying[turn].number;
  int entry = here ? listed[uint(count) + place] : 0, t = max(entry, -1 - entry);
  if (column == 0) left_on[tile_in_group] = Left(0, 0u, 0u, 0u);
  barrier();
  if (here) {
    Left sums = dryStrips(t, column, entry < 0);
    atomicAdd(left_on[tile_in_group].dried_pl, sums.dried_pl);
    atomicAdd(left_on[tile_in_group].film_low_pl, sums.film_low_pl);
    atomicAdd(left_on[tile_in_group].film_high, sums.film_high);
    atomicAdd(left_on[tile_in_group].beads_pl, sums.beads_pl);
  }
  barrier();
  if (!here || column != 0) return;
  Left left = left_on[tile_in_group];
  states[t].lies = int[3](int(left.film_low_pl), int(left.film_high), int(left.beads_pl));
  tiles[t].film_low_pl = left.film_low_pl;
  tiles[t].film_high = left.film_high;
  tiles[t].evaporated_pl = left.dried_pl;
  tiles[t].beads_pl = left.beads_pl;
}
