// Depth alone, to the last bit as scene.vert has it.
layout(location = 0) in vec3 in_position;
uniform mat4 u_rel_from_body;
invariant gl_Position;

void main() {
  vec4 position = u_rel_from_body * vec4(in_position, 1.0);
  gl_Position = frame.clip_from_rel * position;
}
