// A latitude-longitude picture as a cube map.
in vec2 v_at;
layout(location = 0) out vec4 out_colour;
layout(binding = 0) uniform sampler2D u_picture;
void main() { out_colour = vec4(textureLod(u_picture, latLong(faceDirection(v_at)), 0.0).rgb, 1.0); }
