// The water of each texel of the grid made ready to be looked at: how thick the film stands and how its surface slopes, and its beads.
#include "optics/look_frame.glsl"
#include "optics/film_slope.glsl"
#include "shared/glass_beads.glsl"

layout(binding = 5) uniform usampler2D beads;

in OverTile {
  vec3 along_u, along_v;
  float pixel_m;
} i;

layout(location = 0) out vec4 slope_thickness;  // xyz: gradient of the thickness along the glass, vehicle frame; w: thickness, um
// x: number of beads; y, z: the mean one's radius in texels; w: share of the glass that is covered by them where they are too small to be seen one by one.
layout(location = 1) out vec4 lying_beads;

// Thickness in um by that of a unit of volume; past the pane's edge as at `inner_um`.
float thickness_um(ivec2 texel, float inner_um, float unit) {
  int volume = texelFetch(film, clamp(texel, ivec2(0), textureSize(film, 0) - 1), 0).r;
  return volume < 0 ? inner_um : float(volume) * unit;
}

vec4 filmAt(ivec2 texel, vec4 metric) {
  // Neighbours are as large as the texel itself to a thousandth: a pane bends little over a few millimetres.
  float unit = unit_um(metric);
  float middle = thickness_um(texel, 0.0, unit);
  // Values and slopes of the uniform cubic B-spline at its knots: weights 1 4 1 across, 1 0 -1 along (de Boor, A Practical Guide to Splines, IX).
  float sum = 0.0;
  vec2 rise = vec2(0.0);
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      float h = thickness_um(texel + ivec2(x, y), middle, unit);
      vec2 weight = vec2(x == 0 ? 4.0 : 1.0, y == 0 ? 4.0 : 1.0) / 6.0;
      sum += h * weight.x * weight.y;
      rise += h * 0.5 * vec2(float(x) * weight.y, float(y) * weight.x);
    }
  }
  vec2 slope = rise * 1e-6 / max(metric.xy, vec2(1e-6));
  return vec4(gradientOf(slope, metric, i.along_u, i.along_v), sum);
}

vec4 beadsAt(ivec2 texel, vec4 metric) {
  Beads lying = beadsOf(texelFetch(beads, min(texel, textureSize(beads, 0) - 1), 0).r);
  float radius_m = lying.number == 0 ? 0.0 : 1e-3 * beadRadius_mm(lying, frame.bead_mm3_per_unit);
  float whole = smoothstep(kHazy_px, kWhole_px, radius_m / i.pixel_m);
  float covered = min(float(lying.number) * 3.14159 * radius_m * radius_m / max(metric.w, 1e-12), 1.0);
  return vec4(float(lying.number), radius_m / max(metric.xy, vec2(1e-6)), covered * (1.0 - whole));
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec4 metric = texelFetch(pane_metric, texel, 0);
  slope_thickness = filmAt(texel, metric);
  lying_beads = beadsAt(texel, metric);
}
