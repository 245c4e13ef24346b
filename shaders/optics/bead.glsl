// The beads of a pane as a pixel sees them: at most one by itself, and how much those too small for that cover.
#ifndef RG_OPTICS_BEAD_GLSL
#define RG_OPTICS_BEAD_GLSL
#include "optics/look_frame.glsl"
#include "shared/glass_beads.glsl"

layout(binding = 3) uniform sampler2D beads;  // of look_beads.frag; empty where the pane has none

struct SeenBead {
  float cover;      // share of the pixel
  float hazy;       // share covered by unresolved ones
  vec2 aside;       // from the bead's middle in its radii, axes of the grid: the middle of what the pixel sees of it
  float radius_px;
};

// `dx`, `dy`: what of the grid the pixel spans, texels.
SeenBead seenBead(vec2 place, vec2 dx, vec2 dy) {
  vec2 bent = beadPlace(place);
  ivec2 size = textureSize(beads, 0), texel = clamp(ivec2(floor(bent)), ivec2(0), size - 1);
  vec4 here = texelFetch(beads, texel, 0);
  int number = int(here.x);
  vec2 in_texel = fract(bent);
  float mean = max(here.y, here.z);
  uint seat = uint(texel.y * size.x + texel.x);
  SeatedBead bead = seatedBead(seat, in_texel, number, mean);
  vec2 radius = max(here.yz * bead.size, vec2(1e-4));
  SeenBead seen;
  seen.aside = (in_texel - bead.middle) / radius;
  float from_middle = max(length(seen.aside), 1e-3);
  float disc_px2 = radius.x * radius.y / max(abs(dx.x * dy.y - dx.y * dy.x), 1e-6);  // its radius, squared
  // What fades over a pixel covers 1/12 of a square pixel's circle too much: pi (R^2 + 1/12) by integration.
  float seen_alone = smoothstep(kHazy_px, kWhole_px, sqrt(disc_px2)) * disc_px2 / (disc_px2 + 1.0 / 12.0);
  vec2 outline = seen.aside / (from_middle * radius);
  float per_px = max(length(vec2(dot(outline, dx), dot(outline, dy))), 1e-4);  // in radii
  seen.cover = bead.size > 0.0 ? clamp((1.0 - from_middle) / per_px + 0.5, 0.0, 1.0) * seen_alone : 0.0;
  seen.radius_px = 1.0 / per_px;
  float nearest = max(from_middle - 0.5 * per_px, -1.0), farthest = min(from_middle + 0.5 * per_px, 1.0);
  seen.aside *= 0.5 * (nearest + farthest) / from_middle;
  seen.hazy = textureLod(beads, place / vec2(size), 0.0).w;
  return seen;
}

#endif
