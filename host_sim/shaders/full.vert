// One triangle over the whole viewport, at the far plane of reversed depth.
out vec2 v_at;
void main() {
  v_at = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(v_at, 0.0, 1.0);
}
