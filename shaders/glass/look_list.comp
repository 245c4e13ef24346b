// Puts what is to be drawn of the mesh's pieces into the lists that look_sort.comp has laid out. An invocation is a cell, the first of a tile also
// the tile as a whole.
#include "optics/cells.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 2) readonly buffer Tiles { SeenTile seen[]; };
layout(std430, binding = 7) readonly buffer Indices { uint index[]; };
layout(std430, binding = 5) readonly buffer Pieces { uint first_of_piece[]; };
layout(std430, binding = 6) writeonly buffer Drawn { uint drawn[]; };

uint kindOf(SeenTile tile, int cell) { return ((cell < 8 ? tile.cells_low : tile.cells_high) >> (4 * (cell % 8))) & 15u; }

void copyPiece(int piece, uint to) {
  uint from = first_of_piece[piece], count = first_of_piece[piece + 1] - from;
  for (uint k = 0u; k < count; ++k) drawn[to + k] = index[from + k];
}

void main() {
  int k = int(gl_GlobalInvocationID.x), tile = k / kCellsOfTile, cell = k % kCellsOfTile;
  if (tile >= tiles.x * tiles.y) return;
  SeenTile t = seen[tile];
  if (t.whole != kDry) {
    if (cell == 0) copyPiece(tile, t.indices[listOf(t.whole)]);
    return;
  }
  uint kind = kindOf(t, cell);
  if (kind == kDry) return;
  int first_cell = tiles.x * tiles.y + tile * kCellsOfTile;
  uint to = t.indices[listOf(kind)];
  for (int c = 0; c < cell; ++c) {
    uint other = kindOf(t, c);
    if (other != kDry && listOf(other) == listOf(kind)) to += first_of_piece[first_cell + c + 1] - first_of_piece[first_cell + c];
  }
  copyPiece(first_cell + cell, to);
}
