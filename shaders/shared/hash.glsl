// Random numbers as a function of what they are for (seed, id, tick ...): the same on CPU and GPU, in any order, on any number of threads.
#ifndef RG_SHARED_HASH_GLSL
#define RG_SHARED_HASH_GLSL
#include "shared/compat.glsl"
RG_SHARED_BEGIN

// PCG-RXS-M-XS-32: O'Neill (2014), "PCG: A family of simple fast space-efficient statistically good algorithms", as a hash by
// Jarzynski & Olano (2020), "Hash Functions for GPU Rendering", JCGT 9(3). A permutation of the 32-bit numbers.
RG_FN uint pcg(uint v) {
  uint state = v * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

// pcg3d of the same paper: three numbers in, three that depend on all of them out.
RG_FN uvec3 pcg3d(uvec3 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v = v ^ (v >> 16u);
  v.x += v.y * v.z;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  return v;
}

// pcg4d of the same paper.
RG_FN uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v = v ^ (v >> 16u);
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

// The upper 24 bits as a float in [0, 1): every step of 2^-24 is exact, so CPU and GPU agree to the bit.
RG_FN float unitFloat(uint h) { return float(h >> 8u) * 5.9604644775390625e-8f; }

// As unitFloat, in (0, 1): for logarithms. The middles of 2^23 steps are exact too.
RG_FN float openUnitFloat(uint h) { return (float(h >> 9u) + 0.5f) * 1.1920928955078125e-7f; }

RG_SHARED_END
#endif
