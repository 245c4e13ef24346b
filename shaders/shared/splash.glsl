// Splashes: where and when drops throw water up from what they meet, as a function of place and time alone, and how a crown looks.
//
// Drops that are large enough fall along lines. Where lines stand is hashed by (cell of a level lattice, epoch): a Poisson field in place and
// time, of the rain's own flux, that knows neither views nor frames (but for the height it is laid out at where the host tells no ground: that is
// guessed from the first view's eye). Where a line meets the scene is for the picture to find. In GLSL, declare
// `RainShelter rain_shelter` (a uniform block's) before including this, and for splashOf define SPLASH_RAIN_BINDING, the uniform
// block it is bound to.
#ifndef RG_SHARED_SPLASH_GLSL
#define RG_SHARED_SPLASH_GLSL
#include "shared/hash.glsl"
#include "shared/rain_streak.glsl"
RG_SHARED_BEGIN

RG_CONST float kSplashFrom_mm = 1.0f;  // smaller drops throw up nothing (physics of rain: crowns come from about 1 mm up)
RG_CONST float kSplashEpoch_s = 0.0625f;
RG_CONST uint kSplashEpochs = 3u;      // that may have splashes left: two whole ones cover the longest life
RG_CONST uint kSplashLevels = 3u;
RG_CONST uint kSplashLattices = 2u;    // one stands in the world, one goes with the view's vehicle
RG_CONST uint kSplashSizes = 32u;      // steps of the sizes' distribution
RG_CONST uint kSplashGroup = 1024u;    // splashes a workgroup looks at,
RG_CONST uint kSplashLanes = 256u;     // so many at a time
RG_CONST uint kSplashParts = 512u;     // crowns and droplets that it draws at most
RG_CONST uint kSplashDroplets = 3u;    // that are drawn with a crown near by

// As far as this all splashes are drawn; beyond, ever fewer, each for so many more: as many as there are pixels for (by eye: a crown is some 4 px
// wide there in a picture of 1920 px).
RG_CONST float kSplashAll_m = 3.0f;

// A cell of a lattice during an epoch.
struct SplashJob {
  vec4 corner;  // xyz: of the cell, at the reference height, from the eye, world axes, m; w: its side, m
  uint x;       // what its splashes are hashed from: the cell,
  uint y;
  uint epoch;
  uint level;     // and the level of thinning: bits 0 and 1; above them the lattice, bit 2, and its name
  float since_s;  // from the epoch's beginning to the picture
  uint number;    // of its splashes in all
  uint from;      // those before are over; as many follow as there are numbers until the next job's `first`
  uint first;     // what number the one `from` has among all of the picture's
};
RG_SIZE(SplashJob, 48)

// One uniform block a draw.
struct SplashRain {
  vec4 moves[kSplashLattices];    // xyz: the lattice's velocity, m/s
  vec4 drift[kSplashLattices];    // xyz: of the wind that drops have, past the lattice, m/s
  vec4 search[kSplashLattices];   // x, y: heights about the reference between which lines are followed, m; z: of the ground about the reference
  vec4 reach;                     // x: how far splashes are drawn, m; y: gain; z: how near to the eye what stands above the ground is the vehicle's,
                                  // m, 0: nothing is
  vec4 ray_middle;                // the view ray through clip (x, y) is middle + x right + y up, as long as makes its depth 1
  vec4 ray_right;
  vec4 ray_up;
  vec4 sizes_mm[kSplashSizes / 4u + 1u];  // the diameters below which k / kSplashSizes of the drops lie
};

// A uniform block in shaders and a parameter in C++: handed on by value its arrays would be copied each time.
#ifdef __cplusplus
#define RG_SPLASH_RAIN , const SplashRain& splash_rain
#define RG_SPLASH_RAIN_PASS , splash_rain
#else
#define RG_SPLASH_RAIN
#define RG_SPLASH_RAIN_PASS
#ifdef SPLASH_RAIN_BINDING
layout(std140, binding = SPLASH_RAIN_BINDING) uniform SplashBlock { SplashRain splash_rain; };
#endif
#endif

struct Splash {
  vec3 place_m;       // of its line at the reference height, from the eye
  vec3 velocity_mps;  // of its drop past the lattice, along the line
  float diameter_m;   // of the drop
  float age_s;        // < 0: not yet
  float life_s;
  float rank;  // 0 .. 1: the lower, the farther it is still drawn
  uint seed;
};

// Atlas, Srivastava & Sekhon (1973), as rain/size_law.
RG_FN float splashFallSpeed(float diameter_mm) { return 9.65f - 10.3f * exp(-0.6f * diameter_mm); }

