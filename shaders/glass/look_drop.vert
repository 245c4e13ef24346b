// A corner of the rectangle on the glass that covers all pixels in which a drop's cap can be seen.
#include "optics/look_frame.glsl"
#include "optics/seen_drop.glsl"

layout(std430, binding = 2) readonly buffer Seen { SeenDrop seen[]; };

out vec2 base;     // on the glass, in base radii, drop's frame
flat out int which;  // of `seen`: a record read by each pixel costs less than many flat values for each triangle

void main() {
  which = gl_VertexID / 6;
  SeenDrop drop = seen[which];
  int at = gl_VertexID % 6;  // corners 0 1 2 and 3 2 1 of two triangles
  int corner = at < 3 ? at : 6 - at;
  float along = (corner & 1) == 0 ? -drop.reach.w : drop.reach.z;
  float across = (corner & 2) == 0 ? -drop.beside_phase.x : drop.beside_phase.x;
  vec2 circle = drop.reach.xy * along + vec2(-drop.reach.y, drop.reach.x) * across;
  base = vec2(circle.x * drop.head_stretch.w, circle.y);
  vec3 on_glass = drop.head_stretch.xyz * base.x + cross(drop.normal_reflections.xyz, drop.head_stretch.xyz) * base.y;
  bool drawn = drop.beside_phase.z > 0.0 && drop.light_small.w == 0.0;
  vec4 eye_position = frame.eye_from_vehicle * vec4(drop.position_radius.xyz + on_glass * drop.position_radius.w, 1.0);
  gl_Position = drawn ? frame.clip_from_eye * eye_position : vec4(0.0, 0.0, 2.0, 1.0);
}
