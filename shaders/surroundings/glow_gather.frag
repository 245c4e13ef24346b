// A picture half as large, for its glow: only what gives light, as much less as makes room for lamps in half floats, whatever the host's unit.
layout(binding = 3) uniform sampler2D picture;
layout(location = 0) uniform ivec4 place_px;  // xy: the viewport's corner; zw: its size
layout(location = 1) uniform ivec4 known_px;  // from xy up to zw there are pixels
layout(location = 0) out vec4 colour;

const float kScale = 1.0 / 256.0;  // undone in glow_lay.frag
const float kBrightest = 60000.0;  // half floats end at 65504

// A host's picture may hold what is no number, which would spread over all of it.
float light(float x) { return x > 0.0 ? min(x * kScale, kBrightest) : 0.0; }

vec3 lightAt(ivec2 px) {
  ivec2 at = place_px.xy + min(px, 2 * place_px.zw - 1 - px);  // mirrored beyond the picture
  if (any(lessThan(at, known_px.xy)) || any(greaterThanEqual(at, known_px.zw))) return vec3(0.0);
  vec3 there = texelFetch(picture, at, 0).rgb;
  return vec3(light(there.r), light(there.g), light(there.b));
}

void main() {
  ivec2 px = 2 * ivec2(gl_FragCoord.xy);
  colour = vec4(0.25 * (lightAt(px) + lightAt(px + ivec2(1, 0)) + lightAt(px + ivec2(0, 1)) + lightAt(px + ivec2(1, 1))), 1.0);
}
