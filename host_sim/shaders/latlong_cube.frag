// A latitude-longitude picture as a cube map: the world's +x in its middle column, +y left of it, up in row 0.
in vec2 v_at;
layout(location = 0) out vec4 out_colour;
layout(binding = 0) uniform sampler2D u_picture;
void main() {
  vec3 to = normalize(faceDirection(v_at));
  vec2 at = vec2(0.5 - atan(to.y, to.x) / 6.2831853, acos(clamp(to.z, -1.0, 1.0)) / 3.14159265);
  out_colour = vec4(textureLod(u_picture, at, 0.0).rgb, 1.0);
}
