// Darkens what looks up and is rained on, and lays over it what its water mirrors of the surroundings.
#include "shared/rain_drop.glsl"
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "rain/light.glsl"
#include "shared/wet.glsl"

layout(std140, binding = 0) uniform WetBlock { WetView view; };
layout(binding = 0) uniform sampler2D scene_depth;
layout(location = 0) noperspective in vec2 clip;
layout(location = 0) out vec4 colour;

const float kBlurred = 4.0;  // levels of the cube map that are left out: the mirror is rough (by eye)

void main() {
  // Neighbours that are asked for derivatives alone may lie beside the viewport.
  vec2 low = look.viewport.xy + 0.5, at = clamp(gl_FragCoord.xy, low, low + look.viewport.zw - 1.0);
  float stored = texelFetch(scene_depth, ivec2(at), 0).r;
  bool is_sky = stored == (look.depth_rows.y > 0.0 ? 0.0 : 1.0);
  float depth = rainSceneDepth(stored, look.depth_rows, look.zero_to_one);
  vec3 place = (view.ray_middle.xyz + clip.x * view.ray_right.xyz + clip.y * view.ray_up.xyz) * depth;
  vec3 normal = cross(dFdx(place), dFdy(place));
  normal *= inversesqrt(max(dot(normal, normal), 1e-20));
  if (dot(normal, place) > 0.0) normal = -normal;
  float wet = view.fall_wet.w * smoothstep(0.2, 0.7, normal.z);
  if (is_sky || wet <= 0.0 || wetIsSheltered(place, view.fall_wet.xyz, 0.01 + depth / look.focal.y)) discard;

  vec3 towards = normalize(place), mirrored = reflect(towards, normal);
  mirrored.z = abs(mirrored.z);
  vec3 light = look.sky.rgb;
  if (look.environment > 0u) light = textureLod(environment, mirrored, max(float(look.environment) - kBlurred, 0.0)).rgb;
  float mirrors = wet * wetMirrors(dot(-towards, normal)) * smoothstep(0.7, 0.95, normal.z);
  float left = (1.0 - wet * (1.0 - wetAlbedoFactor())) * (1.0 - mirrors);
  colour = vec4(asInTarget(light) * mirrors, 1.0 - left);
}
