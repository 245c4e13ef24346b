// The part of a tile that is looked at, in the grid's pictures.
#include "optics/cells.glsl"
#include "optics/look_frame.glsl"

layout(binding = 3) uniform sampler2DArray pane_frame;
layout(binding = 6) uniform sampler2D pane_position;

layout(location = 2) uniform ivec2 texels;  // of the grid
layout(std430, binding = 2) readonly buffer Tiles { SeenTile seen[]; };

// A pane bends little over a tile.
out OverTile {
  vec3 along_u, along_v;  // unit tangents, vehicle frame
  float pixel_m;          // what a pixel of the view spans there
} o;

void main() {
  ivec2 at = tileAt(gl_VertexID / 6);
#ifdef EVERYWHERE
  ivec4 part = ivec4(0, kTileSize, 0, kTileSize);
#else
  ivec4 part = (ivec4(seen[gl_VertexID / 6].composed) >> ivec4(0, 8, 16, 24)) & 255;
#endif
  int corner = gl_VertexID % 6 < 3 ? gl_VertexID % 6 : 6 - gl_VertexID % 6;
  vec2 texel = vec2(min(at * kTileSize + ivec2((corner & 1) == 0 ? part.x : part.y, corner < 2 ? part.z : part.w), texels));
  vec2 uv = texel / vec2(texels);
  o.along_u = textureLod(pane_frame, vec3(uv, 0.0), 0.0).xyz;
  o.along_v = textureLod(pane_frame, vec3(uv, 1.0), 0.0).xyz;
  o.pixel_m = distance(textureLod(pane_position, uv, 0.0).xyz, frame.eye_in_vehicle.xyz) / frame.pixels_per_rad;
  gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
}
