// A pixel of the pane: the picture behind it, bent by the film's surface, blurred by droplets too small to be seen one by one.
#include "optics/bicubic.glsl"
#include "optics/surroundings.glsl"
#include "shared/optics_drop.glsl"

layout(binding = 2) uniform sampler2D film;  // of look_film.frag; empty where the pane has none

in PaneToPixel {
  vec3 from_eye;
  vec3 normal;
  vec2 uv;
} i;

layout(location = 0) out vec4 color;

const float kDry_um = 0.15;        // what a wiper leaves counts as clean
const float kSteepest = 0.6;       // slopes beyond a film's contact angle belong to drops
const float kBehindGlass_m = 1.0;  // how far the cabin behind a pane is, for an eye outside

// A film too thin to stay whole beads up into droplets below what the eye resolves, until it is thick enough to flow together.
float beaded(float thickness_um) { return 0.55 * smoothstep(kDry_um, 6.0, thickness_um) * (1.0 - smoothstep(25.0, 90.0, thickness_um)); }

vec2 inPicture(vec3 direction_eye) {
  vec4 clip = frame.clip_from_eye * vec4(direction_eye, 0.0);
  return clip.xy / max(clip.w, 0.05) * 0.5 + 0.5;
}

// Droplets are lenses of a few radii's focal length: each throws a view of its own, tens of degrees wide, into the pixel. What many of
// them show is the picture blurred, lamps with a halo, and a veil of the whole scene.
vec3 throughDroplets(vec2 at) {
  float wide = log2(max(frame.blur * frame.pixels_per_rad, 1.0));
  return decode(0.5 * textureLod(picture, at, wide - 4.6).rgb + 0.5 * textureLod(picture, at, wide - 2.3).rgb);
}

// The picture behind the glass at its pixel moved by `shift`; past the picture's border what is known of the surroundings.
vec3 behind(vec2 at, vec2 shift, vec3 direction_world, float beads) {
  vec2 moved = at + shift;
  vec2 step_px = max(abs(dFdx(moved)), abs(dFdy(moved))) * frame.viewport.zw;
  float lod = max(log2(max(step_px.x, step_px.y)), 0.0);
  vec2 outside = max(max(-moved, moved - 1.0), 0.0);
  vec3 seen = decode(textureLod(picture, clamp(moved, 0.0, 1.0), lod).rgb);
  if (max(outside.x, outside.y) > 0.0) {
    seen = mix(seen, surroundings(direction_world, 2.0 / frame.pixels_per_rad), smoothstep(0.0, 0.05, max(outside.x, outside.y)));
  }
  return beads > 0.0 ? mix(seen, throughDroplets(moved), beads) : seen;
}

void main() {
  vec4 water = textureBicubic(film, i.uv);
  vec3 normal = normalize(i.normal);
  vec3 view = normalize(i.from_eye);
  bool from_dry = dot(view, normal) > 0.0;
  bool wet = water.w > kDry_um;
  if (!wet && (from_dry || frame.dry_reflection == 0u)) discard;

  float steep = length(water.xyz);
  vec3 slope = wet ? water.xyz * min(1.0, kSteepest / max(steep, 1e-9)) * smoothstep(kDry_um, 4.0 * kDry_um, water.w) : vec3(0.0);
  float beads = wet ? beaded(water.w) : 0.0;
  vec3 surface = normalize(normal - slope);
  mat3 eye_from_vehicle = mat3(frame.eye_from_vehicle);
  vec2 at = (gl_FragCoord.xy - frame.viewport.xy) / frame.viewport.zw;
  vec3 transmitted;
  vec3 reflected;
  float reflectance;
  float through = frame.brightness;
  vec2 shift;
  if (from_dry) {
    // Through glass into water as if there were no glass (its faces are parallel), and out through the film's surface.
    vec3 inside = refract(view, -normal, 1.0 / kWaterIndex);
    transmitted = refract(inside, -surface, kWaterIndex);
    if (dot(transmitted, transmitted) < 0.5) transmitted = view;
    reflected = reflect(inside, -surface);
    reflectance = fresnel(max(dot(inside, surface), 0.0), 1.0 / kWaterIndex);
    float flat_reflectance = fresnel(max(dot(inside, normal), 0.0), 1.0 / kWaterIndex);
    through *= (1.0 - reflectance) / (1.0 - flat_reflectance);
    reflectance = max(reflectance - flat_reflectance, 0.0);
    shift = inPicture(eye_from_vehicle * transmitted) - inPicture(eye_from_vehicle * view);
  } else {
    vec3 inside = refract(view, surface, 1.0 / kWaterIndex);
    transmitted = refract(inside, normal, kWaterIndex);
    if (dot(transmitted, transmitted) < 0.5) transmitted = view;
    reflected = reflect(view, surface);
    float first = fresnel(max(-dot(view, surface), 0.02), wet ? kWaterIndex : kWindowIndex);
    reflectance = first + (1.0 - first) * (1.0 - first) * fresnel(max(-dot(view, normal), 0.02), kWindowIndex);
    through *= 1.0 - reflectance;
    float nearness = kBehindGlass_m / (kBehindGlass_m + length(i.from_eye));
    shift = nearness * (inPicture(eye_from_vehicle * transmitted) - inPicture(eye_from_vehicle * view));
  }
  mat3 world_from_vehicle = mat3(frame.world_from_vehicle);
  vec3 light = through * behind(at, shift, world_from_vehicle * transmitted, beads);
  if (reflectance > 0.003) {
    light += reflectance * surroundingsOfGlass(world_from_vehicle * reflected, world_from_vehicle * normal, 0.02 + 4.0 * length(fwidth(slope)));
  }
  color = vec4(encode(light), 1.0);
}
