// What is to be seen on each cell, from which the lists of the mesh's pieces are laid out: each tile's part of each. One group does it all, so
// that a list's order is the same each time.
#include "optics/cells.glsl"

layout(local_size_x = 256) in;
layout(location = 1) uniform int film_reach;  // texels from which film is seen
layout(std430, binding = 1) readonly buffer Cells { uvec2 cells[]; };  // of look_cells.comp
layout(std430, binding = 2) writeonly buffer Tiles { SeenTile seen[]; };
layout(std430, binding = 5) readonly buffer Pieces { uint first_of_piece[]; };
layout(std430, binding = 6) writeonly buffer Commands { uint commands[]; };  // DrawElementsIndirectCommand of each list

const int kBeadReach = 1;  // texels from which a bead is seen, see bead.glsl
const uint kMostlyWet_16 = 11u;  // cells one by one are half as much work again: pixels are worked out in blocks, and those at their edges twice

shared uvec4 sums[gl_WorkGroupSize.x];

int piecesBefore() { return tiles.x * tiles.y; }
uint indicesOf(int piece) { return first_of_piece[piece + 1] - first_of_piece[piece]; }

// Of a cell's sixteen texels those within `reach` of the cell that lies at -step.
uint sideTowards(ivec2 step, int reach) {
  uint columns = 0x1111u * (step.x == 0 ? 0xfu : step.x > 0 ? 0xfu >> (kCellSize - reach) : (0xfu << (kCellSize - reach)) & 0xfu);
  uint rows = step.y == 0 ? 0xffffu : step.y > 0 ? 0xffffu >> (kCellSize * (kCellSize - reach)) : (0xffffu << (kCellSize * (kCellSize - reach))) & 0xffffu;
  return columns & rows;
}

uint kindOf(ivec2 at) {
  uint kind = cells[cellOf(at)].y != 0u ? kRidge : kDry;
  for (int k = 0; k < 9; ++k) {
    ivec2 step = ivec2(k % 3, k / 3) - 1;
    ivec2 other = at + step;
    if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, tiles * kCellsAlong))) continue;
    uint wet = cells[cellOf(other)].x;
    if ((wet & sideTowards(step, film_reach)) != 0u) kind |= kFilm;
    if (((wet >> 16) & sideTowards(step, kBeadReach)) != 0u) kind |= kBeads;
  }
  return kind;
}

uvec4 inList(uint kind, uint indices) {
  int list = listOf(kind);
  return uvec4(list == 0 ? indices : 0u, list == 1 ? indices : 0u, list == 2 ? indices : 0u, list == 3 ? indices : 0u);
}

// Fills in what is to be drawn; returns how many indices go to each list.
uvec4 sorted(int tile, out SeenTile seen_tile) {
  seen_tile = SeenTile(uvec4(0u), 0u, 0u, kDry, 0u);
  uint all = kDry, wet = 0u, present = 0u;
  uvec4 count = uvec4(0u);
  for (int c = 0; c < kCellsOfTile; ++c) {
    int cell = tile * kCellsOfTile + c;
    uint indices = indicesOf(piecesBefore() + cell);
    uint kind = kindOf(cellAt(cell));
    if (indices == 0u) kind = kDry;
    if (c < 8) seen_tile.cells_low |= kind << (4 * c);
    else seen_tile.cells_high |= kind << (4 * (c - 8));
    all |= kind;
    wet += kind != kDry ? 1u : 0u;
    present += indices != 0u ? 1u : 0u;
    if (kind != kDry) count += inList(kind, indices);
  }
  if (wet > 0u && 16u * wet >= kMostlyWet_16 * present) {
    seen_tile.whole = all;
    count = inList(all, indicesOf(tile));
  }
  return count;
}

void main() {
  int k = int(gl_LocalInvocationIndex), groups = int(gl_WorkGroupSize.x);
  int each = (tiles.x * tiles.y + groups - 1) / groups;
  int from = k * each, to = min(from + each, tiles.x * tiles.y);
  SeenTile seen_tile;
  uvec4 own = uvec4(0u);
  for (int tile = from; tile < to; ++tile) own += sorted(tile, seen_tile);
  sums[k] = own;
  barrier();
  for (int step = 1; step < groups; step *= 2) {  // to the sum of all up to it
    uvec4 before = k >= step ? sums[k - step] : uvec4(0u);
    barrier();
    sums[k] += before;
    barrier();
  }
  uvec4 total = sums[groups - 1];
  uvec4 list = uvec4(0u, total.x, total.x + total.y, total.x + total.y + total.z);
  uvec4 next = list + sums[k] - own;
  for (int tile = from; tile < to; ++tile) {
    uvec4 count = sorted(tile, seen_tile);
    seen_tile.first_index = next;
    seen[tile] = seen_tile;
    next += count;
  }
  if (k < kPieceLists) {
    commands[5 * k] = total[k];
    commands[5 * k + 1] = 1u;
    commands[5 * k + 2] = list[k];
    commands[5 * k + 3] = 0u;
    commands[5 * k + 4] = 0u;
  }
}
