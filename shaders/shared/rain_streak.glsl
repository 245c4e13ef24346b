// Where a drop is, and the streak it draws during an exposure, clipped at shelters. In GLSL, declare `RainShelter rain_shelter` (a uniform
// block's) before including this.
#ifndef RG_SHARED_RAIN_STREAK_GLSL
#define RG_SHARED_RAIN_STREAK_GLSL
#include "shared/rain_drop.glsl"
RG_SHARED_BEGIN

RG_CONST float kRainNearest_m = 0.08f;  // along the view: what of a streak is nearer to the eye is not drawn

// A streak as seen from the eye, world axes: the drop's place, its velocity past the eye, and the times about the picture's between which
// the streak is drawn. from_s >= to_s: nothing is drawn.
struct RainStreak {
  vec3 drop_m;
  vec3 velocity_mps;
  float from_s;
  float to_s;
  float fade;  // 0 .. 1: towards the end of its reach drops dissolve into what lies beyond
};

// The shelter is a uniform block in shaders and a parameter in C++.
#ifdef __cplusplus
#define RG_RAIN_SHELTER , const RainShelter& rain_shelter
#define RG_RAIN_SHELTER_PASS , rain_shelter
#else
#define RG_RAIN_SHELTER
#define RG_RAIN_SHELTER_PASS
#endif

RG_FN uint rainClassOf(RainDrop drop) { return drop.fraction_z_class >> 16u; }

// From the eye, world axes.
RG_FN vec3 rainPlace(RainDrop drop, RainClass c) {
  vec3 cells = vec3(float(drop.cell_x - c.base.x), float(drop.cell_y - c.base.y), float(drop.cell_z - c.base.z));
  vec3 fraction = vec3(float(drop.fraction_xy & 0xffffu), float(drop.fraction_xy >> 16u), float(drop.fraction_z_class & 0xffffu));
  return xyz(c.corner_cell) + (cells + (fraction + 0.5f) * (1.0f / 65536.0f)) * c.corner_cell.w;
}

// The times at which a point that moves from `p` with `v` lies inside a convex volume: (enter, leave), enter > leave when never.
// Planes are moved out by `radius_m`, so that the drop as a whole stays outside. (Cyrus & Beck 1978.)
RG_FN vec2 rainTimesInside(uint volume, vec3 p, vec3 v, float radius_m RG_RAIN_SHELTER) {
  vec2 span = vec2(-1.0e9f, 1.0e9f);
  uint first = rain_shelter.volumes[volume].first;
  uint end = first + rain_shelter.volumes[volume].count;
  for (uint i = first; i < end; ++i) {
    vec4 plane = rain_shelter.planes[i];
    float outside = dot(xyz(plane), p) - plane.w - radius_m;
    float rate = dot(xyz(plane), v);
    if (abs(rate) < 1.0e-6f) {
      if (outside > 0.0f) return vec2(1.0f, -1.0f);
    } else if (rate > 0.0f) {
      span.y = min(span.y, -outside / rate);
    } else {
      span.x = max(span.x, -outside / rate);
    }
  }
  return span;
}

// Whether the streak can touch the volume's sphere at all.
RG_FN bool rainMayTouch(uint volume, vec3 p, vec3 v, float from_s, float to_s, float radius_m RG_RAIN_SHELTER) {
  vec3 to_centre = xyz(rain_shelter.volumes[volume].sphere) - p;
  float s = clamp(dot(to_centre, v) / max(dot(v, v), 1.0e-12f), from_s, to_s);
  vec3 miss = to_centre - v * s;
  float reach = rain_shelter.volumes[volume].sphere.w + radius_m + 0.01f;
  return dot(miss, miss) < reach * reach;
}

// sin(2 pi phase / 2^32) to 0.1 %, from sums and products alone, which every machine rounds alike: two parabolas, bent.
RG_FN float rainWave(uint phase) {
  float x = float(int(phase)) * (1.0f / 2147483648.0f);
  float y = 4.0f * x * (1.0f - abs(x));
  return y + 0.225f * (y * abs(y) - y);
}

