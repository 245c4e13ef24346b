// Rain too far off to be told apart as drops: how much of it lies along a view ray, and where its pattern is. One uniform block a draw.
#ifndef RG_SHARED_RAIN_BEYOND_GLSL
#define RG_SHARED_RAIN_BEYOND_GLSL
#include "shared/compat.glsl"
RG_SHARED_BEGIN

RG_CONST uint kRainTileVolumes = 8u;   // the picture is drawn in square tiles, each knowing the nearest so many of the volumes it looks into
RG_CONST uint kRainTileFar = 5u;       // and of each so many planes that bound it far off
RG_CONST uint kRainTileNear = 3u;      // and near by: all that a box has
RG_CONST uint kRainNoPlane = 63u;
RG_CONST float kRainNoBound = 1.0e5f;  // 1 / m: nearer than anything seen

// Where layers end, m from the eye; beyond the last one rain is an even haze. By eye (unsourced): in each, the nearest rain is 2.5 times as
// large as the farthest.
RG_CONST float kRainNearEnd_m = 16.0f;
RG_CONST float kRainMiddleEnd_m = 40.0f;
RG_CONST float kRainFarEnd_m = 100.0f;
// Rain falls from clouds, whose base is this high over the eye (nimbostratus: from the ground to 2 km, WMO International Cloud Atlas; within that
// unsourced).
RG_CONST float kRainCloudBase_m = 1500.0f;

// Vectors are of world axes. In order near, middle, far, haze where four numbers stand for layers.
struct RainBeyond {
  vec4 ray_middle;  // the view ray through clip (x, y) is middle + x right + y up, as long as makes its depth 1
  vec4 ray_right;
  vec4 ray_up;
  vec4 axis;        // xyz: where drops come from, as the eye sees them move; unit
  vec4 axis_side;   // with axis_up across it: where the pattern's map begins
  vec4 axis_up;
  vec4 extinction;  // x: of the rain, 1/m; y: what particles take of it at the eye; z: the mean distance to which they do, m; w: share drawn
  vec4 bias;        // factors on the optical depth
  vec4 contrast;    // of the pattern by layer; w: the pattern's mean
  vec4 repeats;     // of the pattern round the axis, by layer; w: how much longer than wide it is drawn
  vec4 level;       // of the pattern's mips, by layer, where a pixel is a radian of the map
  vec4 scroll;      // of the pattern along the axis, by layer; w: side of a tile, px
};
RG_SIZE(RainBeyond, 192)

// A tile: its place, and of the volumes in it the planes that bound them there.
struct RainTile {
  uint place;  // column in the lower 16 bits, row in the upper
  uint farthest;  // bits of the scene's greatest depth there, m
  uint spare0;
  uint spare1;
  // Two words a volume; all 0: none. Planes are counted from the volume's first, 6 bits each.
  // Bit 31 set, 24: the volume, 18, 12, 6, 0: planes far off. Then 18, 12, 6: planes near by, 0: the fifth far off.
  uvec4 bounds[4];
};
RG_SIZE(RainTile, 80)

// Metres of open air along a ray by layer, and the share of what particles take that lies in it.
struct RainOpen {
  float near_m;
  float middle_m;
  float far_m;
  float haze_m;
  float taken;
};

// The share of what particles take in all that they take beyond a distance. The right total and the right start; between, the true law (a sum
// over all sizes, each to its own reach) is some per cent off. As exp(-s / mean), but without its cost.
RG_FN float rainTakenBeyond(float distance_m, float mean_m) {
  float left = max(0.0f, 1.0f - distance_m * (1.0f / (16.0f * mean_m)));
  left *= left;
  left *= left;
  left *= left;
  return left * left;
}

RG_FN void rainAddOpen(RG_INOUT(RainOpen) open, float from_m, float to_m, float mean_m) {
  float b = max(from_m, to_m);
  open.near_m += min(b, kRainNearEnd_m) - min(from_m, kRainNearEnd_m);
  open.middle_m += clamp(b, kRainNearEnd_m, kRainMiddleEnd_m) - clamp(from_m, kRainNearEnd_m, kRainMiddleEnd_m);
  open.far_m += clamp(b, kRainMiddleEnd_m, kRainFarEnd_m) - clamp(from_m, kRainMiddleEnd_m, kRainFarEnd_m);
  open.haze_m += max(b, kRainFarEnd_m) - max(from_m, kRainFarEnd_m);
  open.taken += rainTakenBeyond(from_m, mean_m) - rainTakenBeyond(b, mean_m);
}

// Optical depths of the layers. What particles take is taken from the near layer, all that it has at most.
RG_FN vec4 rainOpticalDepths(RainOpen open, vec4 extinction) {
  vec4 depths = extinction.x * vec4(open.near_m, open.middle_m, open.far_m, open.haze_m);
  depths.x = max(0.0f, depths.x - extinction.y * extinction.z * open.taken);
  return depths;
}

// Where a volume bounded by planes (in a plane dot(xyz, p from the eye) = w) is entered and left along a ray of unit depth, in 1 / depth:
// that is linear across the picture. A plane with the eye on its inner side bounds it far off (from below), one with the eye outside bounds it
// near by (from above).
RG_FN float rainPlaneBound(vec4 plane, vec3 ray) {
  float d = abs(plane.w) < 1.0e-4f ? (plane.w < 0.0f ? -1.0e-4f : 1.0e-4f) : plane.w;
  return dot(xyz(plane), ray) / d;
}

// A direction's place on the pattern's map about the axis, both in radians: Mercator's projection (1569), on which all that is equally far off and
// moves along the axis moves by the same amount, speed / distance. `direction` is (along the axis, to its side, up).
RG_FN vec2 rainMap(vec3 direction) {
  float along = clamp(direction.x / length(direction), -0.99999f, 0.99999f);
  return vec2(atan(direction.z, direction.y), 0.5f * log((1.0f - along) / (1.0f + along)));
}

RG_SHARED_END
#endif
