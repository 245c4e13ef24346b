// A streak's cover of a pixel, and the light it puts there (rain_drawn.glsl). Defines, as software GL runs both sides of every branch: SOLIDS where
// flakes or stones may be among them, SOFT_DEPTH where the host's depth is read.
#include "rain/streak.glsl"
#include "shared/rain_drawn.glsl"

#ifdef SOFT_DEPTH
layout(binding = 0) uniform sampler2D scene_depth;
#endif

layout(location = 0) noperspective in vec4 streak_seen;  // as of RainCorner
layout(location = 1) flat in vec4 streak_times;   // xy: of its ends, -1 .. 1 over the whole exposure; z: 1 / depth at its end, 1/m; w: half a pixel's
                                                  // width across it, px (< 1), + rainSolidCode
layout(location = 2) flat in vec4 streak_colour;  // rgb: as the target holds it; a: cover where it is densest
layout(location = 0) out vec4 colour;

const float kSoft_m = 0.05;  // streaks end over this length at what they meet, so that no hard edge flickers

void main() {
  float depth_m = 1.0 / streak_seen.z;
  // Time passes evenly in the world, not on the picture.
  float time = mix(streak_times.x, streak_times.y, streak_seen.x * streak_times.z * depth_m);
  float pixel_half_px = fract(streak_times.w);
  float share = rainShutter(time) * rainWithin(streak_seen.y, pixel_half_px, streak_seen.w);
#ifdef SOLIDS
  if (streak_times.w > 1.0) {
    float per_length = length(vec2(dFdx(streak_seen.x), dFdy(streak_seen.x)));  // 1 / px: along the streak its first part goes from 0 to 1
    float squareness = clamp(2.0 * per_length / streak_seen.w, 1e-3, 1.0);
    share = rainSolid(share, 2.0 * streak_seen.x - 1.0, streak_seen.y * streak_seen.w, squareness, pixel_half_px, 1.0 / streak_seen.w,
                      uint(streak_times.w));
  }
#endif
  float cover = streak_colour.a * share;
#ifdef SOFT_DEPTH
  float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r, look.depth_rows, look.zero_to_one);
  cover *= clamp((scene - depth_m) / kSoft_m, 0.0, 1.0);
#endif
  cover = min(cover, 0.95);
  colour = vec4(streak_colour.rgb * cover, cover);
}
