// Tells the tiles of a pane apart by what is to be seen on them, so that none costs more than that. A group is a tile.
#include "optics/look_frame.glsl"
#include "optics/ridge.glsl"
#include "shared/glass_tile.glsl"
#include "shared/glass_types.glsl"

layout(local_size_x = 32) in;
layout(std430, binding = 1) writeonly buffer Tiles { uint kinds[]; };
layout(binding = 2) uniform sampler2D film;   // of look_film.frag
layout(binding = 3) uniform sampler2D beads;  // of look_beads.frag
layout(binding = 4) uniform sampler2D pane_position;

const int kAround = 2;  // texels beyond its edge that a pixel of the tile looks up, see bicubic.glsl
const int kLooked = kTileSize + 2 * kAround;

shared uint kind;

uint kindOf(ivec2 texel) {
  // A pane may have none of both: its maps have a single texel then.
  float film_um = texelFetch(film, clamp(texel, ivec2(0), textureSize(film, 0) - 1), 0).w;
  vec4 lying = texelFetch(beads, clamp(texel, ivec2(0), textureSize(beads, 0) - 1), 0);
  return lying.x >= 1.0 || lying.w > 0.0 ? kBeadTile : film_um > kDry_um ? kFilmTile : kDryTile;
}

// Whether a ridge may stand on it.
bool nearBlade(ivec2 first) {
  ivec2 last = textureSize(pane_position, 0) - 1;
  vec3 corner = texelFetch(pane_position, min(first, last), 0).xyz;
  vec3 opposite = texelFetch(pane_position, min(first + kTileSize, last), 0).xyz;
  vec3 middle = 0.5 * (corner + opposite);
  float reach_m = distance(corner, opposite);
  bool near = false;
  for (int k = 0; k < frame.blade_count; ++k) {
    vec3 d = middle - frame.blades[k].middle_length.xyz;
    float x = dot(d, frame.blades[k].ahead.xyz), s = dot(d, frame.blades[k].along_first.xyz);
    near = near || (x > -reach_m && x < kBroadest_m + reach_m && abs(s) < 0.5 * frame.blades[k].middle_length.w + reach_m);
  }
  return near;
}

void main() {
  ivec2 first = ivec2(gl_WorkGroupID.xy) * kTileSize;
  if (gl_LocalInvocationIndex == 0u) kind = nearBlade(first) ? kFilmTile : kDryTile;
  barrier();
  uint seen = kDryTile;
  for (int k = int(gl_LocalInvocationIndex); k < kLooked * kLooked; k += 32)
    seen = max(seen, kindOf(first - kAround + ivec2(k % kLooked, k / kLooked)));
  atomicMax(kind, seen);
  barrier();
  if (gl_LocalInvocationIndex == 0u) kinds[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = kind;
}