// A crown's water rises and falls freely: its life follows from how high the fastest of it goes, 4.5 drop diameters, up to 18 mm. (A factor by
// eye: Cossali, Marengo, Coghe & Zhdanov 2004, "The role of time in single drop splash on thin film", Exp. Fluids 36, find crowns of some two
// diameters, and droplets above them, at drops' Weber numbers of some hundreds.)
RG_CONST float kSplashThrow = 4.5f;
RG_CONST float kSplashLargest_m = 0.004f;  // larger ones throw no higher
RG_FN float splashThrow_mps(float diameter_m) {
  return sqrt(2.0f * kRainGravity_mps2 * kSplashThrow * min(diameter_m, kSplashLargest_m));
}
RG_FN float splashLife_s(float diameter_m) { return 2.0f * splashThrow_mps(diameter_m) / kRainGravity_mps2; }

#if defined(__cplusplus) || defined(SPLASH_RAIN_BINDING)
RG_FN float splashSize_m(float u RG_SPLASH_RAIN) {
  float at = u * float(kSplashSizes);
  uint k = min(uint(at), kSplashSizes - 1u);
  float from = splash_rain.sizes_mm[k / 4u][int(k % 4u)], to = splash_rain.sizes_mm[(k + 1u) / 4u][int((k + 1u) % 4u)];
  return 1.0e-3f * mix(from, to, at - float(k));
}
#endif

// Against whatever wind or vehicle a drop comes down this fast, as lines that rise would meet nothing (by eye).
RG_CONST float kSplashLeastFall_mps = 0.5f;

// Of a level the ranks are those between 1/4 and 1 of the level's own; the last has all that is left.
RG_FN vec2 splashRanks(uint level) {
  float most = 1.0f / float(1u << (2u * level));
  return vec2(level + 1u == kSplashLevels ? 0.0f : 0.25f * most, most);
}

// How often a splash counts at a distance from the eye. As many are drawn as p = (kSplashAll_m / distance)^2 says, each 1 / p times, those of the
// highest ranks half faded: the mean over all ranks is 1 everywhere.
RG_FN float splashTimes(float rank, float distance_m) {
  float p = kSplashAll_m / max(distance_m, 1.0e-3f);
  p *= p;
  float x = rank / p, last = 1.0f / p;
  float shown = clamp(2.0f * (1.25f - x), 0.0f, 1.0f);
  float rest = max(1.25f - last, 0.0f);
  float mean = last <= 0.75f ? last : 1.0f - rest * rest;
  return shown / (p * mean);
}
// Beyond this, of a level's ranks none is drawn.
RG_FN float splashReach_m(uint level) {
  float least = splashRanks(level).x;
  return least > 0.0f ? kSplashAll_m * sqrt(1.25f / least) : 1.0e9f;
}

#if defined(__cplusplus) || defined(SPLASH_RAIN_BINDING)
RG_FN Splash splashOf(RG_IN(SplashJob) job, uint index RG_SPLASH_RAIN) {
  uvec4 a = pcg4d(uvec4(job.x, job.y, job.epoch, job.level * 2654435769u + index)), b = pcg4d(a);
  uint lattice = job.level >> 2u & 1u;
  vec2 ranks = splashRanks(job.level & 3u);
  Splash s;
  s.diameter_m = splashSize_m(unitFloat(a.z) RG_SPLASH_RAIN_PASS);
  s.place_m = xyz(job.corner) + job.corner.w * vec3(unitFloat(a.x), unitFloat(a.y), 0.0f);
  vec4 drift = splash_rain.drift[lattice];
  s.velocity_mps = vec3(drift.x, drift.y, min(drift.z - splashFallSpeed(1.0e3f * s.diameter_m), -kSplashLeastFall_mps));
  s.age_s = job.since_s - kSplashEpoch_s * (float(index) + unitFloat(a.w)) / float(job.number);  // spread over the epoch in the order of their numbers
  s.life_s = splashLife_s(s.diameter_m);
  s.rank = mix(ranks.x, ranks.y, openUnitFloat(b.x));
  s.seed = b.y;
  return s;
}
#endif

RG_FN bool splashIsAlive(RG_IN(Splash) s) { return s.age_s >= 0.0f && s.age_s < s.life_s; }

// Where the line is at a height over the reference, from the eye.
RG_FN vec3 splashOnLine(RG_IN(Splash) s, float height_m) { return s.place_m + s.velocity_mps * (height_m / s.velocity_mps.z); }

// Whether a drop that came to `place` (from the eye) `age_s` ago came through a volume. `ground_mps` is the lattice's velocity. Surfaces lie in
// volumes' faces: how exactly the place is known, `skin_m` in height, the last of the way does not count.
RG_CONST float kSplashPath_m = 60.0f;  // as much of a line as volumes near the eye can lie on
RG_FN bool splashIsSheltered(vec3 place, vec3 velocity_mps, vec3 ground_mps, float age_s, float skin_m RG_RAIN_SHELTER) {
  float skin_s = skin_m / abs(velocity_mps.z);
  for (uint i = 0u; i < rain_shelter.volume_count; ++i) {
    vec3 body_mps = xyz(rain_shelter.volumes[i].velocity);
    vec3 then = place + (body_mps - ground_mps) * age_s, way = velocity_mps + ground_mps - body_mps;
    if (!rainMayTouch(i, then, way, -kSplashPath_m / length(way), 0.0f, 0.0f RG_RAIN_SHELTER_PASS)) continue;
    vec2 inside = rainTimesInside(i, then, way, 0.0f RG_RAIN_SHELTER_PASS);
    if (inside.x < inside.y && inside.x < -skin_s) return true;
  }
  return false;
}

