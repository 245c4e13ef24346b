// Which texels of each cell hold water that is seen, and whether a ridge may stand on it. An invocation is a cell.
#include "optics/cells.glsl"
#include "optics/look_frame.glsl"
#ifdef RIDGES
#include "optics/ridge.glsl"
#endif

layout(local_size_x = 64) in;
layout(std430, binding = 1) writeonly buffer Cells { uvec2 cells[]; };  // x: sixteen bits film, sixteen beads; y: 1: ridge
layout(binding = 2) uniform isampler2D film;
layout(binding = 5) uniform usampler2D beads;
layout(binding = 4) uniform sampler2D pane_metric;
layout(binding = 6) uniform sampler2D pane_position;

// A cell's texels are as large as each other to a hundredth.
int thinnestSeen(ivec2 first, ivec2 last) {
  float area_m2 = max(max(texelFetch(pane_metric, min(first, last), 0).w, texelFetch(pane_metric, min(first + kCellSize - 1, last), 0).w), 1e-12);
  return int(0.99 * kDry_um * 1e-6 * area_m2 / frame.film_unit_m3);
}

#ifdef RIDGES
bool nearBlade(ivec2 first, ivec2 last) {
  vec3 corner = texelFetch(pane_position, min(first, last), 0).xyz;
  vec3 opposite = texelFetch(pane_position, min(first + kCellSize, last), 0).xyz;
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
#else
bool nearBlade(ivec2 first, ivec2 last) { return false; }
#endif

void main() {
  int cell = int(gl_GlobalInvocationID.x);
  if (cell >= tiles.x * tiles.y * kCellsOfTile) return;
  ivec2 first = cellAt(cell) * kCellSize, last = textureSize(pane_metric, 0) - 1;
  int thinnest = thinnestSeen(first, last);
  // A pane may have none of both: its maps have a single, dry texel then.
  ivec2 last_film = textureSize(film, 0) - 1, last_beads = textureSize(beads, 0) - 1;
  uint wet = 0u;
  for (int k = 0; k < kCellSize * kCellSize; ++k) {
    ivec2 texel = first + ivec2(k % kCellSize, k / kCellSize);
    if (texelFetch(film, min(texel, last_film), 0).r > thinnest) wet |= 1u << k;
    if (texelFetch(beads, min(texel, last_beads), 0).r != 0u) wet |= 0x10000u << k;
  }
  cells[cell] = uvec2(wet, nearBlade(first, last) ? 1u : 0u);
}
