// The water that blades push before them, as a pixel of the pane sees it. Shape: shared/glass_wiper.glsl.
#ifndef RG_OPTICS_RIDGE_GLSL
#define RG_OPTICS_RIDGE_GLSL
#include "optics/look_frame.glsl"
#include "shared/glass_wiper.glsl"

layout(std430, binding = 3) readonly buffer Ridges { int ridge_pl[]; };

const float kBroadest_m = 0.06;  // no ridge is broader

// Adds a ridge's slope (xyz, vehicle frame) and thickness in um to those of the film at a place of the pane.
void addRidge(LookBlade blade, vec3 position_m, inout vec4 water) {
  vec3 d = position_m - blade.middle_length.xyz;
  float x = dot(d, blade.ahead.xyz);
  float s = dot(d, blade.along_first.xyz);
  if (x < 0.0 || x > kBroadest_m || abs(s) >= 0.5 * blade.middle_length.w) return;
  float piece_m = blade.middle_length.w / float(kBladeSegments);
  float along = clamp((s / blade.middle_length.w + 0.5) * float(kBladeSegments) - 0.5, 0.0, float(kBladeSegments) - 1.001);
  int piece = int(blade.along_first.w) + int(along);
  vec2 area = max(vec2(ridge_pl[piece], ridge_pl[piece + 1]), 0.0) * (frame.film_unit_m3 / piece_m);  // between middles of pieces it is linear
  float area_m2 = mix(area.x, area.y, fract(along));
  float width_m = ridgeWidth_m(area_m2, frame.ridge_tan_contact);
  if (x >= width_m) return;
  float q = x / width_m;
  float along_slope = (area.y - area.x) / piece_m * (0.75 / width_m) * (1.0 + q * q);  // dh / dA where the contact angle rules
  water.xyz += blade.ahead.xyz * ridgeSlope(area_m2, width_m, x) + blade.along_first.xyz * along_slope;
  water.w += 1e6 * ridgeHeight_m(area_m2, width_m, x);
}

void addRidges(vec3 position_m, inout vec4 water) {
  for (int k = 0; k < frame.blade_count; ++k) addRidge(frame.blades[k], position_m, water);
}
#endif
