// Lists the drops that are drawn, small ones and large ones apart, each in their own order: what is drawn over what does not change. One group does
// it all.
#include "optics/look_frame.glsl"
#include "optics/seen_drop.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 5) readonly buffer Kinds { uint kinds[]; };
layout(std430, binding = 6) writeonly buffer Picked { uint picked[]; };  // as many places for small ones as there are drops, then large ones
layout(std430, binding = 7) writeonly buffer Commands { uint commands[]; };  // DrawArraysIndirectCommand of both

shared uvec2 sums[gl_WorkGroupSize.x];

uvec2 countOf(int drop) {
  uint kind = kinds[drop];
  return uvec2(kind == kSmallDrop ? 1u : 0u, kind == kLargeDrop ? 1u : 0u);
}

void main() {
  int k = int(gl_LocalInvocationIndex), invocations = int(gl_WorkGroupSize.x);
  int each = (frame.drop_count + invocations - 1) / invocations;
  int from = k * each, to = min(from + each, frame.drop_count);
  uvec2 own = uvec2(0u);
  for (int drop = from; drop < to; ++drop) own += countOf(drop);
  sums[k] = own;
  barrier();
  for (int step = 1; step < invocations; step *= 2) {  // to the sum of all up to it
    uvec2 before = k >= step ? sums[k - step] : uvec2(0u);
    barrier();
    sums[k] += before;
    barrier();
  }
  uvec2 next = sums[k] - own;
  for (int drop = from; drop < to; ++drop) {
    uvec2 count = countOf(drop);
    if (count.x != 0u) picked[next.x] = uint(drop);
    if (count.y != 0u) picked[uint(frame.drop_count) + next.y] = uint(drop);
    next += count;
  }
  if (k == 0) {
    uvec2 total = sums[invocations - 1];
    uint written[8] = uint[](3u * total.x, 1u, 0u, 0u, 6u * total.y, 1u, 0u, 0u);
    for (int c = 0; c < 8; ++c) commands[c] = written[c];
  }
}
