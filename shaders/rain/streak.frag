// A streak's cover of a pixel, and the light it puts there (rain_drawn.glsl). Defines, as software GL runs both sides of every branch: SOLIDS where
// flakes or stones may be among them, SOFT_DEPTH where the host's depth is read.
#include "rain/streak.glsl"
#include "shared/rain_drawn.glsl"

#ifdef SOFT_DEPTH
layout(binding = 0) uniform sampler2D scene_depth;
#endif

#define FROM in
#include "rain/streak_told.glsl"
layout(location = 0) out vec4 colour;

const float kSoft_m = 0.05;  // streaks end over this length at what they meet, so that no hard edge flickers

vec3 unpackedLight(uint light) {
  float step = uintBitsToFloat((light >> 27u) + 103u << 23u);
  return vec3(light & 511u, light >> 9u & 511u, light >> 18u & 511u) * step;
}

void main() {
  vec2 at_px = gl_FragCoord.xy;
  float along = dot(at_px, streak_line.xy) + streak_line.z, length_px = inversesqrt(dot(streak_line.xy, streak_line.xy));
  vec2 direction = streak_line.xy * length_px;
  float across_px = at_px.y * direction.x - at_px.x * direction.y + streak_line.w;
  vec2 times = unpackHalf2x16(streak_look.y), nearer_cover = unpackHalf2x16(streak_look.z), per_radii = unpackHalf2x16(streak_look.w);
  float deeper = 1.0 + nearer_cover.x * along;  // the depth where it begins by that here
  float time = (times.x + times.y * along) / deeper;
  float per_radius = mix(per_radii.x, per_radii.y, along);
  float pixel_half_px = rainPixelHalf(direction);
  float share = rainShutter(time) * rainWithin(across_px, pixel_half_px, per_radius);
#ifdef SOLIDS
  if (streak_solid > 0.0) {
    float squareness = clamp(2.0 / (length_px * per_radius), 1e-3, 1.0);
    share = rainSolid(share, 2.0 * along - 1.0, across_px * per_radius, squareness, pixel_half_px, 1.0 / per_radius, uint(streak_solid));
  }
#endif
  float cover = nearer_cover.y * nearer_cover.y * share;
#ifdef SOFT_DEPTH
  float depth_m = 1.0 / (streak_per_depth * deeper);
  float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(at_px), 0).r, look.depth_rows, look.zero_to_one);
  cover *= clamp((scene - depth_m) / kSoft_m, 0.0, 1.0);
#endif
  cover = min(cover, 0.95);
  colour = vec4(unpackedLight(streak_look.x) * cover, cover);
}
