// What of a streak is handed to the rasteriser (by streak.comp), and how much of each pixel it covers.
//
// A drop covers what is behind it for the time tau that it takes to pass: I = (1 - tau/T) I_background + (tau/T) E_drop, T the exposure (Garg &
// Nayar 2007, "Vision and Rain", IJCV 75(1)). tau/T of a pixel is the integral over the exposure of the share of it that the drop's disk
// covers. Here it is a product: the disk's share within the pixel's width across the streak, times the shutter's share at the time when the
// drop passes. Summed over the pixels across a streak, whatever its direction and place on the grid, that is the whole disk: pictures of any
// size gain the same brightness.
#ifndef RG_SHARED_RAIN_DRAWN_GLSL
#define RG_SHARED_RAIN_DRAWN_GLSL
#include "shared/rain_drop.glsl"
RG_SHARED_BEGIN

// Slots are worked through in parts of so many, and a workgroup takes one part or several: each of its draw commands costs software GL's calling
// thread some 5 us.
RG_CONST uint kRainPart = 1024u;

// On software GL a streak is drawn as a line as long as one so wide covers it, else as a rectangle: a line takes half the vertices and setup. Where
// a thin line covers it, fewer pixels are worked out in vain.
RG_CONST float kRainThinLine_px = 2.0f;
RG_CONST float kRainLine_px = 4.0f;

// A corner of a streak. Two are a line: where it begins and where it ends. Four are a rectangle: both at its beginning, then both at its end. The
// first two tell what is the same for all of the streak, in as few numbers as can be: software GL sets up each for each streak.
struct RainCorner {
  vec4 place;  // in clip space
  vec4 a;      // of the first corner its streak_line, of the second its streak_look (streak_told.glsl)
};
RG_SIZE(RainCorner, 32)
// Beside it, in a buffer of its own, as it is rarely wanted: of the first corner where the streak begins (xy) and ends (zw), px from the viewport's
// middle; of the second the drop's slot (x), the ends' depths along the view, m (yz), and rainSolidCode (w).

RG_CONST uint kRainSlotCorners = 6u;  // room for each slot

// As glMultiDrawElementsIndirect reads it.
struct RainCommand {
  uint count;
  uint instances;
  uint first_index;
  uint base_vertex;
  uint base_instance;
};
RG_SIZE(RainCommand, 20)

// As glMultiDrawArraysIndirect reads it; a workgroup's two stand side by side: thin lines, other lines.
struct RainLineCommand {
  uint count;
  uint instances;
  uint first;
  uint base_instance;
};
RG_SIZE(RainLineCommand, 16)

// Softens the sides of what is narrower than a pixel, so that it does not step from column to column (unsourced).
RG_CONST float kRainSoft_px = 0.35f;

// The radius that a drop's disk of `radius_px` is drawn with.
RG_FN float rainSoftened(float radius_px) { return sqrt(radius_px * radius_px + kRainSoft_px * kRainSoft_px); }

// Half the width that a pixel has across a streak of the direction `along`. A box so wide holds, for every direction in whole numbers (p, q),
// p + q of the lines on which the grid's pixels lie, so that what falls on them adds up to
// the same at every offset.
RG_FN float rainPixelHalf(vec2 along) { return 0.5f * (abs(along.x) + abs(along.y)); }

// A streak's length with that of the drop itself (2.5 radii: a drop that rests covers its middle wholly) and of the pixels: one seen end on is a
// dot. 2.5 px: so far apart lie two sides of rainShutter that make pixels add up to the same at every offset.
RG_FN float rainLength(float way_px, float radius_px) { return sqrt(way_px * way_px + 6.25f * (radius_px * radius_px + 1.0f)); }

// Share of a disk that lies left of `s` radii from its middle: 1/2 + (s sqrt(1 - s^2) + asin s) / pi, to 0.005.
RG_FN float rainDiskLeftOf(float s) {
  float u = clamp(s, -1.0f, 1.0f);
  return 0.5f + u * (0.65281f - 0.15281f * u * u);
}

// Share of a disk that lies within a pixel's width, its middle `across_px` beside the pixel's.
RG_FN float rainWithin(float across_px, float pixel_half_px, float per_radius) {
  return rainDiskLeftOf((across_px + pixel_half_px) * per_radius) - rainDiskLeftOf((across_px - pixel_half_px) * per_radius);
}

// How far the shutter is open at a time -1 .. 1 of the exposure, its mean being 1. It closes softly (an eye, too, has no edge in time), which
// makes a streak's ends more transparent than its middle (0.6: unsourced).
RG_FN float rainShutter(float time) { return 1.25f * (1.0f - smoothstep(0.6f, 1.0f, abs(time))); }

// tau/T along a streak of so much of the exposure (2: all of it), over `length_px` as of rainLength; times rainWithin and rainShutter.
RG_FN float rainDwell(float radius_px, float times, float length_px, float pixel_half_px) {
  return 3.1415927f * radius_px * radius_px * times / (2.0f * length_px * 2.0f * pixel_half_px);
}

// The greatest tau/T, were pixels small, of a drop whose way over the whole exposure is `way_px` long.
RG_FN float rainDensest(float way_px, float radius_px) {
  return 2.56f * radius_px / sqrt(max(way_px * way_px + 6.25f * radius_px * radius_px, 1.0e-18f));
}

// Flakes and stones near the eye have a shape of their own: flakes are octagons with lumps, stones disks, both soft at their rim. 0: a drop;
// else 1 a flake, 2 a stone, and above the lowest two bits how its lumps lie.
RG_FN uint rainSolidCode(int is_of, uint id) {
  if (is_of == kRainIsRain) return 0u;
  return is_of == kRainIsSnow || is_of == kRainIsMeltingSnow ? 1u | (id & 0xffu) << 2u : 2u;
}

// What rainShutter and rainWithin say of drops, of a solid at a point along its length (-1..1) and across it (in radii): by its sharp shape where
// it is wide enough to be told, in pixels (1.5..3: unsourced). `squareness`: its width by its length.
RG_FN float rainSolid(float as_drop, float along, float across, float squareness, float pixel_half_px, float radius_px, uint solid) {
  float told = smoothstep(1.5f, 3.0f, radius_px);
  if (told <= 0.0f) return as_drop;
  bool is_flake = (solid & 3u) == 1u;
  float ahead = max(abs(along) - (1.0f - squareness), 0.0f) / squareness, beside = abs(across);
  float rim = is_flake ? max(max(ahead, beside), (ahead + beside) * 0.7071068f) : sqrt(ahead * ahead + beside * beside);
  if (is_flake && squareness > 0.5f) rim *= 1.0f + 0.15f * rim * cos(3.0f * atan(across, along) + float(solid >> 2u) * (6.2831853f / 256.0f));
  // Its mean over the rectangle, in closed form without the lumps, so that it covers as much as the drop would.
  float mean = 0.75f * (1.0f - squareness) + (is_flake ? 0.476f : 0.452f) * squareness;
  float shape = (1.0f - smoothstep(0.5f, 1.0f, rim)) * pixel_half_px / (mean * radius_px);
  return mix(as_drop, shape, told);
}

RG_SHARED_END
#endif
