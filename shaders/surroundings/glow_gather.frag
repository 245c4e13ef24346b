// A picture half as large, for its glow: only what gives light. Beside the picture it is dark.
layout(binding = 3) uniform sampler2D picture;
layout(location = 0) uniform ivec4 span_px;  // first and last pixel
layout(location = 0) out vec4 colour;

const float kBrightest = 60000.0;  // half floats end at 65504

// A host's picture may hold what is no number, which would spread over all of it.
float light(float x) { return x > 0.0 ? min(x, kBrightest) : 0.0; }

vec3 lightAt(ivec2 px) {
  if (any(greaterThan(px, span_px.zw))) return vec3(0.0);
  vec3 there = texelFetch(picture, px, 0).rgb;
  return vec3(light(there.r), light(there.g), light(there.b));
}

void main() {
  ivec2 px = span_px.xy + 2 * ivec2(gl_FragCoord.xy);
  colour = vec4(0.25 * (lightAt(px) + lightAt(px + ivec2(1, 0)) + lightAt(px + ivec2(0, 1)) + lightAt(px + ivec2(1, 1))), 1.0);
}