// A crown: a wall of water about a circle, with a rim on top. Its foot spreads with the root of time (Yarin & Weiss 1995, "Impact of drops on
// solid surfaces", JFM 283) to 3.7 drop diameters, its height is that of water thrown up (2.5 diameters at most; both by eye within what
// Cossali et al. 2004 show).
struct SplashCrown {
  float radius_m;
  float height_m;
  float rim_m;  // half the rim's thickness
};
RG_CONST float kSplashWall = 0.1f;  // share of what is behind it that the wall hides, seen square on (by eye: it is thin, and clear but for its ripples)
RG_CONST float kSplashRim = 0.5f;   // and the rim, in beads
RG_FN SplashCrown splashCrown(float diameter_m, float share_of_life) {
  SplashCrown crown;
  float x = min(share_of_life / 0.75f, 1.0f);
  crown.radius_m = diameter_m * (0.5f + 1.35f * sqrt(share_of_life));
  crown.height_m = 2.5f * min(diameter_m, kSplashLargest_m) * 4.0f * x * (1.0f - x);
  crown.rim_m = 0.08f * diameter_m * min(1.0f, 4.0f * (1.0f - share_of_life));
  return crown;
}

// A droplet thrown off it: where it is from the crown's foot, world axes, and its radius.
RG_FN vec4 splashDroplet(RG_IN(Splash) s, uint number) {
  uvec3 h = pcg3d(uvec3(s.seed, number, 7u));
  float throw_mps = splashThrow_mps(s.diameter_m) * mix(0.75f, 1.0f, unitFloat(h.x));
  float turn = 6.2831853f * unitFloat(h.y), out_m = s.diameter_m + 0.5f * throw_mps * s.age_s;
  float height_m = throw_mps * s.age_s - 0.5f * kRainGravity_mps2 * s.age_s * s.age_s;
  return vec4(out_m * cos(turn), out_m * sin(turn), height_m, s.diameter_m * mix(0.06f, 0.11f, unitFloat(h.z)));
}

// What of a pixel's width about `at` lies between two places; summed over pixels it is all that lies between them.
RG_FN float splashWithin(float at, float pixel_half, float from, float to) {
  return max(0.0f, min(at + pixel_half, to) - max(at - pixel_half, from));
}

// What a crown covers of a pixel at `at` from its foot, px, x across and y up. Its parts lie on a circle seen from an elevation of that sine, which
// makes an ellipse; the picture's sum is the same at any size and place: rings by their arc in a pixel's column, and both walls' heights in its row.
RG_FN float splashCover(vec2 at, float pixel_half, float radius, float height, float rim, float sine, float phase) {
  float left = clamp((at.x - pixel_half) / radius, -1.0f, 1.0f), right = clamp((at.x + pixel_half) / radius, -1.0f, 1.0f);
  float arc = radius * (asin(right) - asin(left));
  float cosine = clamp(at.x / radius, -1.0f, 1.0f), away = radius * sine * sqrt(1.0f - cosine * cosine);
  float beads = 0.7f * cos(5.0f * acos(cosine) + phase);
  float front = kSplashWall * splashWithin(at.y + away, pixel_half, 0.0f, height) +
                kSplashRim * (1.0f + beads) * splashWithin(at.y + away, pixel_half, height - rim, height + rim);
  float back = kSplashWall * splashWithin(at.y - away, pixel_half, 0.0f, height) +
               kSplashRim * (1.0f - beads) * splashWithin(at.y - away, pixel_half, height - rim, height + rim);
  return arc * (front + back) / (4.0f * pixel_half * pixel_half);
}
// The sum of that over all pixels.
RG_FN float splashCoverSum(float radius, float height, float rim) {
  return 2.0f * 3.1415927f * radius * (kSplashWall * height + kSplashRim * 2.0f * rim);
}

// A corner of what is drawn: two lower ones, two upper ones. The first tells what is the same for all.
struct SplashCorner {
  vec4 place;  // in clip space
  vec4 a;      // xy: the foot, px on the target; zw: up there
  vec4 b;      // px: x radius, y height, z half the rim; w: the elevation's sine
  vec4 c;      // halves: x red and green, y blue and how often it counts; z: the depth that what hides it lies before, m; w: the beads' phase
};
RG_SIZE(SplashCorner, 64)

RG_SHARED_END
#endif
