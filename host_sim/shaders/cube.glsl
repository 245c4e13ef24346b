// Direction of a cube map's texel (OpenGL 4.5 core, table 8.19).
uniform int u_face;
vec3 faceDirection(vec2 at) {
  if (u_face == 0) return vec3(1.0, -at.y, -at.x);
  if (u_face == 1) return vec3(-1.0, -at.y, at.x);
  if (u_face == 2) return vec3(at.x, 1.0, at.y);
  if (u_face == 3) return vec3(at.x, -1.0, -at.y);
  if (u_face == 4) return vec3(at.x, -at.y, 1.0);
  return vec3(-at.x, -at.y, -1.0);
}
