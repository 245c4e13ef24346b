// What is to be seen of a tile of the film's grid.
#ifndef RG_OPTICS_TILE_GLSL
#define RG_OPTICS_TILE_GLSL
const uint kDryTile = 0u, kFilmTile = 1u, kBeadTile = 2u;  // a bead's tile may have film too

const float kDry_um = 0.15;  // what a wiper leaves counts as clean
#endif
