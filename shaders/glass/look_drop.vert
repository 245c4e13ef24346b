// A corner of the rectangle on the glass that covers all pixels in which a drop's cap can be seen.
#include "optics/look_frame.glsl"
#include "optics/seen_drop.glsl"

layout(std430, binding = 2) readonly buffer Seen { SeenDrop seen[]; };

out DropToPixel {
  vec2 base;      // on the glass, in base radii, drop's frame
  vec3 from_eye;  // eye to that point, m, drop's frame
  flat vec3 cap;  // centre z, radius, stretch
  flat vec4 outline;  // irregularity, taper, phase, weight
  flat mat3 world_from_drop;
  flat int samples;   // across and along a pixel
} o;

void main() {
  SeenDrop drop = seen[gl_VertexID / 6];
  int at = gl_VertexID % 6;  // corners 0 1 2 and 3 2 1 of two triangles
  int corner = at < 3 ? at : 6 - at;
  float weight = drop.beside_phase.z;
  if (weight <= 0.0) {
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    return;
  }
  mat3 vehicle_from_drop = mat3(drop.head_stretch.xyz, cross(drop.normal_pixel.xyz, drop.head_stretch.xyz), drop.normal_pixel.xyz);
  float stretch = drop.head_stretch.w;
  vec2 forth = drop.reach.xy;
  float along = (corner & 1) == 0 ? -drop.reach.w : drop.reach.z;
  float across = (corner & 2) == 0 ? -drop.beside_phase.x : drop.beside_phase.x;
  vec2 circle = forth * along + vec2(-forth.y, forth.x) * across;

  o.base = vec2(circle.x * stretch, circle.y);
  vec3 on_glass = vec3(o.base * drop.position_radius.w, 0.0);
  o.from_eye = (drop.position_radius.xyz - frame.eye_in_vehicle.xyz) * vehicle_from_drop + on_glass;
  o.cap = vec3(drop.cap_outline.xy, stretch);
  o.outline = vec4(drop.cap_outline.zw, drop.beside_phase.y, weight);
  o.world_from_drop = mat3(frame.world_from_vehicle) * vehicle_from_drop;
  o.samples = int(drop.beside_phase.w);
  gl_Position = frame.clip_from_eye * (frame.eye_from_vehicle * vec4(drop.position_radius.xyz + vehicle_from_drop * on_glass, 1.0));
}
