// A streak's cover of a pixel, and the light it puts there (rain_drawn.glsl).
#include "rain/streak.glsl"
#include "shared/rain_drawn.glsl"

layout(binding = 0) uniform sampler2D scene_depth;

layout(location = 0) noperspective in vec4 streak_seen;  // as of RainCorner
layout(location = 1) flat in vec4 streak_times;   // xy: of its ends, -1 .. 1 over the whole exposure; z: 1 / depth at its end, 1/m; w: half a pixel's
                                                  // width across it, px
layout(location = 2) flat in vec4 streak_colour;  // rgb: as the target holds it; a: cover where it is densest
layout(location = 0) out vec4 colour;

const float kSoft_m = 0.05;  // streaks end over this length at what they meet, so that no hard edge flickers

void main() {
  float depth_m = 1.0 / streak_seen.z;
  // Time passes evenly in the world, not on the picture.
  float time = mix(streak_times.x, streak_times.y, streak_seen.x * streak_times.z * depth_m);
  float cover = streak_colour.a * rainShutter(time) * rainWithin(streak_seen.y, streak_times.w, streak_seen.w);
  if (look.soft_depth != 0u) {
    float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r, look.depth_rows, look.zero_to_one);
    cover *= clamp((scene - depth_m) / kSoft_m, 0.0, 1.0);
  }
  cover = min(cover, 0.95);
  colour = vec4(streak_colour.rgb * cover, cover);
}
