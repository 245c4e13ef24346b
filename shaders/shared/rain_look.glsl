// How a streak looks: light, exposure and the view it is drawn into. One uniform block a draw.
#ifndef RG_SHARED_RAIN_LOOK_GLSL
#define RG_SHARED_RAIN_LOOK_GLSL
#include "shared/rain_drop.glsl"
RG_SHARED_BEGIN

RG_CONST uint kRainLamps = 16u;

struct RainLamp {
  vec4 place_inner;      // xyz: from the eye, world axes, m; w: cosine of the inner cone
  vec4 direction_outer;  // xyz: where it shines; w: cosine of the outer cone
  vec4 intensity;        // rgb: radiant intensity
};
RG_SIZE(RainLamp, 48)

struct RainLook {
  mat4 clipFromWorldAtEye;  // world axes, from the eye
  vec4 forward;             // xyz: where the view looks, world axes
  vec4 viewport;            // x, y, width, height, px
  vec4 focal;               // x, y: px a unit slope spans; z: gain; w: exposure factor
  vec4 sky;                 // mean radiance of the upper hemisphere
  vec4 ground;              // and of the lower
  vec4 sun_direction;
  vec4 sun_irradiance;
  vec4 depth_rows;  // clip z = x * eye z + y, clip w = z * eye z + w
  uint lamp_count;
  uint zero_to_one;
  uint environment;  // levels of the cube map, 0: none
  uint srgb;
  uint colour_behind;  // 1: the host's colour can be read
  uint spare0;
  uint spare1;
  uint spare2;
  RainLamp lamps[kRainLamps];
};

// Distance along the view of what a depth buffer holds, for any projection: perspective, reversed, infinite.
RG_FN float rainSceneDepth(float stored, vec4 depth_rows, uint zero_to_one) {
  float ndc = zero_to_one != 0u ? stored : 2.0f * stored - 1.0f;
  float below = ndc * depth_rows.z - depth_rows.x;
  float above = depth_rows.y - ndc * depth_rows.w;
  if (abs(below) * 1.0e7f <= abs(above)) return 1.0e7f;
  return abs(above / below);
}

// The other way: what clip space's z is of clip w there.
RG_FN float rainStoredDepth(float depth_m, vec4 depth_rows) {
  return (depth_rows.y - depth_rows.x * depth_m) / (depth_rows.w - depth_rows.z * depth_m);
}

// What a particle covers of the disk it is seen as. Aggregates of crystals are full of gaps: half (their area ratio is 0.3..0.6 in Heymsfield &
// Miloshevich 2003).
RG_FN float rainFilled(int is_of) { return is_of == kRainIsSnow || is_of == kRainIsMeltingSnow ? 0.5f : 1.0f; }

// How much of the light it shows is scattered alike to all sides, as ice and its air do; the rest it gathers from behind, as water does
// (unsourced for what is between).
RG_FN float rainWhite(int is_of) {
  if (is_of == kRainIsRain) return 0.0f;
  return is_of == kRainIsMeltingSnow ? 0.5f : is_of == kRainIsSnow ? 1.0f : 0.9f;
}

// Henyey & Greenstein's phase function (1941), per steradian. Refraction sends most of a drop's light forward; 0.75 stands for it.
RG_FN float rainPhase(float cosine) {
  float g = 0.75f;
  float d = 1.0f + g * g - 2.0f * g * cosine;
  return (1.0f - g * g) / (12.5663706f * d * sqrt(d));
}

RG_CONST float kRainLampSize_m = 0.1f;  // no drop is nearer to a lamp

// What part of a lamp's intensity goes a way (unit).
RG_FN float rainLampCone(RG_IN(RainLamp) lamp, vec3 way) {
  float outer = lamp.direction_outer.w;
  return outer <= -1.0f ? 1.0f : smoothstep(outer, max(lamp.place_inner.w, outer + 1.0e-3f), dot(way, xyz(lamp.direction_outer)));
}

// How much of a lamp's intensity drops show the eye (1 / (m^2 sr)): the mean over those that lie between two distances in the unit direction `towards`, and as
// far beside it as `wide_rad` tells apart. In steps of equal angle as the lamp sees them each counts alike, however near it is (Kulla & Fajardo 2012,
// "Importance Sampling Techniques for Path Tracing in Participating Media", Comput. Graph. Forum 31).
RG_FN float rainLampAlong(RG_IN(RainLamp) lamp, vec3 towards, float from_m, float to_m, float wide_rad) {
  const int kSteps = 8;
  vec3 place = xyz(lamp.place_inner);
  float nearest_m = dot(place, towards), wide_m = wide_rad * max(nearest_m, from_m);
  vec3 aside = place - nearest_m * towards;
  float apart_m = sqrt(dot(aside, aside) + wide_m * wide_m + kRainLampSize_m * kRainLampSize_m);
  float first = atan(from_m - nearest_m, apart_m), angle = (atan(to_m - nearest_m, apart_m) - first) / float(kSteps), lit = 0.0f;
  for (int k = 0; k < kSteps; ++k) {
    float at_m = nearest_m + apart_m * tan(first + (float(k) + 0.5f) * angle);
    vec3 way = at_m * towards - place;
    way = way / max(length(way), kRainLampSize_m);
    lit += rainLampCone(lamp, way) * rainPhase(-dot(way, towards));
  }
  return lit * angle / (apart_m * (to_m - from_m));
}

RG_SHARED_END
#endif
