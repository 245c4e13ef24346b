// What light arrives from a direction: the captured or given environment where there is one, else the visible picture where the direction
// lies in it, else a sky over a ground. Radiance times the target's exposure.
#ifndef RG_OPTICS_SURROUNDINGS_GLSL
#define RG_OPTICS_SURROUNDINGS_GLSL
#include "optics/look_frame.glsl"

layout(binding = 0) uniform sampler2D picture;        // what the target showed, as it was there, with mips
layout(binding = 1) uniform samplerCube environment;  // linear radiance, world axes, with mips

// The target's values, where they are encoded (IEC 61966-2-1). A variant, not a branch: software GL runs both sides of one.
#ifdef ENCODED
vec3 encode(vec3 radiance) {
  vec3 x = clamp(radiance, 0.0, 1.0);
  return mix(12.92 * x, 1.055 * pow(x, vec3(1.0 / 2.4)) - 0.055, greaterThan(x, vec3(0.0031308)));
}
vec3 decode(vec3 value) { return mix(value / 12.92, pow((value + 0.055) / 1.055, vec3(2.4)), greaterThan(value, vec3(0.04045))); }
#else
// On its way through half floats, to be blurred, a lamp must not become infinite.
const float kBrightestApart = 6.0e4;
vec3 encode(vec3 radiance) { return frame.pupil_m > 0.0 ? min(radiance, kBrightestApart) : radiance; }
vec3 decode(vec3 value) { return value; }
#endif

// Sky to ground over a horizon as soft as a rainy day's.
vec3 skyAndGround(float up) { return frame.exposure * mix(frame.ground_radiance.rgb, frame.sky_radiance.rgb, smoothstep(-0.15, 0.25, up)); }

// Where a direction (eye frame) lies in the picture, 0 .. 1; z: how far inside, 0 at its border and beyond.
vec3 pictureAt(vec3 direction_eye) {
  vec4 clip = frame.clip_from_eye * vec4(direction_eye, 0.0);
  vec2 ndc = clip.xy / max(clip.w, 1e-6);
  vec2 away = 1.0 - abs(ndc);
  float inside = clip.w > 1e-6 ? smoothstep(0.0, 0.15, min(away.x, away.y)) : 0.0;
  return vec3(clamp(ndc * 0.5 + 0.5, 0.0, 1.0), inside);
}

// `spread_rad`: angle between what neighbouring pixels see, for the choice of mips.
vec3 surroundings(vec3 direction_world, float spread_rad) {
#ifdef ENVIRONMENT
  float lod = log2(max(spread_rad * frame.environment_texels_per_rad, 1e-6));
  return frame.exposure * textureLod(environment, direction_world, lod).rgb;
#else
  vec3 far = skyAndGround(direction_world.z);
  vec3 at = pictureAt(mat3(frame.eye_from_world) * direction_world);
  float lod = log2(max(spread_rad * frame.pixels_per_rad, 1e-6));
  return mix(far, decode(textureLod(picture, at.xy, lod).rgb), at.z);
#endif
}

// Light from the cabin's side of the glass is as much darker as the cabin is. The cabin begins behind the glass's plane.
float behindGlassShare(vec3 direction_world, vec3 outward) {
  return mix(frame.cabin_share, 1.0, smoothstep(-0.02, 0.02, dot(direction_world, outward)));
}

vec3 surroundingsOfGlass(vec3 direction_world, vec3 outward, float spread_rad) {
  return behindGlassShare(direction_world, outward) * surroundings(direction_world, spread_rad);
}

#endif
