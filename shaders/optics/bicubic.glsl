// A grid seen as the smooth surface it stands for.
#ifndef RG_OPTICS_BICUBIC_GLSL
#define RG_OPTICS_BICUBIC_GLSL

// Uniform cubic B-spline through four bilinear look-ups: Sigg & Hadwiger (2005), "Fast Third-Order Texture Filtering", GPU Gems 2, chapter 20.
vec4 textureBicubic(sampler2D grid, vec2 uv) {
  vec2 size = vec2(textureSize(grid, 0));
  vec2 at = uv * size - 0.5;
  vec2 f = fract(at);
  vec2 knot = at - f + 0.5;
  vec2 f2 = f * f;
  vec2 f3 = f2 * f;
  vec2 w0 = (1.0 - f) * (1.0 - f) * (1.0 - f) / 6.0;
  vec2 w1 = (4.0 - 6.0 * f2 + 3.0 * f3) / 6.0;
  vec2 w3 = f3 / 6.0;
  vec2 w2 = 1.0 - w0 - w1 - w3;
  vec2 low = w0 + w1;
  vec2 a = (knot - 1.0 + w1 / low) / size;
  vec2 b = (knot + 1.0 + w3 / (1.0 - low)) / size;
  vec4 bottom = mix(textureLod(grid, b, 0.0), textureLod(grid, vec2(a.x, b.y), 0.0), low.x);
  vec4 top = mix(textureLod(grid, vec2(b.x, a.y), 0.0), textureLod(grid, a, 0.0), low.x);
  return mix(bottom, top, low.y);
}
#endif
