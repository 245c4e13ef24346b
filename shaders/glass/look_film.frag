// The film's grid made ready to be looked at: how thick the water stands in each texel and how its surface slopes.
#include "optics/look_frame.glsl"
#include "optics/film_slope.glsl"

layout(location = 0) out vec4 slope_thickness;  // xyz: gradient of the thickness along the glass, vehicle frame; w: thickness, um

// Thickness in um by that of a unit of volume; past the pane's edge as at `inner_um`.
float thickness_um(ivec2 texel, float inner_um, float unit) {
  int volume = texelFetch(film, clamp(texel, ivec2(0), textureSize(film, 0) - 1), 0).r;
  return volume < 0 ? inner_um : float(volume) * unit;
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec4 metric = texelFetch(pane_metric, texel, 0);
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
  slope_thickness = vec4(gradientOf(slope, texel, metric), sum);
}
