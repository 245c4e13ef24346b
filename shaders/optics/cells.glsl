// The cells of a pane's grid: tile by tile, sixteen each (shared/glass_tile.glsl).
#ifndef RG_OPTICS_CELLS_GLSL
#define RG_OPTICS_CELLS_GLSL
#include "shared/glass_tile.glsl"

layout(location = 0) uniform ivec2 tiles;  // of the grid

ivec2 tileAt(int tile) { return ivec2(tile % tiles.x, tile / tiles.x); }

// Cells from the grid's corner on.
ivec2 cellAt(int cell) {
  int within = cell % kCellsOfTile;
  return tileAt(cell / kCellsOfTile) * kCellsAlong + ivec2(within % kCellsAlong, within / kCellsAlong);
}

int cellOf(ivec2 at) {
  ivec2 tile = at / kCellsAlong, within = at % kCellsAlong;
  return (tile.y * tiles.x + tile.x) * kCellsOfTile + within.y * kCellsAlong + within.x;
}

#endif
