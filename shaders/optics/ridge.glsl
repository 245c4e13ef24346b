// The water that blades push before them, as a pixel of the pane sees it. Shape: shared/glass_wiper.glsl.
#ifndef RG_OPTICS_RIDGE_GLSL
#define RG_OPTICS_RIDGE_GLSL
#include "optics/look_frame.glsl"
#include "shared/glass_wiper.glsl"

layout(std430, binding = 3) readonly buffer Ridges { int ridge_pl[]; };

const float kBroadest_m = 0.06;   // no ridge is broader
const float kSeenRidge_um = 1.0;  // one that is lower is not looked at by parts of a pixel

// A roll of water evens out along itself much faster than a blade turns round, further than from piece to piece, which get their water unevenly (by
// eye): its cross section and how that changes along it are means of the pieces about a place, with weights (1 - u^2)^2 for so many either way.
const float kEvenPieces = 4.0;

// Cross section (m^2) at a place along the blade, in pieces, and how much it grows from there to the next.
vec2 ridgeArea(LookBlade blade, float along, float per_area) {
  int first = int(blade.along_first.w), middle = int(floor(along));
  vec3 sum = vec3(0.0);  // of water, of what it changes by, of weights
  for (int k = 1 - int(kEvenPieces); k <= int(kEvenPieces); ++k) {
    float u = (float(middle + k) - along) / kEvenPieces, rest = max(1.0 - u * u, 0.0);
    float volume = max(float(ridge_pl[first + clamp(middle + k, 0, kBladeSegments - 1)]), 0.0);
    sum += vec3(volume * rest * rest, volume * 4.0 * u * rest / kEvenPieces, rest * rest);
  }
  return sum.xy * (per_area / sum.z);
}

// The ridge before a pixel's blade.
struct SeenRidge {
  vec3 ahead, along;  // of its blade, unit
  float x_m;          // how far ahead the pixel's middle is
  float pixel_m;      // how much of that way the pixel spans
  float area_m2;      // 0: there is none
  float width_m;
  float along_slope;  // what its slope along the blade is in terms of 1 + q^2, see addRidge
};

// Within reach of several blades, as where they meet: of the last.
SeenRidge seenRidge(vec3 position_m, vec3 dx, vec3 dy) {
  SeenRidge seen = SeenRidge(vec3(0.0), vec3(0.0), 0.0, 1.0, 0.0, 1.0, 0.0);
  int of = -1;
  for (int k = 0; k < frame.blade_count; ++k) {
    vec3 d = position_m - frame.blades[k].middle_length.xyz, ahead = frame.blades[k].ahead.xyz;
    float x_m = dot(d, ahead), pixel_m = abs(dot(dx, ahead)) + abs(dot(dy, ahead)), s_m = dot(d, frame.blades[k].along_first.xyz);
    if (x_m > -0.5 * pixel_m && x_m < kBroadest_m && abs(s_m) < 0.5 * frame.blades[k].middle_length.w) of = k;
  }
  if (of < 0) return seen;
  LookBlade blade = frame.blades[of];
  vec3 d = position_m - blade.middle_length.xyz;
  float piece_m = blade.middle_length.w / float(kBladeSegments), s = dot(d, blade.along_first.xyz) / piece_m;
  vec2 area = ridgeArea(blade, s + 0.5 * float(kBladeSegments) - 0.5, frame.film_unit_m3 / piece_m);
  seen.ahead = blade.ahead.xyz;
  seen.along = blade.along_first.xyz;
  seen.x_m = dot(d, seen.ahead);
  seen.pixel_m = max(abs(dot(dx, seen.ahead)) + abs(dot(dy, seen.ahead)), 1e-6);
  seen.area_m2 = area.x;
  seen.width_m = max(ridgeWidth_m(area.x, frame.ridge_tan_contact), 1e-6);
  seen.along_slope = area.y / piece_m * (0.75 / seen.width_m);  // dh / dA where the contact angle rules
  return seen;
}

// Adds the ridge's slope (xyz, vehicle frame) and thickness in um to those of the film, so many pixels ahead of the pixel's middle.
vec4 withRidge(vec4 water, SeenRidge ridge, float ahead_px) {
  float x_m = ridge.x_m + ahead_px * ridge.pixel_m, q = x_m / ridge.width_m;
  if (ridge.area_m2 <= 0.0 || x_m < 0.0 || q >= 1.0) return water;
  vec3 slope = ridge.ahead * ridgeSlope(ridge.area_m2, ridge.width_m, x_m) + ridge.along * (ridge.along_slope * (1.0 + q * q));
  return water + vec4(slope, 1e6 * ridgeHeight_m(ridge.area_m2, ridge.width_m, x_m));
}

// A ridge is few pixels broad, and over these its surface turns by as much as half of the picture: one of them would meet a lamp here and none there.
// Into how many parts a pixel is cut to see it.
const int kRidgeParts = 8;
int ridgeParts(SeenRidge ridge) {
  const float kFine_px = 12.0;  // so broad a ridge's pixels need not be cut
  bool meets = ridge.x_m < ridge.width_m + 0.5 * ridge.pixel_m && 1.5e6 * ridge.area_m2 > kSeenRidge_um * ridge.width_m;
  return meets && ridge.width_m < kFine_px * ridge.pixel_m ? kRidgeParts : 1;
}
#endif
