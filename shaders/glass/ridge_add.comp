// Drops a blade met join its ridge.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Orders { RidgeAdd adds[]; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i < count) atomicAdd(ridge_pl[adds[i].segment], passed(adds[i].volume_pl));
}
