// Light that drops gather and show.
#include "rain/streak.glsl"

layout(binding = 1) uniform samplerCube environment;

vec3 fromLamp(RainLamp lamp, vec3 drop, vec3 towards) {
  vec3 way = drop - lamp.place_inner.xyz;
  float distance_m = max(length(way), 0.1);
  way /= distance_m;
  float outer = lamp.direction_outer.w;
  float cone = outer <= -1.0 ? 1.0 : smoothstep(outer, max(lamp.place_inner.w, outer + 1e-3), dot(way, lamp.direction_outer.xyz));
  return lamp.intensity.rgb * (cone / (distance_m * distance_m) * rainPhase(dot(way, -towards)));
}

vec3 gatheredFromLamps(vec3 drop) {
  vec3 towards = normalize(drop), light = vec3(0.0);
  for (uint i = 0u; i < look.lamp_count; ++i) light += fromLamp(look.lamps[i], drop, towards);
  return light;
}

// From sky, ground and sun by a drop that is seen in the unit direction `towards`. Its wide lens gathers 165 degrees of what lies behind it, so
// the finest it tells apart is which half of the world it has before it. 0.94: what two faces of water let through.
vec3 gatheredFromSky(vec3 towards) {
  vec3 light;
  if (look.environment > 0u) {
    light = textureLod(environment, towards, max(float(look.environment) - 2.5, 0.0)).rgb;
  } else {
    light = mix(look.ground.rgb, look.sky.rgb, clamp(0.5 + 0.5 * towards.z, 0.0, 1.0));
  }
  return 0.94 * light + look.sun_irradiance.rgb * rainPhase(dot(towards, look.sun_direction.xyz));
}

// Mean radiance a drop shows.
vec3 gathered(vec3 drop) { return gatheredFromSky(normalize(drop)) + gatheredFromLamps(drop); }

vec3 asInTarget(vec3 radiance) {
  vec3 c = radiance * look.focal.w;
  if (look.srgb == 0u) return c;
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}
