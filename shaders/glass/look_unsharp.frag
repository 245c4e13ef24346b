// Beads and drops on the glass as an eye sees them that looks past them: the mean of what its pupil's points see. Their own light, of tens of degrees,
// hardly changes by that.
#include "optics/pupil.glsl"

layout(binding = 2) uniform sampler2D drops;  // as the pupil's middle sees them: light by what they cover

in PaneToPixel {
  vec3 from_eye;
  vec3 normal;
  vec2 uv;
} i;

layout(location = 0) out vec4 color;

const int kPlaces = 24;
const float kTexel = 0.5;  // radii: each stands for somewhat more than its share, sqrt(pi / kPlaces), so that no gaps are seen

void main() {
  float radius_px = pupilRadius_px(i.from_eye);
  vec2 size = vec2(textureSize(drops, 0)), low = frame.viewport.xy + 0.5, high = frame.viewport.xy + frame.viewport.zw - 0.5;
  float level = max(log2(kTexel * radius_px), 0.0);
  vec4 sum = vec4(0.0);
  for (int k = 0; k < kPlaces; ++k) {
    vec2 at = clamp(gl_FragCoord.xy + radius_px * placeOnDisc(k, kPlaces), low, high);
    sum += textureLod(drops, at / size, level);
  }
  color = sum / float(kPlaces);
}
