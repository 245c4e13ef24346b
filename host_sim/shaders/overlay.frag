// The panel's letters and areas; colours are sRGB, as is the picture under them.
in vec2 v_uv;
in vec4 v_colour;
layout(location = 0) out vec4 out_colour;
layout(binding = 0) uniform sampler2D u_letters;

void main() { out_colour = vec4(v_colour.rgb, v_colour.a * texture(u_letters, v_uv).r); }
