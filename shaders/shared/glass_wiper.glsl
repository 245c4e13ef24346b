// What a wiper's blade does to the water it meets, and how the ridge it pushes stands. Runs in shaders/glass/ and, for tests, in C++.
#ifndef RG_SHARED_GLASS_WIPER_GLSL
#define RG_SHARED_GLASS_WIPER_GLSL
#include "shared/compat.glsl"
#include "shared/glass_types.glsl"
RG_SHARED_BEGIN

RG_CONST int kFullRidge_pl = 300000000; // 0.3 mL on a piece of some 3 mm: more runs under the blade
RG_CONST int kLubricates_pl = 1 << 18;  // 0.26 uL on a piece: with less the rubber drags (unsourced)
RG_CONST int kLevellings = 4;           // exchanges between a ridge's pieces in a sweep: surface tension evens it out

// What stays on a texel behind the blade. A blade leaves its residual film, on dry glass too, out of its ridge, as far as that goes. One that
// runs dry smears: it leaves up to `smear_pl` more, the more the less there is to carry it.
RG_FN int leftBehind_pl(int volume_pl, RG_IN(SweptTexel) swept, int ridge_pl) {
  if (volume_pl < 0 || ridge_pl > kFullRidge_pl) return volume_pl;
  int dry_256 = (kLubricates_pl - min(ridge_pl, kLubricates_pl)) >> 10;
  int wanted = swept.residual_pl + ((swept.smear_pl * dry_256) >> 8);
  return min(wanted, volume_pl + ridge_pl);
}

// What passes from a piece of a ridge to the next.
RG_FN int levelledAlong_pl(int here_pl, int next_pl) { return (here_pl - next_pl) / 4; }

RG_CONST float kHighestRidge_m = 2.0e-3f; // a puddle's height, 2 sqrt(gamma / (rho g)) sin(angle / 2): 1.9 mm at 40 degrees

// Across its length the ridge is a parabola's half, highest at the blade: h(x) = (3/2) A / w (1 - (x / w)^2), whose area is A. Its foot meets the
// glass in the contact angle, 3 A / w^2 = tan(angle), unless it would stand higher than a puddle then.
RG_FN float ridgeWidth_m(float area_m2, float tan_contact) { return max(sqrt(3.0f * area_m2 / tan_contact), 1.5f * area_m2 / kHighestRidge_m); }
RG_FN float ridgeHeight_m(float area_m2, float width_m, float ahead_m) {
  float x = ahead_m / width_m;
  return x < 0.0f || x > 1.0f ? 0.0f : 1.5f * area_m2 / width_m * (1.0f - x * x);
}
RG_FN float ridgeSlope(float area_m2, float width_m, float ahead_m) {
  return ahead_m < 0.0f || ahead_m > width_m ? 0.0f : -3.0f * area_m2 * ahead_m / (width_m * width_m * width_m);
}

RG_SHARED_END
#endif
