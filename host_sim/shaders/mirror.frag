// ... and what it shows, which was drawn for just these pixels.
layout(location = 0) out vec4 out_colour;
layout(binding = 0) uniform sampler2D u_shown;
uniform vec2 u_corner_px;
uniform vec2 u_texel;  // 1 / size of the texture
uniform float u_reflects;
void main() { out_colour = vec4(textureLod(u_shown, (gl_FragCoord.xy - u_corner_px) * u_texel, 0.0).rgb * u_reflects, 1.0); }
