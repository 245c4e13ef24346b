// What is to be seen on each cell, whether its tile is drawn as one piece, and how much of each list that takes. An invocation is a tile.
#include "optics/cells.glsl"

layout(local_size_x = 32) in;
layout(location = 1) uniform int film_reach;  // texels from which film is seen
layout(std430, binding = 1) readonly buffer Cells { uvec2 cells[]; };  // of look_cells.comp
layout(std430, binding = 2) writeonly buffer Tiles { SeenTile seen[]; };
layout(std430, binding = 5) readonly buffer Pieces { uint first_of_piece[]; };

const int kBeadReach = 1;  // texels from which a bead is seen, see bead.glsl
const uint kMostlyWet_16 = 11u;  // cells one by one are half as much work again: pixels are worked out in blocks, and those at their edges twice

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

void main() {
  int tile = int(gl_GlobalInvocationID.x);
  if (tile >= tiles.x * tiles.y) return;
  SeenTile seen_tile = SeenTile(uvec4(0u), 0u, 0u, kDry, 0u);
  uint all = kDry, wet = 0u, present = 0u;
  for (int c = 0; c < kCellsOfTile; ++c) {
    int cell = tile * kCellsOfTile + c;
    uint indices = indicesOf(piecesBefore() + cell);
    uint kind = indices != 0u ? kindOf(cellAt(cell)) : kDry;
    if (c < 8) seen_tile.cells_low |= kind << (4 * c);
    else seen_tile.cells_high |= kind << (4 * (c - 8));
    all |= kind;
    wet += kind != kDry ? 1u : 0u;
    present += indices != 0u ? 1u : 0u;
    if (kind != kDry) seen_tile.indices += inList(kind, indices);
  }
  if (wet > 0u && 16u * wet >= kMostlyWet_16 * present) {
    seen_tile.whole = all;
    seen_tile.indices = inList(all, indicesOf(tile));
  }
  seen[tile] = seen_tile;
}
