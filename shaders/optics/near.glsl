// Solid things close behind the glass, as the target's depth tells: a wiper's arm and blade. The captured surroundings know nothing of them.
#ifndef RG_OPTICS_NEAR_GLSL
#define RG_OPTICS_NEAR_GLSL
#include "optics/look_frame.glsl"
#include "shared/rain_look.glsl"

layout(binding = 5) uniform sampler2D scene_depth;

const float kFarthestNear_m = 0.25;  // a wiper's arm stands less far off the glass
const float kNear_m = 0.08;          // all of what stands nearer is near

// How far along the view the target's depth says that something stands at a pixel (of the target).
float sceneDepthAt_m(ivec2 px) { return rainSceneDepth(texelFetch(scene_depth, px, 0).r, frame.depth_rows, frame.depth_seen - 1u); }

// How far behind the glass, along its pixel's ray, the nearest thing stands; `to_glass_m`: from the eye along the ray. Endless where the target's
// depth is not given.
float behindGlass_m(float to_glass_m) {
  float gap = max(sceneDepthAt_m(ivec2(gl_FragCoord.xy)) * gl_FragCoord.w - 1.0, 0.0) * to_glass_m;
  return frame.depth_seen == 0u ? 1e7 : gap;
}

// The same for another place of the picture (0 .. 1), the glass there being the plane `normal` . p = `offset_m` (eye frame, the pane's tangent plane).
float behindGlassAt_m(vec2 at, vec3 normal, float offset_m) {
  vec2 ndc = 2.0 * at - 1.0;
  vec3 ray = vec3((ndc + vec2(frame.clip_from_eye[2][0], frame.clip_from_eye[2][1])) / vec2(frame.clip_from_eye[0][0], frame.clip_from_eye[1][1]), -1.0);
  float glass_m = offset_m / dot(normal, ray);  // along the view
  float scene_m = sceneDepthAt_m(ivec2(frame.viewport.xy + clamp(at, 0.0, 0.9999) * frame.viewport.zw));
  float gap = glass_m > 0.0 ? max(scene_m - glass_m, 0.0) * length(ray) : 1e7;
  return frame.depth_seen == 0u ? 1e7 : gap;
}

// 1 at the glass, 0 from a quarter of a metre off; `cosine` of the ray to the glass's normal.
float nearness(float behind_m, float cosine) { return 1.0 - smoothstep(kNear_m, kFarthestNear_m, behind_m * abs(cosine)); }
#endif
