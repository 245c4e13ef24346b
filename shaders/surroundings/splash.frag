// A splash's cover of a pixel, and the light it puts there. Defines: READ_DEPTH where the host's depth is read; else it is tested.
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
  vec2 up = unpackHalf2x16(floatBitsToUint(splash_foot.z)), from_foot = gl_FragCoord.xy - splash_foot.xy;
  vec2 at = vec2(dot(from_foot, vec2(up.y, -up.x)), dot(from_foot, up));
  vec2 blue_sine = unpackHalf2x16(splash_look.y), wall_seed = unpackHalf2x16(splash_look.z);
  SplashDrawn drawn = SplashDrawn(splash_size.x, blue_sine.y, splash_size.y, wall_seed.x, splash_size.z, splash_size.w, uintBitsToFloat(splash_look.w));
  float cover = splashCover(at, rainPixelHalf(up), drawn) * splashSpeck(vec2(up.y < 0.0 ? -at.x : at.x, at.y), drawn, wall_seed.y);
#ifdef READ_DEPTH
  float scene = rainSceneDepth(texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r, look.depth_rows, look.zero_to_one);
  cover *= clamp((scene - splash_foot.w) / kSoft_m + 1.0, 0.0, 1.0);
#endif
  cover = min(cover, 0.95);
  colour = vec4(vec3(unpackHalf2x16(splash_look.x), blue_sine.x) * cover, cover);
}
