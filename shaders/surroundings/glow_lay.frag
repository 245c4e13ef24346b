// The glow over the picture, which gives the light that makes it.
layout(binding = 3) uniform sampler2D glow;
layout(location = 0) uniform vec4 place_px;    // xy: the picture's corner; zw: what the glow's texture spans
layout(location = 1) uniform float share;      // of the light that goes astray
layout(location = 0) out vec4 colour;

const float kScale = 256.0;  // of glow_gather.frag

void main() { colour = vec4(kScale * textureLod(glow, (gl_FragCoord.xy - place_px.xy) / place_px.zw, 0.0).rgb, share); }
