// Splashes: where and when drops throw water up from what they meet, as a function of place and time alone, and how one looks.
//
// Drops that are large enough fall along lines. Where lines stand is hashed by (cell of a level lattice, epoch): a Poisson field in place and
// time, of the rain's own flux, that knows neither views nor frames (but for the height it is laid out at where the host tells no ground: that is
// guessed from the first view's eye). Where a line meets the scene is for the picture to find. In GLSL, declare
// `RainShelter rain_shelter` (a uniform block's) before including this, and for splashOf define SPLASH_RAIN_BINDING, the uniform
// block it is bound to.
#ifndef RG_SHARED_SPLASH_GLSL
#define RG_SHARED_SPLASH_GLSL
#include "shared/hash.glsl"
#include "shared/rain_drawn.glsl"
#include "shared/rain_streak.glsl"
RG_SHARED_BEGIN

RG_CONST float kSplashFrom_mm = 1.0f;  // smaller drops throw up nothing (physics of rain: crowns come from about 1 mm up)
RG_CONST float kSplashEpoch_s = 0.015625f;  // short beside a splash's life, so that few are looked at that are over or to come
RG_CONST uint kSplashLevels = 4u;      // of thinning
RG_CONST uint kSplashSorts = 4u;       // of drops, by size
RG_CONST uint kSplashLattices = 2u;    // one stands in the world, one goes with the view's vehicle
RG_CONST uint kSplashSizes = 32u;      // steps of the sizes' distribution
RG_CONST uint kSplashGroup = 1024u;    // splashes a workgroup looks at,
RG_CONST uint kSplashLanes = 256u;     // so many at a time
RG_CONST uint kSplashStride = 16u;     // of so many the kernel is told the first one's job

RG_CONST float kSplashOnGround_m = 0.25f;  // what stands higher near the eye is its vehicle's, and moves with it

// As far as this all splashes of 2 mm drops are drawn; beyond, ever fewer, each for so many more: as many as there are pixels for (by eye: a crown is
// some 4 px wide there in a picture of 1920 px).
RG_CONST float kSplashAll_m = 3.0f;

// A cell of a lattice during an epoch.
struct SplashJob {
  vec4 corner;  // xyz: of the cell, at the reference height, from the eye, world axes, m; w: its side, m
  uint x;       // what its splashes are hashed from: the cell,
  uint y;
  uint epoch;
  uint level;     // and the level of thinning: bits 0 and 1; above them the lattice, bit 2, the sort, 3 and 4, and the lattice's name
  float since_s;  // from the epoch's beginning to the picture
  uint first;     // what number its first splash has among all of the picture's; as many are its as there are until the next job's
  uint spare0;
  uint spare1;
};
RG_SIZE(SplashJob, 48)

