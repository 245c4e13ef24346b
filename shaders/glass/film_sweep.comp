// A blade passes over the texels whose angle lies in its way, each piece of it over its own, one after the other: what it does not leave behind goes
// to its ridge. Then the ridge levels along the blade.
#include "glass/film_buffers.glsl"
#include "shared/glass_wiper.glsl"
layout(local_size_x = kBladeSegments) in;
layout(std430, binding = 0) readonly buffer Swept { SweptTexel swept[]; };
layout(std430, binding = 2) readonly buffer Ranges { SweptRange ranges[]; };  // one for each piece
layout(std430, binding = 3) buffer Film { int film[]; };
layout(std430, binding = 6) buffer Lying { uint beads[]; };
layout(location = 2) uniform int first_piece;
layout(location = 3) uniform int backwards;

shared int carried[kBladeSegments];

int swept_over(int ridge, SweptRange range) {
  for (int k = 0; k < range.count; ++k) {
    SweptTexel entry = swept[range.first + (backwards != 0 ? range.count - 1 - k : k)];
    int place = placeOf(entry.texel), volume = film[place];
    uint lying = beads[place];
    int water = volume + beadsOf(lying).volume_pl;  // beads are pressed flat
    int left = leftBehind_pl(water, entry, ridge);
    if (left == volume && lying == 0u) continue;
    ridge += left < water ? passed(kSweep, water - left) : water - left;
    film[place] = left;
    beads[place] = 0u;
    wake(entry.texel);
  }
  return ridge;
}

void main() {
  int piece = int(gl_LocalInvocationID.x);
  int ridge = swept_over(ridge_pl[first_piece + piece], ranges[piece]);
  for (int k = 0; k < kLevellings; ++k) {
    carried[piece] = ridge;
    barrier();
    if (piece > 0) ridge += levelledAlong_pl(carried[piece - 1], carried[piece]);
    if (piece + 1 < kBladeSegments) ridge -= levelledAlong_pl(carried[piece], carried[piece + 1]);
    barrier();
  }
  ridge_pl[first_piece + piece] = ridge;
}
