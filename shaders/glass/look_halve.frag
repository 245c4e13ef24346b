// A mip level as the mean of what it covers, sides of odd length too. (Drivers' own skip rows there: a lamp of a pixel's size would come and go.)
layout(binding = 0) uniform sampler2D from;  // the level above alone
layout(location = 0) out vec4 color;

void main() {
  ivec2 size = textureSize(from, 0);
  vec2 step_px = vec2(size) / vec2(max(size / 2, ivec2(1)));
  vec2 low = (gl_FragCoord.xy - 0.5) * step_px;
  vec2 high = low + step_px;
  ivec2 first = ivec2(low + 1e-3);
  vec4 sum = vec4(0.0);
  for (int y = first.y; y <= first.y + 2; ++y) {
    for (int x = first.x; x <= first.x + 2; ++x) {
      vec2 share = max(min(high, vec2(x, y) + 1.0) - max(low, vec2(x, y)), 0.0) / step_px;
      sum += texelFetch(from, min(ivec2(x, y), size - 1), 0) * (share.x * share.y);
    }
  }
  color = sum;
}
