// A corner of the rectangle on the glass that covers all pixels in which a drop's cap can be seen.
#include "optics/look_frame.glsl"
#include "optics/seen_drop.glsl"

layout(std430, binding = 2) readonly buffer Seen { SeenDrop seen[]; };
layout(std430, binding = 6) readonly buffer Picked { uint picked[]; };

out vec2 base;     // on the glass, in base radii, drop's frame
flat out int which;  // of `seen`: a record read by each pixel costs less than many flat values for each triangle

void main() {
  which = int(picked[frame.drop_count + gl_VertexID / 6]);
  vec4 reach = seen[which].reach;
  float beside = seen[which].beside_phase.x;
  int at = gl_VertexID % 6;  // corners 0 1 2 and 3 2 1 of two triangles
  int corner = at < 3 ? at : 6 - at;
  float along = (corner & 1) == 0 ? -reach.w : reach.z;
  float across = (corner & 2) == 0 ? -beside : beside;
  vec2 circle = reach.xy * along + vec2(-reach.y, reach.x) * across;
  base = vec2(circle.x * seen[which].head_stretch.w, circle.y);
  gl_Position = seen[which].clip_middle + seen[which].clip_along * base.x + seen[which].clip_across * base.y;
}
