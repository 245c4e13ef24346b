// Beads and drops on the glass as an eye sees them that looks past them: each of its pupil's points sees them elsewhere before the world, and the
// pixel is the mean of all. Their own light, of tens of degrees, hardly changes by that.
#include "optics/look_frame.glsl"

layout(binding = 2) uniform sampler2D drops;  // as the pupil's middle sees them: light by what they cover

in PaneToPixel {
  vec3 from_eye;
  vec3 normal;
  vec2 uv;
} i;

layout(location = 0) out vec4 color;

// Places all over a disc (Vogel 1979), each for somewhat more of it than its share, so that no gaps are seen.
const int kPlaces = 24;
const float kGolden_rad = 2.3999632;
const float kTexel = 0.5;  // radii; sqrt(pi / kPlaces) would be each one's share

void main() {
  float depth_m = -(mat3(frame.eye_from_vehicle) * i.from_eye).z;
  float radius_px = 0.5 * frame.pupil_m * frame.pixels_per_rad / max(depth_m, 1e-4);
  vec2 size = vec2(textureSize(drops, 0)), low = frame.viewport.xy + 0.5, high = frame.viewport.xy + frame.viewport.zw - 0.5;
  float level = max(log2(kTexel * radius_px), 0.0);
  vec4 sum = vec4(0.0);
  for (int k = 0; k < kPlaces; ++k) {
    float from_middle = radius_px * sqrt((float(k) + 0.5) / float(kPlaces)), turn = kGolden_rad * float(k);
    vec2 at = clamp(gl_FragCoord.xy + from_middle * vec2(cos(turn), sin(turn)), low, high);
    sum += textureLod(drops, at / size, level);
  }
  color = sum / float(kPlaces);
}
