// A scene's vertex, to the eye's frame.
layout(location = 0) in vec3 in_position;
layout(location = 1) in vec3 in_normal;
layout(location = 2) in vec2 in_uv;
layout(location = 3) in vec4 in_colour;
layout(location = 4) in vec4 in_tangent;

uniform mat4 u_rel_from_body;

out vec3 v_position;
out vec3 v_normal;
out vec2 v_uv;
out vec4 v_colour;
#ifdef NORMAL_MAP
out vec4 v_tangent;
#endif

invariant gl_Position;

void main() {
  vec4 position = u_rel_from_body * vec4(in_position, 1.0);
  v_position = position.xyz;
  v_normal = mat3(u_rel_from_body) * in_normal;
  v_uv = in_uv;
  v_colour = in_colour;
#ifdef NORMAL_MAP
  v_tangent = vec4(mat3(u_rel_from_body) * in_tangent.xyz, in_tangent.w);
#endif
  gl_Position = frame.clip_from_rel * position;
}
