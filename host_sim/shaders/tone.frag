// Radiance to a display: exposure, a filmic curve, sRGB encoding.
layout(location = 0) out vec4 out_colour;
layout(binding = 0) uniform sampler2D u_picture;
uniform float u_exposure;
uniform int u_curve;

// Filmic curve fitted to the ACES reference transform (Hill 2016): matrices into and out of its working colours around a rational fit, so that
// bright colours run to white as on film.
vec3 filmic(vec3 c) {
  const mat3 into = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
  const mat3 outof = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
  c = into * c;
  c = (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081);
  return clamp(outof * c, 0.0, 1.0);
}
void main() {
  vec3 c = texelFetch(u_picture, ivec2(gl_FragCoord.xy), 0).rgb * u_exposure;
  c = u_curve == 1 ? filmic(c) : clamp(c, 0.0, 1.0);
  out_colour = vec4(mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c)), 1.0);
}
