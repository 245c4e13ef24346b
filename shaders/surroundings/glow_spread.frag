// A coarser level of the glow, over the share of the light that this level gets.
#include "optics/bicubic.glsl"

layout(binding = 3) uniform sampler2D coarser;  // its base level is the one to read
layout(location = 0) uniform vec2 shares;       // of the light there, of that which is here
layout(location = 0) out vec4 colour;

void main() {
  vec2 uv = gl_FragCoord.xy / (2.0 * vec2(textureSize(coarser, 0)));
  colour = vec4(shares.x * textureBicubic(coarser, uv).rgb, shares.y);
}
