// The square of a tile in the grid's pictures, of those whose water is looked at from a cell that is drawn.
#include "optics/cells.glsl"

layout(location = 2) uniform ivec2 texels;  // of the grid
layout(std430, binding = 2) readonly buffer Tiles { SeenTile seen[]; };

bool drawn(ivec2 at, ivec2 step) {
  ivec2 other = at + step;
  if (any(lessThan(other, ivec2(0))) || any(greaterThanEqual(other, tiles))) return false;
  SeenTile t = seen[other.y * tiles.x + other.x];
  uint columns = step.x == 0 ? ~0u : step.x > 0 ? 0x000f000fu : 0xf000f000u;  // of the neighbour's cells those beside this tile
  uint low = step.y == 0 ? ~0u : step.y > 0 ? 0x0000ffffu : 0u;
  uint high = step.y == 0 ? ~0u : step.y > 0 ? 0u : 0xffff0000u;
  return (((t.cells_low & low) | (t.cells_high & high)) & columns) != 0u;
}

void main() {
  ivec2 at = tileAt(gl_VertexID / 6);
#ifdef EVERYWHERE
  bool seen_from = true;
#else
  bool seen_from = false;
  for (int k = 0; k < 9; ++k) seen_from = seen_from || drawn(at, ivec2(k % 3, k / 3) - 1);
#endif
  int corner = gl_VertexID % 6 < 3 ? gl_VertexID % 6 : 6 - gl_VertexID % 6;
  vec2 texel = vec2(min((at + ivec2(corner & 1, corner >> 1)) * kTileSize, texels));
  gl_Position = seen_from ? vec4(texel / vec2(texels) * 2.0 - 1.0, 0.0, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
}
