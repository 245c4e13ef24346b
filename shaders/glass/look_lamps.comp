// Puts out the lamps that something in the picture stands before: a house, a car. What stands close to the eye is our own car, past which drops
// see them.
#include "optics/look_frame.glsl"
#include "optics/look_lamp.glsl"
#include "shared/rain_look.glsl"

layout(binding = 5) uniform sampler2D scene_depth;
layout(local_size_x = 16) in;
layout(std430, binding = 4) buffer Lamps {
  LookLamp lamps[kMostLookLamps];
  int lamp_count;
};

const float kOwnCar_m = 4.0;
const float kInLamp_m = 0.8;  // a lamp's own glass and car stand before it

void main() {
  int k = int(gl_LocalInvocationID.x);
  if (k >= lamp_count || frame.depth_seen == 0u) return;
  vec3 place_eye = mat3(frame.eye_from_world) * lamps[k].place_inner.xyz;
  vec4 clip = frame.clip_from_eye * vec4(place_eye, 1.0);
  if (clip.w <= 0.0 || any(greaterThanEqual(abs(clip.xy), vec2(clip.w)))) return;
  ivec2 px = ivec2(frame.viewport.xy + (0.5 + 0.5 * clip.xy / clip.w) * frame.viewport.zw);
  float before_m = rainSceneDepth(texelFetch(scene_depth, px, 0).r, frame.depth_rows, frame.depth_seen - 1u);
  if (before_m > kOwnCar_m && before_m < -place_eye.z - kInLamp_m) lamps[k].intensity = vec4(0.0);
}
