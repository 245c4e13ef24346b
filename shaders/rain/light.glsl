// The light that a drop shows, and how the target holds it.
#include "rain/streak.glsl"

layout(binding = 1) uniform samplerCube environment;

vec3 irradianceOf(RainLamp lamp, vec3 drop, out vec3 way) {
  way = drop - lamp.place_inner.xyz;
  float distance_m = max(length(way), kRainLampSize_m);
  way /= distance_m;
  return lamp.intensity.rgb * (rainLampCone(lamp, way) / (distance_m * distance_m));
}

vec3 fromLamp(RainLamp lamp, vec3 drop, vec3 towards) {
  vec3 way;
  vec3 irradiance = irradianceOf(lamp, drop, way);
  return irradiance * rainPhase(dot(way, -towards));
}

vec3 gatheredFromLamps(vec3 drop) {
  vec3 towards = normalize(drop), light = vec3(0.0);
  for (uint i = 0u; i < look.lamp_count; ++i) light += fromLamp(look.lamps[i], drop, towards);
  return light;
}

// The mean over drops on a stretch of a way, see rainLampAlong.
vec3 gatheredFromLampsAlong(vec3 towards, float from_m, float to_m, float wide_rad) {
  vec3 light = vec3(0.0);
  for (uint i = 0u; i < look.lamp_count; ++i) light += look.lamps[i].intensity.rgb * rainLampAlong(look.lamps[i], towards, from_m, to_m, wide_rad);
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

// Of what scatters all light alike to all sides: the mean of all round, but for what ice and its soot take (0.95: unsourced).
vec3 scattered(vec3 drop) {
  const float kPerSteradian = 0.0795775;  // 1 / 4 pi
  vec3 light = 0.5 * (look.sky.rgb + look.ground.rgb) + kPerSteradian * look.sun_irradiance.rgb;
  for (uint i = 0u; i < look.lamp_count; ++i) {
    vec3 way;
    light += kPerSteradian * irradianceOf(look.lamps[i], drop, way);
  }
  return 0.95 * light;
}

vec3 shown(vec3 drop, int is_of) {
  float white = rainWhite(is_of);
  vec3 light = white < 1.0 ? gathered(drop) : vec3(0.0);
  return white > 0.0 ? mix(light, scattered(drop), white) : light;
}

vec3 asInTarget(vec3 radiance) {
  vec3 c = radiance * look.focal.w;
  if (look.srgb == 0u) return c;
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

// The other way: the radiance of what a target holds.
vec3 fromTarget(vec3 held) {
  if (look.srgb != 0u) held = mix(held / 12.92, pow((max(held, 0.0) + 0.055) / 1.055, vec3(2.4)), greaterThan(held, vec3(0.04045)));
  return held / look.focal.w;
}
