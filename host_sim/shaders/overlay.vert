// The panel's triangles: pixels from the upper left corner.
layout(location = 0) in vec2 in_at_px;
layout(location = 1) in vec2 in_uv;
layout(location = 2) in vec4 in_colour;
out vec2 v_uv;
out vec4 v_colour;
uniform vec2 u_size_px;

void main() {
  v_uv = in_uv;
  v_colour = in_colour;
  gl_Position = vec4(in_at_px / u_size_px * vec2(2.0, -2.0) + vec2(-1.0, 1.0), 0.5, 1.0);
}
