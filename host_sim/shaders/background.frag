// The environment behind everything.
in vec2 v_at;
layout(location = 0) out vec4 out_colour;
layout(binding = 4) uniform samplerCube u_environment;
uniform mat4 u_rel_from_clip;
void main() {
  vec4 to = u_rel_from_clip * vec4(v_at, 1.0, 1.0);
  out_colour = vec4(textureLod(u_environment, to.xyz, 0.0).rgb * frame.air.z, 1.0);
}
