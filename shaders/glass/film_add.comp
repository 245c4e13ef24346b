// Rain, trails and dissolved drops come to the film. No texel twice in a step.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(r32i, binding = 0) uniform iimage2D film;
layout(std430, binding = 0) readonly buffer Orders { FilmAdd adds[]; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  ivec2 cell = cellOf(adds[i].texel);
  imageStore(film, cell, ivec4(imageLoad(film, cell).x + passed(adds[i].volume_pl)));
  wake(adds[i].texel);
}
