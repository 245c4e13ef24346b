// A drop of about a pixel: one triangle around the ellipse that covers all pixels in which its cap can be seen.
#include "optics/look_frame.glsl"
#include "optics/seen_drop.glsl"

layout(std430, binding = 2) readonly buffer Seen { SeenDrop seen[]; };

out vec2 place;      // in the ellipse's half axes
flat out vec4 light;  // w: weight
flat out float near_seen;  // 1: what stands close behind the glass is to be seen

void main() {
  SeenDrop drop = seen[gl_VertexID / 3];
  int at = gl_VertexID % 3;
  // About a circle of radius 1.
  place = at == 0 ? vec2(0.0, 2.0) : vec2(at == 1 ? -1.7320508 : 1.7320508, -1.0);
  place *= drop.cap_outline.z;
  vec2 along = 0.5 * vec2(drop.reach.z + drop.reach.w, drop.reach.z - drop.reach.w);
  vec2 circle = drop.reach.xy * (place.x * along.x + along.y) + vec2(-drop.reach.y, drop.reach.x) * (place.y * drop.beside_phase.x);
  vec2 base = vec2(circle.x * drop.head_stretch.w, circle.y) * drop.position_radius.w;
  vec3 on_glass = drop.head_stretch.xyz * base.x + cross(drop.normal_reflections.xyz, drop.head_stretch.xyz) * base.y;
  vec4 eye_position = frame.eye_from_vehicle * vec4(drop.position_radius.xyz + on_glass, 1.0);
  bool drawn = drop.beside_phase.z > 0.0 && drop.light_small.w > 0.0;
  light = vec4(drop.light_small.rgb, drop.beside_phase.z);
  near_seen = drop.light_small.w < 1.5 ? 1.0 : 0.0;
  gl_Position = drawn ? frame.clip_from_eye * eye_position : vec4(0.0, 0.0, 2.0, 1.0);
}
