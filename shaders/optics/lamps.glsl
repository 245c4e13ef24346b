// Lamps as drops show them: so small and bright that a picture of the surroundings a few hundred pixels wide loses them. Only in the variant LAMPS.
#ifndef RG_OPTICS_LAMPS_GLSL
#define RG_OPTICS_LAMPS_GLSL
#include "optics/look_lamp.glsl"
#include "optics/surroundings.glsl"

layout(std430, binding = 4) readonly buffer Lamps {
  LookLamp lamps[kMostLookLamps];
  int lamp_count;
};

vec3 lamps_seen_from = vec3(0.0);  // from the eye, world axes, m; set before

const float kLampSpread = 1.5;        // of what neighbouring pixels see: then no lamp falls between them
const float kSmallestLamp_rad = 5e-3;  // a lamp's own size: 10 cm at 20 m
const float kWidestLamp_rad = 1.5;    // the kernel is whole on the sphere up to 2

// Irradiance across the ray from a lamp, and where it is.
vec3 lampIrradiance(LookLamp lamp, out vec3 towards) {
  vec3 way = lamp.place_inner.xyz - lamps_seen_from;
  float distance_m = max(length(way), 0.1);
  towards = way / distance_m;
  float outer = lamp.direction_outer.w;
  float cone = outer <= -1.0 ? 1.0 : smoothstep(outer, max(lamp.place_inner.w, outer + 1e-3), -dot(towards, lamp.direction_outer.xyz));
  return lamp.intensity.rgb * (cone / (distance_m * distance_m));
}

// Radiance, times the target's exposure, that lamps add about a direction when it is seen `spread_rad` wide (the wider of both ways): each lamp's
// light spread over a disc, 3 / (pi s^2) (1 - q^2 / s^2)^2 of the chord q, whose integral over the sphere is one.
vec3 lampsTowards(vec3 direction_world, float spread_rad) {
  float s = clamp(kLampSpread * spread_rad, kSmallestLamp_rad, kWidestLamp_rad);
  float inverse = 1.0 / (s * s);
  vec3 light = vec3(0.0);
  for (int k = 0; k < lamp_count; ++k) {
    vec3 towards;
    vec3 irradiance = lampIrradiance(lamps[k], towards);
    vec3 chord = direction_world - towards;
    float rest = max(1.0 - dot(chord, chord) * inverse, 0.0);
#ifndef ENVIRONMENT  // where the visible picture stands for the surroundings it shows them already
    irradiance *= 1.0 - pictureAt(mat3(frame.eye_from_world) * towards).z;
#endif
    light += irradiance * (rest * rest);
  }
  return light * (frame.exposure * 0.9549297 * inverse);
}
#endif
