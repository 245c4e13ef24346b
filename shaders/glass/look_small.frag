// A pixel of a drop of about a pixel: its mean light, by the share of the pixel that it covers.
#include "optics/near.glsl"
#include "optics/surroundings.glsl"

in vec2 place;
flat in vec4 light;

layout(location = 0) out vec4 color;

void main() {
  float from_middle = max(length(place), 1e-4);
  vec2 outline = place / from_middle;
  vec2 slope = vec2(dot(outline, dFdx(place)), dot(outline, dFdy(place)));
  float cover = clamp((1.0 - from_middle) * inversesqrt(max(dot(slope, slope), 1e-12)) + 0.5, 0.0, 1.0);
  float alpha = cover * abs(light.w) * (light.w < 0.0 ? 1.0 : 1.0 - nearness(behindGlass_m(1.0 / gl_FragCoord.w), 1.0));
  color = vec4(light.rgb * alpha, alpha);
}
