#include "optics/look_frame.glsl"

layout(location = 0) in vec3 position;  // vehicle frame, m
layout(location = 1) in vec3 normal;    // out of the glass
layout(location = 2) in vec2 uv;
#ifdef TILED  // of a mesh cut into tiles only those of one kind are drawn
#include "shared/glass_tile.glsl"
layout(location = 3) in uint tile;
layout(location = 0) uniform uint wanted;
layout(std430, binding = 1) readonly buffer Tiles { uint kinds[]; };
#endif

out PaneToPixel {
  vec3 from_eye;  // vehicle frame, m
  vec3 normal;
  vec2 uv;
} o;

void main() {
  o.from_eye = position - frame.eye_in_vehicle.xyz;
  o.normal = normal;
  o.uv = uv;
  gl_Position = frame.clip_from_eye * (frame.eye_from_vehicle * vec4(position, 1.0));
#ifdef TILED
  if (kinds[tile] != wanted) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
#endif
}
