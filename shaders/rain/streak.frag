// A streak's cover of a pixel, and the light it puts there (rain_drawn.glsl).
#include "rain/streak.glsl"
#include "shared/rain_drawn.glsl"

layout(binding = 0) uniform sampler2D scene_depth;

layout(location = 0) flat in vec4 streak_line;    // xy: where it begins, window px; zw: its direction there
layout(location = 1) flat in vec4 streak_depths;  // x: 1 / its length, 1/px; yz: 1 / depth at its ends, 1/m; w: half a pixel's width across it, px (< 1), + rainSolidCode
layout(location = 2) flat in vec4 streak_ends;    // of its ends: xy: times, -1 .. 1 over the whole exposure; zw: 1 / radius, 1/px
layout(location = 3) flat in vec4 streak_colour;  // rgb: as the target holds it; a: cover where it is densest
layout(location = 0) out vec4 colour;

const float kSoft_m = 0.05;  // streaks end over this length at what they meet, so that no hard edge flickers

void main() {
  vec2 p = gl_FragCoord.xy - streak_line.xy;
  float at = dot(p, streak_line.zw) * streak_depths.x;
  float across_px = streak_line.z * p.y - streak_line.w * p.x;
  float depth_m = 1.0 / mix(streak_depths.y, streak_depths.z, at);
  // Time passes evenly in the world, not on the picture.
  float time = mix(streak_ends.x, streak_ends.y, at * streak_depths.z * depth_m);
  float per_radius = mix(streak_ends.z, streak_ends.w, at), pixel_half_px = fract(streak_depths.w);
  float share = rainShutter(time) * rainWithin(across_px, pixel_half_px, per_radius);
  if (streak_depths.w > 1.0) {
    float squareness = min(2.0 * streak_depths.x / per_radius, 1.0);
    share = rainSolid(share, 2.0 * at - 1.0, across_px * per_radius, squareness, pixel_half_px, 1.0 / per_radius, uint(streak_depths.w));
  }
  float cover = streak_colour.a * share;
  if (look.soft_depth != 0u) {
    float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r, look.depth_rows, look.zero_to_one);
    cover *= clamp((scene - depth_m) / kSoft_m, 0.0, 1.0);
  }
  cover = min(cover, 0.95);
  colour = vec4(streak_colour.rgb * cover, cover);
}
