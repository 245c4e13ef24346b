// Drops take what they ran over. No texel twice in a step.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(r32i, binding = 0) uniform iimage2D film;
layout(std430, binding = 0) readonly buffer Orders { FilmTake takes[]; };
layout(std430, binding = 2) writeonly buffer Report { int taken_pl[]; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  ivec2 cell = cellOf(takes[i].texel);
  int volume = imageLoad(film, cell).x;
  int taken = shareOf(volume, takes[i].share_65536);
  imageStore(film, cell, ivec4(volume - taken));
  taken_pl[i] = passed(taken);
  wake(takes[i].texel);
}