// One uniform block a draw.
struct SplashRain {
  vec4 moves[kSplashLattices];    // xyz: the lattice's velocity, m/s
  vec4 drift[kSplashLattices];    // xyz: of the wind that drops have, past the lattice, m/s
  vec4 search[kSplashLattices];   // x, y: heights about the reference between which lines are followed, m; z: of the ground about the reference;
                                  // w: how near to the eye what stands above the ground is the vehicle's, m, 0: nothing is
  vec4 reach;                     // x: how far splashes are drawn, m; y: gain
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

// Thrown-up water rises and falls freely: a splash's life follows from how high the fastest of it goes, 3 drop diameters, up to 12 mm. (A factor by
// eye: Cossali, Marengo, Coghe & Zhdanov 2004, "The role of time in single drop splash on thin film", Exp. Fluids 36, find crowns of some two
// diameters, and droplets above them, at drops' Weber numbers of some hundreds. Rarer and finer droplets go higher.)
RG_CONST float kSplashThrow = 3.0f;
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

// Drops of a sort are those of which so many are smaller, of all: few are large.
RG_FN vec2 splashSort(uint sort) {
  return vec2(sort == 0u ? 0.0f : sort == 1u ? 13.0f : sort == 2u ? 22.0f : 29.0f, sort == 0u ? 13.0f : sort == 1u ? 22.0f : sort == 2u ? 29.0f : 32.0f) *
         (1.0f / 32.0f);
}

// Of a level the ranks are those between 1/4 and 1 of the level's own; the last has all that is left.
RG_FN vec2 splashRanks(uint level) {
  float most = 1.0f / float(1u << (2u * level));
  return vec2(level + 1u == kSplashLevels ? 0.0f : 0.25f * most, most);
}

// What drops throw up grows steeply with their size: beside one of 2 mm.
RG_CONST float kSplashMostShare = 3.0f;
RG_FN float splashSizeShare(float diameter_m) {
  float by_2mm = 500.0f * diameter_m;
  return min(by_2mm * by_2mm * by_2mm, kSplashMostShare);
}

// How often a splash counts at a distance from the eye. As many are drawn as p = (kSplashAll_m / distance)^2 says, of larger ones more and of smaller
// ones fewer as they throw up more or less, each 1 / p times, those of the highest ranks half faded: the mean over all ranks is 1 everywhere, for
// every size.
RG_FN float splashTimes(float rank, float distance_m, float diameter_m) {
  float p = kSplashAll_m / max(distance_m, 1.0e-3f);
  p *= p * splashSizeShare(diameter_m);
  float x = rank / p, last = 1.0f / p;
  float shown = clamp(2.0f * (1.25f - x), 0.0f, 1.0f);
  float rest = max(1.25f - last, 0.0f);
  float mean = last <= 0.75f ? last : 1.0f - rest * rest;
  return shown / (p * mean);
}
// Beyond this, of a level's ranks none is drawn whose drop is no larger.
RG_FN float splashReach_m(uint level, float diameter_m) {
  float least = splashRanks(level).x;
  return least > 0.0f ? kSplashAll_m * sqrt(1.25f * splashSizeShare(diameter_m) / least) : 1.0e9f;
}

#if defined(__cplusplus) || defined(SPLASH_RAIN_BINDING)
RG_FN Splash splashOf(RG_IN(SplashJob) job, uint index RG_SPLASH_RAIN) {
  uvec4 a = pcg4d(uvec4(job.x, job.y, job.epoch, job.level * 2654435769u + index)), b = pcg4d(a);
  uint lattice = job.level >> 2u & 1u;
  vec2 ranks = splashRanks(job.level & 3u), sort = splashSort(job.level >> 3u & 3u);
  Splash s;
  s.diameter_m = splashSize_m(mix(sort.x, sort.y, unitFloat(a.z)) RG_SPLASH_RAIN_PASS);
  s.place_m = xyz(job.corner) + job.corner.w * vec3(unitFloat(a.x), unitFloat(a.y), 0.0f);
  vec4 drift = splash_rain.drift[lattice];
  s.velocity_mps = vec3(drift.x, drift.y, min(drift.z - splashFallSpeed(1.0e3f * s.diameter_m), -kSplashLeastFall_mps));
  s.age_s = job.since_s - kSplashEpoch_s * unitFloat(a.w);
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
// volumes' faces: as exactly as the place is known, `skin_m`, it is taken higher.
RG_CONST float kSplashPath_m = 60.0f;  // as much of a line as volumes near the eye can lie on
RG_FN bool splashIsSheltered(vec3 place, vec3 velocity_mps, vec3 ground_mps, float age_s, float skin_m RG_RAIN_SHELTER) {
  for (uint i = 0u; i < rain_shelter.volume_count; ++i) {
    vec3 body_mps = xyz(rain_shelter.volumes[i].velocity);
    vec3 then = place + vec3(0.0f, 0.0f, skin_m) + (body_mps - ground_mps) * age_s, way = velocity_mps + ground_mps - body_mps;
    if (!rainMayTouch(i, then, way, -kSplashPath_m / length(way), 0.0f, 0.0f RG_RAIN_SHELTER_PASS)) continue;
    vec2 inside = rainTimesInside(i, then, way, 0.0f RG_RAIN_SHELTER_PASS);
    if (inside.x < inside.y && inside.x < 0.0f) return true;
  }
  return false;
}

// What a splash consists of, all about one circle: a crown, a thin wall of water that is there first, and the fine droplets that its rim breaks into
// and that fly on when it has sunk back.
struct SplashShape {
  float radius_m;
  float wall_m;       // height of the crown's wall,
  float wall;         // and the share of what is behind it that it hides, seen square on
  float low_m;        // the droplets fly between these heights
  float high_m;
  float droplets_m2;  // cross-section of all of them
};
// The crown rises and sinks within some 60 D / U, 15 to 25 ms (by eye: Cossali et al. 2004 follow crowns on thin films for a little less).
RG_CONST float kSplashCrown = 60.0f;
RG_CONST float kSplashWallHigh = 1.7f;  // drop diameters, by eye as well
// Clear water hides nothing: it mirrors some 4 % with each of its faces, more where it ripples and curves away (Fresnel; 0.066 is the mean).
RG_CONST float kSplashWall = 0.1f;
// Cross-section of all droplets beside the drop's: of one of 2 mm a fifth of its water in droplets of a seventh of its diameter, and of others as
// diameters' third power goes, up to thrice as much (by eye; that they grow so steeply from next to nothing at the threshold is what Okawa, Shiraishi &
// Mori 2006 measured, "Production of secondary drops during the single water drop impact onto a plane water surface", Exp. Fluids 41).
RG_CONST float kSplashDroplets = 1.4f;
RG_CONST float kSplashDroplet = 0.14f;  // a droplet's diameter by the drop's
RG_CONST float kSplashAside = 0.3f;     // how fast they go aside by how fast the fastest go up (by eye: jets stand steep)
RG_CONST float kSplashSlowest = 0.35f;  // droplets' speeds upward lie evenly between so much of the fastest's and that (by eye)

RG_FN float splashFlown_m(float up_mps, float age_s) { return max(0.0f, up_mps * age_s - 0.5f * kRainGravity_mps2 * age_s * age_s); }

RG_FN SplashShape splashShape(float diameter_m, float age_s) {
  SplashShape shape;
  float fastest_mps = splashThrow_mps(diameter_m);
  float x = min(1.0f, age_s * splashFallSpeed(1.0e3f * diameter_m) / (kSplashCrown * diameter_m));
  shape.radius_m = diameter_m + kSplashAside * fastest_mps * age_s;
  shape.wall_m = kSplashWallHigh * min(diameter_m, kSplashLargest_m) * 4.0f * x * (1.0f - x);
  shape.wall = kSplashWall * (1.0f - x);
  // Those that are down again are gone.
  float still_mps = max(kSplashSlowest * fastest_mps, 0.5f * kRainGravity_mps2 * age_s);
  shape.low_m = splashFlown_m(still_mps, age_s);
  shape.high_m = splashFlown_m(fastest_mps, age_s) + kSplashDroplet * diameter_m;
  float flying = clamp((fastest_mps - still_mps) / ((1.0f - kSplashSlowest) * fastest_mps), 0.0f, 1.0f);
  shape.droplets_m2 = kSplashDroplets * splashSizeShare(diameter_m) * 0.785398f * diameter_m * diameter_m * x * flying;
  return shape;
}

// What of a pixel's width about `at` lies between two places; summed over pixels it is all that lies between them.
RG_FN float splashWithin(float at, float pixel_half, float from, float to) {
  return max(0.0f, min(at + pixel_half, to) - max(at - pixel_half, from));
}

// A shape on the picture, px. Its parts lie on a circle seen from an elevation of that sine, which makes an ellipse.
struct SplashDrawn {
  float radius;
  float sine;
  float wall_height;
  float wall;  // what of a pixel it covers
  float low;
  float high;
  float droplets;  // what of a pixel within their band they cover, of one side of the circle
};
// The same at another size: it covers as much in all.
RG_FN SplashDrawn splashScaled(RG_IN(SplashDrawn) drawn, float by) {
  SplashDrawn scaled;
  scaled.radius = drawn.radius * by;
  scaled.sine = drawn.sine;
  scaled.wall_height = drawn.wall_height * by;
  scaled.wall = drawn.wall / (by * by);
  scaled.low = drawn.low * by;
  scaled.high = drawn.high * by;
  scaled.droplets = drawn.droplets / (by * by);
  return scaled;
}

// One that counts often is spread until it hides no more than this of the pixels about it, as those would that it stands for (by eye).
RG_CONST float kSplashDensest = 0.16f;
RG_FN SplashDrawn splashDrawn(RG_IN(SplashShape) shape, float px_per_m, float sine, float times) {
  SplashDrawn drawn;
  float upright = px_per_m * sqrt(max(0.0f, 1.0f - sine * sine));
  drawn.radius = shape.radius_m * px_per_m;
  drawn.sine = sine;
  drawn.wall_height = shape.wall_m * upright;
  drawn.wall = shape.wall * times;
  drawn.low = shape.low_m * upright;
  drawn.high = max(shape.high_m * upright, drawn.low + 0.5f * sine * drawn.radius) + 1.0e-3f;
  float covered = times * shape.droplets_m2 * px_per_m * px_per_m, wide = 2.0f * drawn.radius, high = drawn.high + sine * drawn.radius;
  drawn.droplets = covered / (3.1415927f * wide * (drawn.high - drawn.low));
  // (1 + wide by) (1 + high by) pixels.
  float half_sum = 0.5f * (wide + high), product = wide * high, missing = covered / kSplashDensest - 1.0f;
  float by = missing > 0.0f ? (sqrt(half_sum * half_sum + product * missing) - half_sum) / product : 1.0f;
  return splashScaled(drawn, max(by, 1.0f));
}

// Of the droplets on one side of a disk, those between its left rim and where the angle about its middle has that sine: pi in all, ever fewer towards
// the rim. The integral of 8/3 cos^4 of the angle.
RG_FN float splashLeftOf(float sine, float angle) {
  float twice = 2.0f * sine * sqrt(1.0f - sine * sine), cos_twice = 1.0f - 2.0f * sine * sine;
  return angle + twice * (2.0f / 3.0f + cos_twice / 6.0f);
}

// What of a band of droplets lies in a pixel's row: most at a third of its height, ever fewer towards its ends, 12 h (1 - h)^2.
RG_FN float splashBelow(float h) { return h * h * (6.0f - 8.0f * h + 3.0f * h * h); }
RG_FN float splashBand(float at, float pixel_half, float low, float high) {
  float per = 1.0f / (high - low);
  return splashBelow(clamp((at + pixel_half - low) * per, 0.0f, 1.0f)) - splashBelow(clamp((at - pixel_half - low) * per, 0.0f, 1.0f));
}

// What it covers of a pixel at `at` from its foot, px, x across and y up. The picture's sum is the same at any size and place: the circle by its arc in
// a pixel's column, and what stands on it by its height in the pixel's row. Droplets fly within the circle, each side's as far off as half of them, and
// blur while a picture is exposed: a puff without edges.
RG_FN float splashCover(vec2 at, float pixel_half, RG_IN(SplashDrawn) s) {
  float from = clamp((at.x - pixel_half) / s.radius, -1.0f, 1.0f), to = clamp((at.x + pixel_half) / s.radius, -1.0f, 1.0f);
  float angle_from = asin(from), angle_to = asin(to), arc = angle_to - angle_from;
  float middle = clamp(at.x / s.radius, -1.0f, 1.0f), away = s.radius * s.sine * sqrt(1.0f - middle * middle);
  float walls = splashWithin(at.y + away, pixel_half, 0.0f, s.wall_height) + splashWithin(at.y - away, pixel_half, 0.0f, s.wall_height);
  float strewn = splashLeftOf(to, angle_to) - splashLeftOf(from, angle_from);
  float droplets = strewn * (splashBand(at.y + 0.5f * away, pixel_half, s.low, s.high) + splashBand(at.y - 0.5f * away, pixel_half, s.low, s.high));
  return s.radius * (s.wall * arc * walls + s.droplets * (s.high - s.low) * droplets) / (4.0f * pixel_half * pixel_half);
}

// Droplets are few: where a splash is many pixels wide, by chance there are more of them here and fewer there, 1 on the mean. They fly while a picture is
// exposed, and have no edges (by eye). `at`: as above, but to the picture's right where the picture stands on its head.
RG_CONST float kSplashSpeck_px = 2.5f;
RG_FN float splashSpeckAt(ivec2 corner, float seed) {
  float u = unitFloat(pcg(uint(corner.x) | uint(corner.y) << 10u | uint(seed) << 20u));
  return 0.4f + 2.4f * u * u * u;
}
RG_FN float splashSpeck(vec2 at, RG_IN(SplashDrawn) s, float seed) {
  vec2 place = at / kSplashSpeck_px + 512.0f, low = floor(place), f = place - low;
  ivec2 corner = ivec2(low);
  float below = mix(splashSpeckAt(corner, seed), splashSpeckAt(corner + ivec2(1, 0), seed), f.x);
  float above = mix(splashSpeckAt(corner + ivec2(0, 1), seed), splashSpeckAt(corner + ivec2(1, 1), seed), f.x);
  return mix(1.0f, mix(below, above, f.y), clamp(0.3f * s.radius - 0.3f, 0.0f, 1.0f));
}

// The sum of that over all pixels.
RG_FN float splashCoverSum(RG_IN(SplashDrawn) s) {
  return 2.0f * 3.1415927f * s.radius * (s.wall * s.wall_height + s.droplets * (s.high - s.low));
}

// What light a splash shows, of what `below` the horizon and `above` it send (radiances): its droplets gather what lies behind them as seen, 165
// degrees of it (0.94: what two faces let through), and mirror a little of all sides. `behind`: the sine of the elevation up to which they have
// something behind them that stands, as it looks like what is below; `towards`: that of the way they are seen, < 0 from above.
RG_FN float splashAbove(float towards, float behind) {
  float e = clamp(-towards, 0.0f, 1.0f), h = clamp(behind, 0.0f, 1.0f);
  float risen = e * sqrt(1.0f - h * h) + h * sqrt(1.0f - e * e);  // sine of the sum
  return e * e + h * h < 1.0f ? 0.94f * (0.5f - 0.5f * risen) : 0.0f;
}
RG_CONST float kSplashMirrored = 0.06f;
RG_FN vec3 splashLight(vec3 below, vec3 above, float towards, float behind) {
  float share = splashAbove(towards, behind) + 0.5f * kSplashMirrored;
  return below * (1.0f - share) + above * share;
}

// A splash as it is drawn: a point.
struct SplashPoint {
  vec4 place;  // xyz: of its middle, in clip space; w: its side, px
  vec4 a;      // xy: the foot, px on the target; halves: z up there; w: the depth that what hides it lies before, m
  vec4 b;      // px: radius, height of the wall, and of the droplets' band from and to
  vec4 c;      // what of a pixel the droplets cover (w); halves: x red and green, y blue and the elevation's sine, z what the wall covers and the splash's own number
};
RG_SIZE(SplashPoint, 64)

RG_SHARED_END
#endif
