// Darkens what looks up and is rained on, and lays over it what its water mirrors of the surroundings.
#include "shared/rain_drop.glsl"
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "rain/light.glsl"
#include "shared/wet.glsl"

layout(std140, binding = 0) uniform WetBlock { WetView view; };
layout(binding = 0) uniform sampler2D scene_depth;
layout(location = 0) noperspective in vec2 clip;
layout(location = 0) out vec4 colour;

// The cube map's level that is mirrored, from its last on: where only grains are wet, and where water lies flat (by eye: it is never at rest).
const float kRoughest = 2.0, kSharpest = 6.0;
const float kWetGrains = 0.3;  // as much as a whole mirror do wet grains glint to all sides (by eye)

void main() {
  // Neighbours that are asked for derivatives alone may lie beside the viewport.
  vec2 low = look.viewport.xy + 0.5, texel = clamp(gl_FragCoord.xy, low, low + look.viewport.zw - 1.0);
  float stored = texelFetch(scene_depth, ivec2(texel), 0).r;
  bool is_sky = stored == (look.depth_rows.y > 0.0 ? 0.0 : 1.0);
  float depth = rainSceneDepth(stored, look.depth_rows, look.zero_to_one);
  vec3 place = (view.ray_middle.xyz + clip.x * view.ray_right.xyz + clip.y * view.ray_up.xyz) * depth;
  vec3 right = dFdx(place), up = dFdy(place), normal = cross(right, up);
  normal *= inversesqrt(max(dot(normal, normal), 1e-20));
  if (dot(normal, place) > 0.0) normal = -normal;
  float looks_up = view.fall_wet.w * smoothstep(0.2, 0.7, normal.z);
  if (is_sky || looks_up <= 0.0 || wetIsSheltered(place, view.fall_wet.xyz, 0.01 + depth / look.focal.y)) discard;

  // Pixels that see a patch and more see what all patches are on average.
  float seen = sqrt(max(dot(right, right), dot(up, up))) / kWetPatch_m;
  float patches = mix(wetPatch(view.water.yz + place.xy), 1.0, smoothstep(0.25, 1.0, seen));
  float water_mm = view.water.x * patches, wet = looks_up * wetDarkened(water_mm);
  float filled = wetFilled(water_mm) * smoothstep(0.7, 0.95, normal.z);  // water runs down from what is steep
  vec3 towards = normalize(place), mirrored = reflect(towards, normal);
  mirrored.z = abs(mirrored.z);
  vec3 light = look.sky.rgb;
  if (look.environment > 0u) light = textureLod(environment, mirrored, max(float(look.environment) - mix(kRoughest, kSharpest, filled), 0.0)).rgb;
  float mirrors = wet * wetMirrors(dot(-towards, normal)) * mix(kWetGrains, 1.0, filled);
  float left = (1.0 - wet * (1.0 - wetAlbedoFactor())) * (1.0 - mirrors);
  colour = vec4(asInTarget(light) * mirrors, 1.0 - left);
}
