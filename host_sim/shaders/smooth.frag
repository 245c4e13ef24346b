// Edges smoothed along themselves: Lottes 2011, FXAA's short form. What is blended is radiance as a display compresses it, so that a lamp's edge is
// as smooth as a roof's: COMPRESS writes that, the other variant blends it and gives radiance back.
layout(location = 0) out vec4 out_colour;
layout(binding = 0) uniform sampler2D u_picture;  // linear filter
uniform float u_exposure;

float luma(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

#ifdef COMPRESS
void main() {
  vec4 c = texelFetch(u_picture, ivec2(gl_FragCoord.xy), 0);
  out_colour = vec4(c.rgb / (1.0 / u_exposure + luma(c.rgb)), c.a);
}
#else
uniform vec2 u_texel;  // 1 / size

const float kLeastContrast = 0.05;    // of the brightest nearby: weaker edges are not seen
const float kDarkest = 0.01;          // nor such in the dark
const float kLongestReach_px = 6.0;   // along a nearly level edge
const float kFlattest = 0.125;        // of the contrast: edges flatter than that are all alike

vec3 radiance(vec3 c) { return c / (u_exposure * max(1.0 - luma(c), 1e-4)); }
vec3 at(vec2 uv) { return textureLod(u_picture, uv, 0.0).rgb; }

void main() {
  vec2 uv = gl_FragCoord.xy * u_texel;
  vec4 here = texelFetch(u_picture, ivec2(gl_FragCoord.xy), 0);
  float middle = luma(here.rgb);
  // Each corner's look-up lies between four pixels and is their mean.
  float nw = luma(at(uv + vec2(-0.5, 0.5) * u_texel)), ne = luma(at(uv + vec2(0.5, 0.5) * u_texel));
  float sw = luma(at(uv + vec2(-0.5, -0.5) * u_texel)), se = luma(at(uv + vec2(0.5, -0.5) * u_texel));
  float least = min(middle, min(min(nw, ne), min(sw, se))), most = max(middle, max(max(nw, ne), max(sw, se)));
  if (most - least < max(kDarkest, kLeastContrast * most)) discard;
  vec2 along = vec2((nw + ne) - (sw + se), (nw + sw) - (ne + se));  // across the gradient
  // The flatter the edge, the further along it; measured in its own contrast, so that both its sides are treated alike.
  float steep = min(abs(along.x), abs(along.y)) + kFlattest * (most - least);
  vec2 reach = clamp(along / steep, -kLongestReach_px, kLongestReach_px) * u_texel;
  vec3 near = 0.5 * (at(uv - reach / 6.0) + at(uv + reach / 6.0));
  vec3 wide = 0.5 * near + 0.25 * (at(uv - 0.5 * reach) + at(uv + 0.5 * reach));
  float wide_luma = luma(wide);
  out_colour = vec4(radiance(wide_luma < least || wide_luma > most ? near : wide), here.a);
}
#endif
