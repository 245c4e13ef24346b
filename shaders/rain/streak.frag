// A streak's cover of a pixel, and the light it puts there (rain_drawn.glsl).
#include "rain/streak.glsl"
#include "shared/rain_drawn.glsl"

layout(binding = 0) uniform sampler2D scene_depth;

layout(location = 0) flat in vec4 streak_line;    // xy: where it begins, window px; zw: its direction there
layout(location = 1) flat in vec4 streak_depths;  // x: 1 / its length, 1/px; yz: 1 / depth at its ends, 1/m; w: half a pixel's width across it, px
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
  float cover = streak_colour.a * rainShutter(time) * rainWithin(across_px, streak_depths.w, mix(streak_ends.z, streak_ends.w, at));
  if (look.soft_depth != 0u) {
    float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r, look.depth_rows, look.zero_to_one);
    cover *= clamp((scene - depth_m) / kSoft_m, 0.0, 1.0);
  }
  cover = min(cover, 0.95);
  colour = vec4(streak_colour.rgb * cover, cover);
}
