// A streak's cover of a pixel, and the light it puts there (Garg & Nayar 2007: background (1 - tau/T) + drop tau/T).
#include "rain/streak.glsl"

layout(binding = 0) uniform sampler2D scene_depth;

layout(location = 0) in vec3 streak_at;
layout(location = 1) flat in vec4 streak_colour;
layout(location = 2) flat in vec3 streak_shape;
layout(location = 0) out vec4 colour;

const float kSoft_m = 0.05;  // streaks end over this length at what they meet, so that no hard edge flickers

void main() {
  int is_of = int(streak_shape.x);
  float shape = is_of == kRainIsRain ? rainAlong(streak_at.x) * rainAcross(streak_at.y)
                                     : rainSolid(streak_at.x, streak_at.y, streak_shape.y, is_of < kRainIsHail, streak_shape.z);
  float cover = streak_colour.a * shape;
  if (look.soft_depth != 0u) {
    float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r, look.depth_rows, look.zero_to_one);
    cover *= clamp((scene - streak_at.z) / kSoft_m, 0.0, 1.0);
  }
  cover = min(cover, 0.95);
  colour = vec4(streak_colour.rgb * cover, cover);
}
