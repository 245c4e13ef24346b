// The environment as a surface of one roughness mirrors it: GGX samples around the mirror direction, view along the normal (Karis 2013).
in vec2 v_at;
layout(location = 0) out vec4 out_colour;
layout(binding = 4) uniform samplerCube u_source;
uniform float u_roughness;
uniform float u_source_lod;
void main() {
  vec3 n = normalize(faceDirection(v_at));
  vec3 side = normalize(cross(abs(n.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0), n));
  vec3 other = cross(n, side);
  float alpha = u_roughness * u_roughness;
  vec3 sum = vec3(0.0);
  float weight = 0.0;
  const int count = 32;
  for (int i = 0; i < count; ++i) {
    float u = (float(i) + 0.5) / float(count);
    float angle = 2.3999632 * float(i);
    float c = sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u));
    float s = sqrt(max(1.0 - c * c, 0.0));
    vec3 h = s * cos(angle) * side + s * sin(angle) * other + c * n;
    vec3 to = reflect(-n, h);
    float lit = dot(n, to);
    if (lit <= 0.0) continue;
    sum += lit * textureLod(u_source, to, u_source_lod).rgb;
    weight += lit;
  }
  out_colour = vec4(sum / max(weight, 1e-4), 1.0);
}
