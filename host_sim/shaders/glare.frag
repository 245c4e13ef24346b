// See glare.vert.
in vec2 v_px;
flat in float v_radius_px;
flat in float v_share;
layout(location = 0) out vec4 out_colour;
uniform vec3 u_radiance;
void main() { out_colour = vec4(u_radiance * (v_share * clamp(v_radius_px + 0.5 - length(v_px), 0.0, 1.0)), 0.0); }
