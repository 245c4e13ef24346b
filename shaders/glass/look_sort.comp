// Lays out the lists of the mesh's pieces that are drawn: each tile's part of each; and tells what of each tile is looked at. One group does it
// all, so that a list's order is the same each time.
#include "optics/cells.glsl"

layout(local_size_x = 256) in;
layout(location = 1) uniform int look_reach;  // texels off a cell that are looked at from it
layout(std430, binding = 2) buffer Tiles { SeenTile seen[]; };
layout(std430, binding = 6) writeonly buffer Commands { uint commands[]; };  // DrawElementsIndirectCommand of each list

shared uvec4 sums[gl_WorkGroupSize.x];

bool drawn(ivec2 cell) {
  if (any(lessThan(cell, ivec2(0))) || any(greaterThanEqual(cell, tiles * kCellsAlong))) return false;
  ivec2 tile = cell / kCellsAlong, within = cell % kCellsAlong;
  int c = within.y * kCellsAlong + within.x, t = tile.y * tiles.x + tile.x;
  return (((c < 8 ? seen[t].cells_low : seen[t].cells_high) >> (4 * (c % 8))) & 15u) != kDry;
}

// From its own cells and those around it.
uint lookedAt(int tile) {
  ivec2 first = ivec2(kTileSize), end = ivec2(0);
  for (int y = -1; y <= kCellsAlong; ++y) {
    for (int x = -1; x <= kCellsAlong; ++x) {
      if (!drawn(tileAt(tile) * kCellsAlong + ivec2(x, y))) continue;
      first = min(first, max(ivec2(x, y) * kCellSize - look_reach, ivec2(0)));
      end = max(end, min(ivec2(x + 1, y + 1) * kCellSize + look_reach, ivec2(kTileSize)));
    }
  }
  first = min(first, end);  // of none: nothing
  return uint(first.x | (end.x << 8) | (first.y << 16) | (end.y << 24));
}

void main() {
  int k = int(gl_LocalInvocationIndex), groups = int(gl_WorkGroupSize.x);
  int each = (tiles.x * tiles.y + groups - 1) / groups;
  int from = k * each, to = min(from + each, tiles.x * tiles.y);
  uvec4 own = uvec4(0u);
  for (int tile = from; tile < to; ++tile) own += seen[tile].indices;
  sums[k] = own;
  barrier();
  for (int step = 1; step < groups; step *= 2) {  // to the sum of all up to it
    uvec4 before = k >= step ? sums[k - step] : uvec4(0u);
    barrier();
    sums[k] += before;
    barrier();
  }
  uvec4 total = sums[groups - 1];
  uvec4 first = uvec4(0u, total.x, total.x + total.y, total.x + total.y + total.z);
  uvec4 next = first + sums[k] - own;
  for (int tile = from; tile < to; ++tile) {
    uvec4 count = seen[tile].indices;
    seen[tile].indices = next;
    seen[tile].composed = lookedAt(tile);
    next += count;
  }
  if (k < kPieceLists) {
    commands[5 * k] = total[k];
    commands[5 * k + 1] = 1u;
    commands[5 * k + 2] = first[k];
    commands[5 * k + 3] = 0u;
    commands[5 * k + 4] = 0u;
  }
}
