// What is to be seen of a pane's grid, cell by cell: glass/look_cells.comp and its followers tell, glass/look_gl.cpp draws each kind by a program of
// its own.
#ifndef RG_SHARED_GLASS_TILE_GLSL
#define RG_SHARED_GLASS_TILE_GLSL
#include "shared/compat.glsl"
#include "shared/glass_types.glsl"
RG_SHARED_BEGIN

RG_CONST int kCellSize = 4; // texels along a cell's side
RG_CONST int kCellsAlong = kTileSize / kCellSize;
RG_CONST int kCellsOfTile = kCellsAlong * kCellsAlong; // row by row

// Bits. What has a ridge may have all.
RG_CONST uint kDry = 0u;
RG_CONST uint kFilm = 1u;
RG_CONST uint kBeads = 2u;
RG_CONST uint kRidge = 4u;

// The lists in which the pieces of a pane's mesh are drawn.
RG_CONST int kPieceLists = 4;
RG_CONST int kRidgeList = 3;
RG_FN int listOf(uint kind) { return (kind & kRidge) != 0u ? kRidgeList : int(kind) - 1; }

// A tile as it is to be drawn: as one piece, or its cells each for itself.
struct SeenTile {
  uvec4 indices;    // how many it has in each list; laid out, its first there
  uint cells_low;   // kinds of its cells, four bits each
  uint cells_high;
  uint whole;       // kind of all of it, else kDry
  uint composed;    // the rectangle of its texels that is looked at: first, last + 1 along u, along v, a byte each
};
RG_SIZE(SeenTile, 32)

RG_CONST float kDry_um = 0.15f; // what a wiper leaves counts as clean

RG_SHARED_END
#endif
