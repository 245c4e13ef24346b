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
  uint soft_depth;   // 1: read the host's depth
  uint environment;  // levels of the cube map, 0: none
  uint srgb;
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

// What share of the exposure a drop covers a pixel, summed over the streak's width and length, in px^2: the disk it is seen as. (Garg & Nayar
// 2007: a pixel of the streak is covered for tau of T.)
RG_FN float rainCover(float diameter_px) { return 0.7853982f * diameter_px * diameter_px; }

// A streak's share of its mean cover across its width, s = -1..1: a rounded profile of mean 1.
RG_FN float rainAcross(float s) { return 1.5f * max(0.0f, 1.0f - s * s); }

// And along it, s = -1..1 over the whole exposure: soft ends, mean 1.
RG_FN float rainAlong(float s) { return (1.0f - smoothstep(0.6f, 1.0f, abs(s))) * 1.25f; }

// What a particle covers of the disk it is seen as. Aggregates of crystals are full of gaps: half (their area ratio is 0.3..0.6 in Heymsfield &
// Miloshevich 2003).
RG_FN float rainFilled(int is_of) { return is_of == kRainIsSnow || is_of == kRainIsMeltingSnow ? 0.5f : 1.0f; }

// How much of the light it shows is scattered alike to all sides, as ice and its air do; the rest it gathers from behind, as water does
// (unsourced for what is between).
RG_FN float rainWhite(int is_of) {
  if (is_of == kRainIsRain) return 0.0f;
  return is_of == kRainIsMeltingSnow ? 0.5f : is_of == kRainIsSnow ? 1.0f : 0.9f;
}

// A solid particle's share of its mean cover at a point of what it sweeps, along and across it -1..1; mean 1 (to 1 %). `squareness`: of the
// swept quad, its width by its length. Flakes are octagons with lumps by `lump_rad`, stones disks; both soft at their rim.
RG_FN float rainSolid(float along, float across, float squareness, bool is_flake, float lump_rad) {
  float ahead = max(abs(along) - (1.0f - squareness), 0.0f) / squareness, beside = abs(across);
  float rim = is_flake ? max(max(ahead, beside), (ahead + beside) * 0.7071068f) : sqrt(ahead * ahead + beside * beside);
  if (is_flake && squareness > 0.5f) rim *= 1.0f + 0.15f * cos(3.0f * atan(across, along) + lump_rad) * rim;
  float square = is_flake ? 0.476f : 0.452f;
  return (1.0f - smoothstep(0.5f, 1.0f, rim)) / (0.75f * (1.0f - squareness) + square * squareness);
}

// Henyey & Greenstein's phase function (1941), per steradian. Refraction sends most of a drop's light forward; 0.75 stands for it.
RG_FN float rainPhase(float cosine) {
  float g = 0.75f;
  float d = 1.0f + g * g - 2.0f * g * cosine;
  return (1.0f - g * g) / (12.5663706f * d * sqrt(d));
}

RG_SHARED_END
#endif
