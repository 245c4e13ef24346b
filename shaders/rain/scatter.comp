// Puts new records in their slots.
#include "shared/rain_drop.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) writeonly buffer Records { RainDrop records[]; };
layout(std430, binding = 1) readonly buffer Slots { uint slots[]; };
layout(std430, binding = 2) readonly buffer Fresh { RainDrop fresh[]; };
layout(location = 0) uniform uint count;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < count) records[slots[i]] = fresh[i];
}