// Flakes swing about their way on a level circle of 1.5 diameters, once to 2.9 times a second (unsourced), each in its own time and sense.
// `after_s`: from the picture's time.
RG_CONST float kRainSwing = 1.5f;
RG_FN vec3 rainSwing(RainDrop drop, RainView view, float after_s) {
  uint turn_per_unit = 34953u + (drop.id & 0xffffu);  // once a second is 2^32 / (120 * 1024) for each unit of `now`: whole turns wrap with it
  uint moment = view.now + uint(int(floor(after_s / view.tick_s * kRainEndUnits)));
  uint phase = drop.id * 2654435769u + moment * turn_per_unit;
  float side = (drop.id & 0x10000u) != 0u ? 1.0f : -1.0f;
  return kRainSwing * drop.diameter_m * vec3(rainWave(phase + 0x40000000u), side * rainWave(phase), 0.0f);
}

RG_CONST float kRainGravity_mps2 = 9.81f;

// How far from its place (rainPlace) a particle is `after_s` after the picture's time, world axes.
RG_FN vec3 rainMoved(RainDrop drop, RainClass c, RainView view, float after_s) {
  if (c.base.w == kRainIsBouncedHail) {
    float flown_s = float(int(view.now - drop.fraction_xy)) * (view.tick_s / kRainEndUnits) + after_s;
    return rainBounceVelocity(drop.id) * flown_s - vec3(0.0f, 0.0f, 0.5f * kRainGravity_mps2 * flown_s * flown_s);
  }
  vec3 moved = xyz(c.velocity_reach) * after_s;
  if (c.base.w == kRainIsSnow || c.base.w == kRainIsMeltingSnow) moved += rainSwing(drop, view, after_s);
  return moved;
}

// What a particle draws: the chord of its way through the exposure (of a drop the way itself), centred in the exposure, from where it
// bounced and to where it would enter a volume; a particle inside one draws nothing.
RG_FN RainStreak rainStreak(RainDrop drop, RainClass c, RainView view RG_RAIN_SHELTER) {
  RainStreak streak;
  vec3 eye_velocity = xyz(view.eye_velocity_exposure);
  float half_s = 0.5f * view.eye_velocity_exposure.w;
  float unit_s = view.tick_s / kRainEndUnits;
  float left_s = float(int(drop.end - view.now)) * unit_s;
  streak.drop_m = rainPlace(drop, c);
  streak.velocity_mps = xyz(c.velocity_reach) - eye_velocity;
  streak.from_s = -half_s;
  streak.to_s = min(half_s, left_s);
  streak.fade = 0.0f;
  if (left_s <= 0.0f || drop.diameter_m <= 0.0f) {
    streak.from_s = 1.0f;
    streak.to_s = -1.0f;
    return streak;
  }
  if (c.base.w != kRainIsRain && c.base.w != kRainIsHail) {
    if (c.base.w == kRainIsBouncedHail) streak.from_s = max(streak.from_s, float(int(drop.fraction_xy - view.now)) * unit_s);
    float span_s = max(streak.to_s - streak.from_s, 1.0e-6f);
    vec3 from_m = rainMoved(drop, c, view, streak.from_s);
    vec3 chord_mps = (rainMoved(drop, c, view, streak.from_s + span_s) - from_m) / span_s;
    streak.drop_m += from_m - chord_mps * streak.from_s;
    streak.velocity_mps = chord_mps - eye_velocity;
  }
  float reach_m = c.velocity_reach.w * min(drop.diameter_m, rainReachDiameter(c.base.w));
  streak.fade = 1.0f - smoothstep(0.6f * reach_m, reach_m, length(streak.drop_m));
  if (streak.fade <= 0.0f) {
    streak.from_s = 1.0f;
    streak.to_s = -1.0f;
    return streak;
  }
  for (uint i = 0u; i < rain_shelter.volume_count; ++i) {
    float radius_m = 0.5f * drop.diameter_m;
    if (!rainMayTouch(i, streak.drop_m, streak.velocity_mps, streak.from_s, streak.to_s, radius_m RG_RAIN_SHELTER_PASS)) continue;
    vec2 inside = rainTimesInside(i, streak.drop_m, streak.velocity_mps, radius_m RG_RAIN_SHELTER_PASS);
    if (inside.x >= inside.y) continue;
    if (inside.y <= 0.0f) {
      streak.from_s = max(streak.from_s, inside.y);
    } else if (inside.x >= 0.0f) {
      streak.to_s = min(streak.to_s, inside.x);
    } else {
      streak.from_s = 1.0f;
      streak.to_s = -1.0f;
      return streak;
    }
  }
  return streak;
}

RG_SHARED_END
#endif
