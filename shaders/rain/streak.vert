// A corner of a streak's rectangle, in the picture's plane: the fragments tell along and across, depth and time by themselves. (One triangle
// about it would spare the rasteriser the other, but its empty parts cost software GL twice what it saves.)
#include "rain/streak.glsl"
#include "shared/rain_drawn.glsl"

layout(std430, binding = 1) readonly buffer Drawn { RainDrawn drawn[]; };

layout(location = 0) flat out vec4 streak_line;    // xy: where it begins, window px; zw: its direction there
layout(location = 1) flat out vec4 streak_depths;  // x: 1 / its length, 1/px; yz: 1 / depth at its ends, 1/m; w: half a pixel's width across it, px
layout(location = 2) flat out vec4 streak_ends;    // of its ends: xy: times, -1 .. 1 over the whole exposure; zw: 1 / radius, 1/px
layout(location = 3) flat out vec4 streak_colour;  // rgb: as the target holds it; a: cover where it is densest

// Where the streak begins and ends: for transform feedback; no stage takes them, so that the linker leaves them out else.
out vec4 segment_px;
out vec2 segment_depth_m;
flat out uint segment_slot;

const float kDot_px = 1e-2;  // shorter ways have no direction

void main() {
  RainDrawn d = drawn[uint(gl_VertexID) / 4u];
  uint corner = uint(gl_VertexID) % 4u;
  vec2 way = d.ends_px.zw - d.ends_px.xy;
  float way_px = length(way);
  vec2 along = way_px > kDot_px ? way / way_px : vec2(0.0, 1.0);
  vec2 across = vec2(-along.y, along.x);
  vec2 depths_m = d.depths_times.xy, times = d.depths_times.zw;
  vec2 radii_px = vec2(rainSoftened(d.radius_px_m / depths_m.x), rainSoftened(d.radius_px_m / depths_m.y));
  float middle_px = d.radius_px_m * inversesqrt(depths_m.x * depths_m.y);  // as a drop's pace on the picture goes with the depths' product
  float pixel_half_px = rainPixelHalf(along);
  float length_px = rainLength(way_px, middle_px), longer_px = 0.5 * (length_px - way_px);
  float side_px = max(radii_px.x, radii_px.y) + pixel_half_px;
  float at_px = (corner & 1u) != 0u ? way_px + longer_px : -longer_px;
  vec2 p = d.ends_px.xy + along * at_px + across * ((corner & 2u) != 0u ? side_px : -side_px);
  float depth_m = (corner & 1u) != 0u ? depths_m.y : depths_m.x;
  gl_Position = vec4(p * 2.0 / look.viewport.zw, rainStoredDepth(depth_m, look.depth_rows), 1.0);
  streak_line = vec4(d.ends_px.xy - along * longer_px + look.viewport.xy + 0.5 * look.viewport.zw, along);
  streak_depths = vec4(1.0 / length_px, 1.0 / depths_m, pixel_half_px);
  streak_ends = vec4(times, 1.0 / radii_px);
  streak_colour = vec4(d.colour.rgb, d.colour.a * rainDwell(middle_px, times.y - times.x, length_px, pixel_half_px));
  segment_px = d.ends_px;
  segment_depth_m = depths_m;
  segment_slot = d.slot;
}
