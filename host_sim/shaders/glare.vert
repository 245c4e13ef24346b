// A lamp's bright glass: a disc that faces the eye, never smaller than a pixel can show, its light kept.
uniform vec4 u_place;  // xyz: from the eye, world axes; w: radius, m
uniform vec2 u_focal;  // pixels a unit slope spans
out vec2 v_px;         // from the disc's middle
flat out float v_radius_px;
flat out float v_share;  // of the disc's radiance, where it is drawn larger than it is
void main() {
  vec4 middle = frame.clip_from_rel * vec4(u_place.xyz, 1.0);
  float radius_px = u_place.w * u_focal.y / max(middle.w, 0.1);
  v_radius_px = max(radius_px, 1.0);
  v_share = radius_px * radius_px / (v_radius_px * v_radius_px + 0.0833);  // a disc whose edge fades over a pixel covers so much more
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  v_px = corner * (v_radius_px + 1.0);
  gl_Position = middle + vec4(2.0 * v_px * frame.screen.xy * middle.w, 0.0, 0.0);
}
