// Where a blade turns round its ridge stays on the glass; what has nowhere to stay, or runs on over the edge, is thrown off. No piece of a ridge twice in a step.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Leaves { RidgeLeave leaves[]; };
layout(std430, binding = 2) readonly buffer Texels { int texels[]; };
layout(std430, binding = 3) buffer Film { int film[]; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  RidgeLeave leave = leaves[i];
  int volume = passed(kLeave, ridge_pl[leave.segment]);
  ridge_pl[leave.segment] = 0;
  if (leave.count == 0 || volume >= leave.over_edge_pl) {
    thrown_pl[leave.segment] += uint(volume);
    return;
  }
  int each = volume / leave.count;
  for (int k = 0; k < leave.count; ++k) {
    int share = k == 0 ? volume - each * (leave.count - 1) : each;
    atomicAdd(film[placeOf(texels[leave.first + k])], share);
    wake(texels[leave.first + k]);
  }
}
