// The beads of each texel of the grid made ready to be looked at.
#include "optics/look_frame.glsl"
#include "shared/glass_beads.glsl"

layout(binding = 2) uniform usampler2D beads;
layout(binding = 3) uniform sampler2D pane_position;
layout(binding = 4) uniform sampler2D pane_metric;

// x: their number, and half the share in which each is seen by itself; y, z: the mean bead's radius in texels; w: share of the glass that is
// covered by those too small to be seen one by one.
layout(location = 0) out vec4 seen;

// Radius in pixels from which a bead is more and more seen by itself, and wholly.
const float kHazy_px = 0.35, kWhole_px = 0.8;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  Beads lying = beadsOf(texelFetch(beads, texel, 0).r);
  vec4 metric = texelFetch(pane_metric, texel, 0);
  float radius_m = lying.number == 0 ? 0.0 : 1e-3 * beadRadius_mm(lying, frame.bead_mm3_per_unit);
  float pixel_m = distance(texelFetch(pane_position, texel, 0).xyz, frame.eye_in_vehicle.xyz) / frame.pixels_per_rad;
  float whole = smoothstep(kHazy_px, kWhole_px, radius_m / pixel_m);
  float covered = min(float(lying.number) * 3.14159 * radius_m * radius_m / max(metric.w, 1e-12), 1.0);
  seen = vec4(float(lying.number) + 0.5 * whole, radius_m / max(metric.xy, vec2(1e-6)), covered * (1.0 - whole));
}
