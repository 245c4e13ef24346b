// How far off the scene is at most in each tile, so that tiles need not be drawn where it ends inside the volume that the eye is in: a cabin's
// inside fills half of a driver's picture.
#include "shared/rain_beyond.glsl"
#include "rain/streak.glsl"
layout(local_size_x = 64) in;  // each a row of a tile
layout(std140, binding = 0) uniform BeyondBlock { RainBeyond beyond; };
layout(std430, binding = 0) buffer Tiles { RainTile tiles[]; };
layout(binding = 0) uniform sampler2D scene_depth;
layout(location = 0) uniform uint count;

void main() {
  uint side = uint(beyond.scroll.w), tile = gl_GlobalInvocationID.x / side, row = gl_GlobalInvocationID.x % side;
  if (tile >= count) return;
  uvec2 corner = uvec2(tiles[tile].place & 0xffffu, tiles[tile].place >> 16u) * side;
  uvec2 size = uvec2(look.viewport.zw);
  if (corner.y + row >= size.y) return;
  ivec2 from = ivec2(look.viewport.xy) + ivec2(corner.x, corner.y + row);
  ivec2 last = textureSize(scene_depth, 0) - 1;
  uint columns = min(side, size.x - corner.x);
  bool reversed = look.depth_rows.y > 0.0;
  float farthest = reversed ? 1.0 : 0.0;  // as stored
  for (uint i = 0u; i < columns; ++i) {
    float stored = texelFetch(scene_depth, clamp(from + ivec2(i, 0), ivec2(0), last), 0).r;
    farthest = reversed ? min(farthest, stored) : max(farthest, stored);
  }
  atomicMax(tiles[tile].farthest, floatBitsToUint(rainSceneDepth(farthest, look.depth_rows, look.zero_to_one)));
}
