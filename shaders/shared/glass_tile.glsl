// What is to be seen of a tile of the film's grid: shaders/glass/look_tiles.comp tells, glass/look_gl.cpp draws each kind by a program of its own.
#ifndef RG_SHARED_GLASS_TILE_GLSL
#define RG_SHARED_GLASS_TILE_GLSL
#include "shared/compat.glsl"
RG_SHARED_BEGIN

RG_CONST uint kDryTile = 0u;
RG_CONST uint kFilmTile = 1u;
RG_CONST uint kBeadTile = 2u; // it may have film too

RG_CONST float kDry_um = 0.15f; // what a wiper leaves counts as clean

RG_SHARED_END
#endif
