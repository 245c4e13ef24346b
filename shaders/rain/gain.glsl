// How much stronger than in nature a streak is drawn, by what it lies before.
#include "rain/streak.glsl"
layout(binding = 2) uniform sampler2D scene_colour;

const float kDarkBehind = 0.25;  // brightness beside the drop's at which some 60 % of the gain is left (unsourced)
const int kLooksBehind = 4;

float luminance(vec3 c) {
  if (look.srgb != 0u) c = pow(max(c, 0.0), vec3(2.2));
  return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

// How bright, beside the drop, is what lies behind its streak: of a few places along it, as the host has drawn them. Ends in px from the
// viewport's middle.
float brightnessBehind(vec2 from_px, vec2 to_px, vec3 drop_colour) {
  vec2 size_px = look.viewport.zw;
  float sum = 0.0;
  for (int i = 0; i < kLooksBehind; ++i) {
    vec2 p = mix(from_px, to_px, (float(i) + 0.5) / float(kLooksBehind)) + 0.5 * size_px;
    sum += luminance(texelFetch(scene_colour, ivec2(look.viewport.xy + clamp(p, vec2(0.0), size_px - 1.0)), 0).rgb);
  }
  return sum / float(kLooksBehind) / max(luminance(drop_colour), 1e-6);
}

// Eyes judge a difference by how bright what it lies before is (Weber): before the dark a streak is seen as it is in nature, before what is as
// bright as itself only with all of the gain.
float gainOf(vec2 from_px, vec2 to_px, vec3 drop_colour) {
  float most = look.focal.z;
  if (look.colour_behind == 0u || most <= 1.0) return most;
  float brightness = brightnessBehind(from_px, to_px, drop_colour);
  return mix(1.0, most, min(1.0, (1.0 + kDarkBehind) * brightness / (brightness + kDarkBehind)));
}
