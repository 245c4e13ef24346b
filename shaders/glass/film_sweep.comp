// A blade passes over the texels whose angle lies in its way: all but a residual film goes to its ridge.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Swept { SweptTexel swept[]; };
layout(std430, binding = 3) buffer Film { int film[]; };
layout(location = 2) uniform int first;
layout(location = 3) uniform int residual_pl;

const int kFullRidge_pl = 1000000000;  // 1 mL on a piece of a centimetre: more runs under the blade

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  SweptTexel entry = swept[first + i];
  if (ridge_before_pl[entry.segment] > kFullRidge_pl) return;
  int volume = atomicMin(film[placeOf(entry.texel)], residual_pl);
  if (volume <= residual_pl) return;
  atomicAdd(ridge_pl[entry.segment], passed(kSweep, volume - residual_pl));
  wake(entry.texel);
}
