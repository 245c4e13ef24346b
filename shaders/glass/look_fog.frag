// A pixel of a pane that is fogged inside: droplets of condensed vapour, far below what the eye resolves, between the eye and all else. What they
// cover shows the picture blurred, as droplets of rain do (look_pane.frag), and some light of all that lies before the glass.
#include "optics/bicubic.glsl"
#include "optics/surroundings.glsl"

layout(binding = 2) uniform sampler2D fog;  // share covered, over the pane's grid

in PaneToPixel {
  vec3 from_eye;
  vec3 normal;
  vec2 uv;
} i;

layout(location = 0) out vec4 color;

const float kVeil = 0.25;  // of what droplets send to the eye comes from anywhere in front (unsourced)
const float kVeilWide_rad = 1.2;

// A mip's texels are large: the mean of five places hides their edges.
vec3 blurred(vec2 at, float lod) {
  vec2 reach = 0.4 * exp2(lod) / frame.viewport.zw;
  vec3 sum = textureLod(picture, at, lod).rgb;
  for (int k = 0; k < 4; ++k) sum += textureLod(picture, at + reach * vec2(k % 2 == 0 ? -1.0 : 1.0, k < 2 ? -1.0 : 1.0), lod).rgb;
  return decode(0.2 * sum);
}

void main() {
  float covered = textureBicubic(fog, i.uv).r;
  if (covered < 0.004) discard;
  vec2 at = (gl_FragCoord.xy - frame.viewport.xy) / frame.viewport.zw;
  float lod = max(log2(max(frame.blur * frame.pixels_per_rad, 1.0)) - 3.4, 0.0);
  vec3 ahead = frame.brightness * surroundings(mat3(frame.world_from_vehicle) * normalize(i.normal), kVeilWide_rad);
  vec3 hazy = mix(blurred(at, lod), ahead, kVeil);
  color = vec4(encode(mix(decode(textureLod(picture, at, 0.0).rgb), hazy, covered)), 1.0);
}
