// How a film's surface slopes, from what its thickness does from texel to texel.
#ifndef RG_OPTICS_FILM_SLOPE_GLSL
#define RG_OPTICS_FILM_SLOPE_GLSL

layout(binding = 2) uniform isampler2D film;
layout(binding = 4) uniform sampler2D pane_metric;

// Thickness in um of a unit of volume.
float unit_um(vec4 metric) { return frame.film_unit_m3 * 1e6 / max(metric.w, 1e-12); }

// The gradient in the vehicle's frame: of a skewed frame, g . u = slope.x and g . v = slope.y.
vec3 gradientOf(vec2 slope, vec4 metric, vec3 along_u, vec3 along_v) {
  float skew = metric.z;
  vec2 g = vec2(slope.x - skew * slope.y, slope.y - skew * slope.x) / max(1.0 - skew * skew, 0.1);
  return along_u * g.x + along_v * g.y;
}
#endif
