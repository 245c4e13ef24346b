// The computed sky, and the ground below it, as a cube map.
in vec2 v_at;
layout(location = 0) out vec4 out_colour;
uniform float u_cover;        // clouds, 0 clear .. 1 overcast
uniform float u_zenith;       // radiance of an overcast zenith
uniform float u_day;          // a clear sky's light, relative to that at the usual height of the sun
uniform vec3 u_to_sun;
uniform vec3 u_ground;        // radiance of the ground

float hash(vec2 p) {
  vec3 q = fract(vec3(p.xyx) * 0.1031);
  q += dot(q, q.yzx + 33.33);
  return fract((q.x + q.y) * q.z);
}
float noise(vec2 p) {
  vec2 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
}
float cloud(vec2 p) {
  float sum = 0.0, weight = 0.5;
  for (int i = 0; i < 5; ++i) {
    sum += weight * noise(p);
    p = mat2(1.6, 1.2, -1.2, 1.6) * p + 7.3;
    weight *= 0.5;
  }
  return sum;
}

void main() {
  vec3 to = normalize(faceDirection(v_at));
  float height = max(to.z, 0.0);
  // CIE standard overcast sky (Moon & Spencer 1942): a third as bright at the horizon as at the zenith. The lower clouds' soft streaks
  // lie on a plane overhead and melt into the haze below 10 degrees.
  vec2 plane = to.xy / (height + 0.18) * 1.6;
  float streaks = cloud(plane + 0.6 * vec2(cloud(plane * 0.7 + 3.1), cloud(plane * 0.7 + 9.7)));
  float depth = mix(1.0, 0.62 + 0.76 * streaks, smoothstep(0.0, 0.25, height));
  vec3 overcast = u_zenith * (1.0 + 2.0 * height) / 3.0 * depth * vec3(0.95, 0.99, 1.06);
  // A band of brighter air above the horizon, as distant clear patches light it.
  overcast *= 1.0 + 0.25 * exp(-12.0 * height);
  float toward = max(dot(to, u_to_sun), 0.0);
  vec3 clear = mix(vec3(0.9, 1.9, 4.3), vec3(5.0, 5.9, 6.8), exp(-4.5 * height)) + vec3(9.0, 7.5, 5.0) * pow(toward, 24.0) +
               vec3(60.0, 52.0, 40.0) * pow(toward, 900.0);
  float fair = smoothstep(0.52, 0.75, streaks) * smoothstep(0.02, 0.2, height);
  clear = mix(clear, vec3(9.0, 9.0, 9.2), 0.8 * fair);
  vec3 sky = mix(u_day * clear, overcast, u_cover);
  // Ground, its far part the colour of the air.
  out_colour = vec4(mix(sky, u_ground, smoothstep(0.0, -0.12, to.z)), 1.0);
}
