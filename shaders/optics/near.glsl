// Solid things close behind the glass, as the target's depth tells: a wiper's arm and blade. The captured surroundings know nothing of them.
#ifndef RG_OPTICS_NEAR_GLSL
#define RG_OPTICS_NEAR_GLSL
#include "optics/look_frame.glsl"
#include "shared/rain_look.glsl"

layout(binding = 5) uniform sampler2D scene_depth;

const float kFarthestNear_m = 0.25;  // a wiper's arm stands less far off the glass
const float kNear_m = 0.08;          // all of what stands nearer is near

// How far behind the glass, along its pixel's ray, the nearest thing stands; `to_glass_m`: from the eye along the ray. Endless where the target's
// depth is not given.
float behindGlass_m(float to_glass_m) {
  float stored = texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r;
  float along_view = rainSceneDepth(stored, frame.depth_rows, frame.depth_seen - 1u);
  float gap = max(along_view * gl_FragCoord.w - 1.0, 0.0) * to_glass_m;
  return frame.depth_seen == 0u ? 1e7 : gap;
}

// 1 at the glass, 0 from a quarter of a metre off; `cosine` of the ray to the glass's normal.
float nearness(float behind_m, float cosine) { return 1.0 - smoothstep(kNear_m, kFarthestNear_m, behind_m * abs(cosine)); }
#endif
