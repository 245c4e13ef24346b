// A blade passes over the texels whose angle lies in its way: all but a residual film goes to its ridge.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(r32i, binding = 0) uniform iimage2D film;
layout(std430, binding = 0) readonly buffer Swept { SweptTexel swept[]; };
layout(location = 1) uniform int first;
layout(location = 2) uniform int residual_pl;

const int kFullRidge_pl = 1000000000;  // 1 mL on a piece of a centimetre: more runs under the blade

void main() {
  int i = int(gl_GlobalInvocationID.x);
  if (i >= count) return;
  SweptTexel entry = swept[first + i];
  if (ridge_before_pl[entry.segment] > kFullRidge_pl) return;
  int volume = imageAtomicMin(film, cellOf(entry.texel), residual_pl);
  if (volume <= residual_pl) return;
  atomicAdd(ridge_pl[entry.segment], passed(volume - residual_pl));
  wake(entry.texel);
}
