// A car's mirror: its glass where it is.
uniform mat4 u_clip_from_host;
layout(location = 0) in vec3 position;
void main() {
  gl_Position = u_clip_from_host * vec4(position, 1.0);
  gl_Position.z *= 1.0005;  // before the car's own mesh, which is as far
}
