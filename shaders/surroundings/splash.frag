// A crown's cover of a pixel, and the light it puts there. Defines: READ_DEPTH where the host's depth is read; else it is tested.
#include "rain/streak.glsl"
#include "shared/rain_drawn.glsl"
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "shared/splash.glsl"

#define FROM in
#include "surroundings/splash_told.glsl"
layout(location = 0) out vec4 colour;

#ifdef READ_DEPTH
layout(binding = 0) uniform sampler2D scene_depth;
const float kSoft_m = 0.05;  // splashes end over this length at what stands before them
#endif

void main() {
  vec2 up = splash_foot.zw, from_foot = gl_FragCoord.xy - splash_foot.xy;
  vec2 at = vec2(dot(from_foot, vec2(up.y, -up.x)), dot(from_foot, up));
  vec2 blue_times = unpackHalf2x16(splash_look.y);
  float phase = uintBitsToFloat(splash_look.w);
  float cover = blue_times.y * splashCover(at, rainPixelHalf(up), splash_size.x, splash_size.y, splash_size.z, splash_size.w, phase);
#ifdef READ_DEPTH
  float depth_m = uintBitsToFloat(splash_look.z);
  float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r, look.depth_rows, look.zero_to_one);
  cover *= clamp((scene - depth_m) / kSoft_m + 1.0, 0.0, 1.0);
#endif
  cover = min(cover, 0.95);
  colour = vec4(vec3(unpackHalf2x16(splash_look.x), blue_times.x) * cover, cover);
}
