// A corner of the square about a crater, in the film's picture.
#include "optics/look_frame.glsl"
#include "shared/glass_crater.glsl"

layout(std430, binding = 0) readonly buffer Craters { CraterRecord craters[]; };
layout(binding = 4) uniform sampler2D pane_metric;

out vec2 from_middle_m;  // real metres
flat out vec2 film_width_m;  // thickness that is left for its shape; width

void main() {
  CraterRecord crater = craters[gl_VertexID / 6];
  int at = gl_VertexID % 6;
  int corner = at < 3 ? at : 6 - at;
  float age_s = crater.age_s + frame.drop_age_s;
  film_width_m = vec2(crater.film_m * craterDepthLeft(crater, age_s), craterWidth_m(crater, age_s));
  vec2 uv = (crater.position_m + crater.velocity_mps * age_s) * frame.uv_per_m;
  vec2 uv_per_real_m = 1.0 / (textureLod(pane_metric, uv, 0.0).xy * vec2(textureSize(pane_metric, 0)));
  from_middle_m = kCraterReach * film_width_m.y * vec2((corner & 1) == 0 ? -1.0 : 1.0, (corner & 2) == 0 ? -1.0 : 1.0);
  gl_Position = vec4((uv + from_middle_m * uv_per_real_m) * 2.0 - 1.0, 0.0, 1.0);
}
