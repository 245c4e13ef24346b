// Depth towards the sun.
layout(location = 0) in vec3 in_position;
layout(location = 2) in vec2 in_uv;
uniform mat4 u_shadow_from_body;
out vec2 v_uv;
void main() {
  v_uv = in_uv;
  gl_Position = u_shadow_from_body * vec4(in_position, 1.0);
}
