// What a crater adds to the film's slope and thickness: each no more than the film has there by now.
#include "optics/look_frame.glsl"
#include "optics/film_slope.glsl"
#include "shared/glass_crater.glsl"

layout(binding = 3) uniform sampler2DArray pane_frame;

in vec2 from_middle_m;
flat in vec2 film_width_m;

layout(location = 0) out vec4 slope_thickness;  // as of look_film.frag

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec4 metric = texelFetch(pane_metric, texel, 0);
  float left_m = min(film_width_m.x, float(max(texelFetch(film, texel, 0).r, 0)) * unit_um(metric) * 1e-6);
  float width2_m2 = film_width_m.y * film_width_m.y;
  float q = 0.5 * dot(from_middle_m, from_middle_m) / width2_m2;
  vec2 slope = left_m * craterSlope(q) / width2_m2 * from_middle_m;
  slope_thickness = vec4(gradientOf(slope, metric, texelFetch(pane_frame, ivec3(texel, 0), 0).xyz, texelFetch(pane_frame, ivec3(texel, 1), 0).xyz), left_m * 1e6 * craterHeight(q));
}
