#include "optics/look_frame.glsl"

layout(location = 0) in vec3 position;  // vehicle frame, m
layout(location = 1) in vec3 normal;    // out of the glass
layout(location = 2) in vec2 uv;

out PaneToPixel {
  vec3 from_eye;  // vehicle frame, m
  vec3 normal;
  vec2 uv;
} o;

void main() {
  o.from_eye = position - frame.eye_in_vehicle.xyz;
  o.normal = normal;
  o.uv = uv;
  gl_ClipDistance[0] = dot(frame.sill, vec4(position, 1.0));  // of a window that slides behind its sill
  gl_Position = frame.clip_from_eye * (frame.eye_from_vehicle * vec4(position, 1.0));
}
