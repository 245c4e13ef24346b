// A falling drop's record, and what is needed beside it to draw the drop: uniform blocks of streak.vert, filled by setUpStreaks.
#ifndef RG_SHARED_RAIN_DROP_GLSL
#define RG_SHARED_RAIN_DROP_GLSL
#include "shared/compat.glsl"
RG_SHARED_BEGIN

RG_CONST uint kRainClasses = 85u;  // 32 of rain by speed, 40 of snow, 6 of melting snow, 6 of hail, 1 of stones that bounced
// What a class is of: RainClass.base.w.
RG_CONST int kRainIsRain = 0;
RG_CONST int kRainIsSnow = 1;
RG_CONST int kRainIsMeltingSnow = 2;
RG_CONST int kRainIsHail = 3;
RG_CONST int kRainIsBouncedHail = 4;
RG_CONST uint kRainNearPlanes = 512u;  // 8 KiB: with the volumes, 3 KiB, it stays below the 16 KiB every driver gives a uniform block
RG_CONST uint kRainNearVolumes = 64u;
RG_CONST float kRainEndUnits = 1024.0f;  // steps of RainDrop.end in a tick: 8 us, 0.3 mm of path at 40 m/s

// A falling particle, drop, flake or stone. Written once, when the drop is born (again only when its end changes). Its place is kept as cell and fraction of its class's standing
// lattice: integers do not wear out however far the drop is from the origin, nor however long it rains.
struct RainDrop {
  int cell_x;
  int cell_y;
  int cell_z;
  uint fraction_xy;  // 16 bits each: 0.05 mm in the largest cells
  uint fraction_z_class;
  float diameter_m;  // across; 0: no drop in this slot
  uint end;          // when it dies in a shelter, in 1/1024 tick since the field's start, modulo 2^32; compare by difference
  uint id;
};
RG_SIZE(RainDrop, 32)
// A stone that bounced: its cell is where it hit, `fraction_xy` when, as `end` counts, and `id` how it left (rainBounceVelocity).

// How far particles are seen goes by their diameter up to this, and no further (unsourced: what their number costs).
RG_FN float rainReachDiameter(int is_of) {
  if (is_of == kRainIsRain) return 0.006f;
  return is_of == kRainIsSnow || is_of == kRainIsMeltingSnow ? 0.005f : 0.012f;
}

// The velocity packed in a bounced stone's id: 10 bits for each axis, in steps of 0.15 m/s.
RG_CONST float kRainBounceStep_mps = 0.15f;
RG_FN vec3 rainBounceVelocity(uint id) {
  return vec3(float(int(id & 1023u) - 512), float(int((id >> 10u) & 1023u) - 512), float(int((id >> 20u) & 1023u) - 512)) *
         kRainBounceStep_mps;
}

// A class's standing frame, as seen from the eye at the time of drawing.
struct RainClass {
  vec4 corner_cell;     // xyz: the corner of cell `base` from the eye, world axes, m; w: the cell's size, m
  vec4 velocity_reach;  // xyz: of the drops, world axes, m/s; w: how far a drop is seen per metre of its diameter (rainReachDiameter)
  ivec4 base;           // xyz: the eye's cell; w: what it is of
};
RG_SIZE(RainClass, 48)

// A convex volume near the eye: planes [first, first + count) of RainShelter.planes.
struct RainVolume {
  vec4 sphere;    // centre from the eye, radius
  vec4 velocity;  // xyz: of its body, m/s; w: 1 where it has one
  uint first;
  uint count;
  uint spare0;
  uint spare1;
};
RG_SIZE(RainVolume, 48)

struct RainShelter {
  vec4 planes[kRainNearPlanes];  // inside where dot(xyz, p from the eye) <= w
  RainVolume volumes[kRainNearVolumes];
  uint volume_count;
  uint spare0;
  uint spare1;
  uint spare2;
};

struct RainView {
  vec4 eye_velocity_exposure;  // xyz: of the eye, m/s; w: exposure time, s
  uint now;                    // the picture's time as in RainDrop.end
  float tick_s;
  uint spare0;
  uint spare1;
};
RG_SIZE(RainView, 32)

RG_SHARED_END
#endif
