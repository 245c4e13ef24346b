// A drop of about a pixel: one triangle around the ellipse that covers all pixels in which its cap can be seen.
#include "optics/seen_drop.glsl"

layout(std430, binding = 2) readonly buffer Seen { SeenDrop seen[]; };
layout(std430, binding = 6) readonly buffer Picked { uint picked[]; };

out vec2 place;      // in the ellipse's half axes
flat out vec4 light;  // w: weight; negative: what stands close behind the glass is not to be seen

void main() {
  uint which = picked[gl_VertexID / 3];
  int at = gl_VertexID % 3;
  place = at == 0 ? vec2(0.0, 2.0) : vec2(at == 1 ? -1.7320508 : 1.7320508, -1.0);  // about a circle of radius 1
  place *= seen[which].cap_outline.z;
  light = seen[which].light_weight;
  gl_Position = seen[which].clip_middle + seen[which].clip_along * place.x + seen[which].clip_across * place.y;
}
