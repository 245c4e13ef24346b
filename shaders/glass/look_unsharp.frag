// Drops on the glass as an eye sees them that looks past them: each of its pupil's points sees them elsewhere before the world, and the pixel is
// the mean of all. Their own light, of tens of degrees, hardly changes by that.
#include "optics/look_frame.glsl"
#include "optics/bicubic.glsl"

layout(binding = 2) uniform sampler2D drops;  // as the pupil's middle sees them: light by what they cover

in PaneToPixel {
  vec3 from_eye;
  vec3 normal;
  vec2 uv;
} i;

layout(location = 0) out vec4 color;

// A disc's standard deviation along an axis is half its radius; that of a texel 2^k px wide under a cubic B-spline 0.645 * 2^k px.
const float kTexelByRadius = 0.5 / 0.645;

void main() {
  float depth_m = -(mat3(frame.eye_from_vehicle) * i.from_eye).z;
  float radius_px = 0.5 * frame.pupil_m * frame.pixels_per_rad / max(depth_m, 1e-4);
  ivec2 size = textureSize(drops, 0);
  float level = clamp(log2(max(kTexelByRadius * radius_px, 1.0)), 0.0, log2(float(min(size.x, size.y))) - 2.0);
  int finer = int(level);
  vec2 at = gl_FragCoord.xy / vec2(size);
  vec4 blurred = mix(textureBicubic(drops, at, finer), textureBicubic(drops, at, finer + 1), level - float(finer));
  // A circle of confusion of less than two pixels is none.
  color = mix(texelFetch(drops, ivec2(gl_FragCoord.xy), 0), blurred, smoothstep(0.4, 1.3, radius_px));
}
