// A pixel of the pane: the picture behind it, bent by the film's surface; a bead, or the blur of those too small to be seen one by one.
#include "optics/bead.glsl"
#include "optics/bicubic.glsl"
#include "optics/near.glsl"
#ifdef SOFT
#include "optics/pupil.glsl"
#endif
#ifdef RIDGES
#include "optics/ridge.glsl"
#endif
#include "optics/surroundings.glsl"
#include "shared/glass_tile.glsl"
#include "shared/optics_drop.glsl"

layout(binding = 2) uniform sampler2D film;  // of look_water.frag

in PaneToPixel {
  vec3 from_eye;
  vec3 normal;
  vec2 uv;
} i;

layout(location = 0) out vec4 color;

const float kSteepest = 0.6;       // slopes beyond a film's contact angle belong to drops
const float kBehindGlass_m = 1.0;  // how far the cabin behind a pane is, for an eye outside

vec2 inPicture(vec3 direction_eye) {
  vec4 clip = frame.clip_from_eye * vec4(direction_eye, 0.0);
  return clip.xy / max(clip.w, 0.05) * 0.5 + 0.5;
}

// Past its border the picture goes on as in a mirror.
vec2 mirrored(vec2 at) { return abs(at - 2.0 * round(0.5 * at)); }

// How many of the picture's pixels a pixel spans that looks at it there.
float spanned_px(vec2 moved) {
  vec2 step_px = max(abs(dFdx(moved)), abs(dFdy(moved))) * frame.viewport.zw;
  return max(max(step_px.x, step_px.y), 1.0);
}

vec3 behind(vec2 moved, float spanned) { return decode(textureLod(picture, mirrored(moved), log2(spanned)).rgb); }

// Droplets are lenses of a few radii's focal length: each throws a view of its own, tens of degrees wide, into the pixel. What many of
// them show is the picture blurred, with lamps as halos.
vec3 throughDroplets(vec2 at) {
  float wide = log2(max(frame.blur * frame.pixels_per_rad, 1.0));
  return decode(textureLod(picture, mirrored(at), wide - 3.4).rgb);
}

// Outward normal of a bead's cap, a sphere that meets the glass at the contact angle. Directions of the grid from how the place moves along the
// picture: for a pixel they are as good as those of the pane's maps.
vec3 beadNormal(SeenBead bead, vec3 normal, vec2 dx, vec2 dy) {
  vec3 px = dFdx(i.from_eye), py = dFdy(i.from_eye);
  float turn = dx.x * dy.y - dx.y * dy.x < 0.0 ? -1.0 : 1.0;
  vec3 along_u = normalize(turn * (px * dy.y - py * dx.y)), along_v = normalize(turn * (py * dx.x - px * dy.x));
  vec2 tilt = bead.aside * (frame.bead_sine * min(1.0, 0.999 / max(length(bead.aside), 1e-3)));
  return normalize(normal * sqrt(max(1.0 - dot(tilt, tilt), 0.0)) + along_u * tilt.x + along_v * tilt.y);
}

// Through the glass and out of the cap; where the cap reflects all, on in the bead, by its base too, to leave by many ways about that direction. A pixel of a
// small bead sees both, each by its share.
vec3 throughBead(SeenBead bead, vec3 within, vec3 normal, vec3 cap) {
  const float kCritical = 0.6612;  // cosine: sqrt(1 - 1 / n^2)
  float turns = frame.bead_sine / bead.radius_px;  // how much the cap turns from pixel to pixel
  float cosine = dot(within, cap);
  float leaving = clamp((cosine - kCritical) / (0.75 * turns) + 0.5, 0.0, 1.0);
  // As refract(), grazing where nothing leaves.
  float straight = sqrt(max(1.0 - kWaterIndex * kWaterIndex * (1.0 - cosine * cosine), 0.0));
  vec3 out_direction = normalize(kWaterIndex * within + (straight - kWaterIndex * cosine) * cap);
  vec3 kept = reflect(within, cap);
  float to_base = -dot(kept, normal);
  float kept_share = to_base > 0.0 ? fresnel(to_base, 1.0 / kWaterIndex) : 1.0;
  vec3 kept_direction = to_base > 0.0 ? reflect(kept, normal) : kept;
  mat3 world_from_vehicle = mat3(frame.world_from_vehicle);
  vec3 outward = world_from_vehicle * normal;
  vec3 light = leaving * surroundingsOfGlass(world_from_vehicle * out_direction, outward, turns);
  return light + (1.0 - leaving) * mix(frame.cabin_share, 1.0, kept_share) * surroundingsOfGlass(world_from_vehicle * kept_direction, outward, 0.7);
}

#ifdef MIRROR
// Through the water, off the silver and out through the water again. Little bent, the picture shows it; further off it lies on the housing there,
// and the surroundings have to do.
vec3 mirroredThrough(vec3 view, vec3 normal, vec3 surface, float spread_rad, vec2 at) {
  const float kSure_rad = 0.01, kLost_rad = 0.03;
  vec3 within = refract(view, surface, 1.0 / kWaterIndex);
  vec3 leaving = refract(reflect(within, normal), -surface, kWaterIndex);
  if (dot(leaving, leaving) < 0.5) leaving = reflect(view, normal);
  vec3 as_if_through = reflect(leaving, normal);
  vec2 shift = inPicture(mat3(frame.eye_from_vehicle) * as_if_through) - inPicture(mat3(frame.eye_from_vehicle) * view);
  vec3 far = frame.mirror * surroundings(mat3(frame.world_from_vehicle) * leaving, spread_rad);
  return mix(behind(at + shift, spanned_px(at + shift)), far, smoothstep(kSure_rad, kLost_rad, length(as_if_through - view)));
}
#endif

// The film's slope, as far as it is water that is seen and not a drop's.
vec3 slopeOf(vec4 water) {
  return water.xyz * (min(1.0, kSteepest / max(length(water.xyz), 1e-9)) * smoothstep(kDry_um, 4.0 * kDry_um, water.w));
}

#ifdef INSIDE
// A view through the glass, as all of a pixel's parts have it.
struct View {
  vec2 at;  // in the picture
  vec3 direction, within, normal;
  float to_glass_m, behind_m;
};

// How much of a shift leads to what lies behind the glass. The picture also holds what stands before it or close to it, pillar, roof, frit, blade:
// there a bent view sees past them, and the picture does not know what. The half, the quarter of the shift serve for it, at last none.
float shareToBehind(View view, vec2 shift, float spanned) {
  mat3 eye_from_vehicle = mat3(frame.eye_from_vehicle);
  vec3 normal_eye = eye_from_vehicle * view.normal;
  float offset_m = dot(normal_eye, eye_from_vehicle * i.from_eye), least_m = min(0.5 * view.behind_m, kFarthestNear_m);
  vec2 beyond = shift * (1.5 * spanned / max(length(shift * frame.viewport.zw), 1.0));  // the picture is read between its pixels
  float share = 1.0;
  for (int k = 0; k < 3; ++k) {
    vec2 to = view.at + share * shift;
    // A blade may lie between both.
    float gap_m = min(behindGlassAt_m(mirrored(to), normal_eye, offset_m), behindGlassAt_m(mirrored(to + beyond), normal_eye, offset_m));
    if (gap_m >= least_m) break;
    share = k == 2 ? 0.0 : 0.5 * share;
  }
  return share;
}

// How the film's surface bends it: by how much of the picture, and what it reflects more than a flat one.
struct Bent { vec2 shift; float more; };

// A view bent at the glass misses what stands close behind it by less than what is far.
float leverOf(View view) { return view.behind_m / (view.behind_m + view.to_glass_m); }

Bent bentBy(vec4 water, View view) {
  vec3 surface = normalize(view.normal - slopeOf(water));
  vec3 transmitted = refract(view.within, -surface, kWaterIndex);
  if (dot(transmitted, transmitted) < 0.5) transmitted = view.direction;
  float flat_reflectance = fresnel(max(dot(view.within, view.normal), 0.0), 1.0 / kWaterIndex);
  float more = max(fresnel(max(dot(view.within, surface), 0.0), 1.0 / kWaterIndex) - flat_reflectance, 0.0);
  return Bent(leverOf(view) * (inPicture(mat3(frame.eye_from_vehicle) * transmitted) - view.at), more / (1.0 - flat_reflectance));
}

// What is shown so; `blurred`: the same through droplets.
vec3 shownBy(Bent bent, View view, float spanned, inout vec3 blurred) {
  float share = shareToBehind(view, bent.shift, spanned);
  vec2 shift = share * bent.shift;
  if (share < 1.0) spanned = 1.0;
  vec3 through_droplets = throughDroplets(view.at + shift);
  blurred += through_droplets;
  // What a steep surface reflects more than a flat one it takes from the view; it gives the cabin's light instead, here as dim as its share.
  return mix(behind(view.at + shift, spanned), frame.cabin_share * through_droplets, bent.more);
}

#ifdef SOFT
// Before an eye that looks past it the film lies elsewhere for each of its pupil's points; so many are asked, each by its own way through, and stand for
// all: what lies between their places in the picture is seen too, so that no lamp is seen eight times.
const int kPupilPoints = 8;
const float kBetween = 0.7;  // of how far they lie apart (by eye)
const float kFarthestPoint = 2.0;  // texels: no farther off than cells beside wet ones are drawn (kSoftReach of look_gl.cpp)

vec4 filmBeside(vec2 px) {
  vec2 uv = i.uv + px.x * dFdx(i.uv) + px.y * dFdy(i.uv);
#ifdef COARSE
  return textureBicubic(film, uv);
#else
  return textureLod(film, uv, 0.0);
#endif
}

// At least over the pixel itself, as a ridge may be narrower than that.
float pointsReach_px() {
  vec2 texels = vec2(textureSize(film, 0)), dx = dFdx(i.uv) * texels, dy = dFdy(i.uv) * texels;
  return clamp(pupilRadius_px(i.from_eye), 0.5, max(kFarthestPoint / max(max(length(dx), length(dy)), 1e-4), 0.5));
}

// Where it looks past the glass; at its own place where something stands close behind what it would look at.
vec2 pastWhatIsNear(View view, vec2 shift) {
  mat3 eye_from_vehicle = mat3(frame.eye_from_vehicle);
  vec3 normal_eye = eye_from_vehicle * view.normal;
  float least_m = min(0.5 * view.behind_m, kFarthestNear_m);
  bool free = behindGlassAt_m(mirrored(view.at + shift), normal_eye, dot(normal_eye, eye_from_vehicle * i.from_eye)) >= least_m;
  return view.at + (free ? shift : vec2(0.0));
}

vec3 throughFilmSoftly(View view) {
  float radius_px = pointsReach_px(), wet = 0.0, more = 0.0;
#ifdef RIDGES
  vec3 dx = dFdx(i.from_eye), dy = dFdy(i.from_eye);
  SeenRidge ridge = seenRidge(i.from_eye + frame.eye_in_vehicle.xyz, dx, dy);
  vec2 ahead_px = vec2(dot(dx, ridge.ahead), dot(dy, ridge.ahead)) / ridge.pixel_m;
#endif
  vec2 shifts[kPupilPoints], mean = vec2(0.0), square = vec2(0.0);
  for (int k = 0; k < kPupilPoints; ++k) {
    vec2 px = radius_px * placeOnDisc(k, kPupilPoints);
    vec4 water = filmBeside(px);
#ifdef RIDGES
    water = withRidge(water, ridge, dot(px, ahead_px));
#endif
    Bent bent = bentBy(water, view);
    shifts[k] = bent.shift;
    mean += bent.shift / float(kPupilPoints);
    square += bent.shift * bent.shift / float(kPupilPoints);
    more += bent.more / float(kPupilPoints);
    wet += float(water.w > kDry_um) / float(kPupilPoints);
  }
  vec2 apart_px = sqrt(max(square - mean * mean, 0.0)) * frame.viewport.zw;
  float spanned = max(kBetween * length(apart_px), 1.0), share = shareToBehind(view, mean, spanned);
  spanned = max(share * spanned, 1.0);
  vec3 light = vec3(0.0);
  for (int k = 0; k < kPupilPoints; ++k) light += behind(pastWhatIsNear(view, share * shifts[k]), spanned) / float(kPupilPoints);
  light = mix(light, frame.cabin_share * throughDroplets(view.at + share * mean), more);
  return mix(1.0, frame.brightness, wet) * light;
}
#elif defined(RIDGES)
// Small waves run along a roll that is pushed, faster than an eye follows: it sees the mean of what their slopes show, and so a lamp as a streak along
// the blade. How far that reaches (by eye: slopes of some 0.1 either way).
const float kWaves_rad = 0.06;

// Part by part, each as wide in the picture as the way to it from the last.
vec3 throughFilm(vec4 water, SeenRidge ridge, View view, out vec3 blurred) {
  int parts = ridgeParts(ridge);
  float part_px = parts > 1 ? 1.0 / float(parts) : 0.0;
  Bent last = bentBy(withRidge(water, ridge, parts > 1 ? -0.5 - 0.5 * part_px : 0.0), view);
  float spanned = spanned_px(view.at + last.shift);
  vec3 light = vec3(0.0);
  blurred = vec3(0.0);
  int part = 0;
  do {
    vec4 here = withRidge(water, ridge, (float(part) + 0.5) * part_px - (parts > 1 ? 0.5 : 0.0));
    Bent bent = bentBy(here, view);
    float waves_px = here.w > water.w ? max(kWaves_rad * leverOf(view) * frame.pixels_per_rad, 1.0) : 1.0;  // beside the roll there are none
    if (parts > 1) spanned = max(length((bent.shift - last.shift) * frame.viewport.zw), waves_px);
    light += shownBy(bent, view, spanned, blurred);
    last = bent;
  } while (++part < parts);
  blurred /= float(parts);
  return light / float(parts);
}
#else
vec3 throughFilm(vec4 water, View view, out vec3 blurred) {
  Bent bent = bentBy(water, view);
  blurred = vec3(0.0);
  return shownBy(bent, view, spanned_px(view.at + bent.shift), blurred);
}
#endif
#endif

#ifdef SOFT
void main() {
  float to_glass_m = length(i.from_eye);
  vec3 view = i.from_eye / to_glass_m, normal = normalize(i.normal);
  vec2 at = (gl_FragCoord.xy - frame.viewport.xy) / frame.viewport.zw;
  vec3 within = refract(view, -normal, 1.0 / kWaterIndex);
  color = vec4(encode(throughFilmSoftly(View(at, view, within, normal, to_glass_m, behindGlass_m(to_glass_m)))), 1.0);
}
#else
void main() {
#ifndef FILM
  vec4 water = vec4(0.0);
#elif defined(COARSE)  // many pixels to a texel
  vec4 water = textureBicubic(film, i.uv);
#else
  vec4 water = textureLod(film, i.uv, 0.0);
#endif
#ifdef RIDGES
  vec4 film_water = water;
  SeenRidge ridge = seenRidge(i.from_eye + frame.eye_in_vehicle.xyz, dFdx(i.from_eye), dFdy(i.from_eye));
  water = withRidge(film_water, ridge, 0.0);
#ifdef INSIDE
  bool ridged = ridgeParts(ridge) > 1;
#else
  const bool ridged = false;
#endif
#else
  const bool ridged = false;
#endif
  vec3 normal = normalize(i.normal);
  float to_glass_m = length(i.from_eye);
  vec3 view = i.from_eye / to_glass_m;
  vec2 place = i.uv * vec2(textureSize(beads, 0)), dx = dFdx(place), dy = dFdy(place);
#ifdef BEADS
  SeenBead bead = seenBead(place, dx, dy);
#else
  SeenBead bead = SeenBead(0.0, 0.0, vec2(0.0), 1.0);
#endif
  bool wet = water.w > kDry_um || ridged || bead.cover + bead.hazy > 0.0;
  vec3 slope = slopeOf(water);
  vec3 cap = beadNormal(bead, normal, dx, dy);
  vec3 surface = normalize(normal - slope);
  mat3 eye_from_vehicle = mat3(frame.eye_from_vehicle);
  vec2 at = (gl_FragCoord.xy - frame.viewport.xy) / frame.viewport.zw;
#ifdef INSIDE
  if (!wet) discard;
  // Through glass into water as if there were no glass (its faces are parallel), and out through the film's surface.
  vec3 within = refract(view, -normal, 1.0 / kWaterIndex);
  float behind_m = behindGlass_m(to_glass_m);
#ifdef FILM
  vec3 blurred;
  View whole = View(at, view, within, normal, to_glass_m, behind_m);
#ifdef RIDGES
  vec3 light = throughFilm(film_water, ridge, whole, blurred);
#else
  vec3 light = throughFilm(water, whole, blurred);
#endif
#else  // as if there were no water
  vec3 light = decode(texelFetch(picture, ivec2(gl_FragCoord.xy - frame.viewport.xy), 0).rgb);
  vec3 blurred = throughDroplets(at);
#endif
#ifdef BEADS
  float far = 1.0 - nearness(behind_m, dot(view, normal));
#ifdef APART
  float covered = 1.0 - (1.0 - bead.hazy * far) * (1.0 - bead.cover * far);
  vec3 shown = mix(blurred * (bead.hazy * far), throughBead(bead, within, normal, cap), bead.cover * far) / max(covered, 1e-4);
  color = vec4(encode(frame.brightness * shown) * covered, covered);
  return;
#endif
  light = mix(light, blurred, bead.hazy * far);
  light = mix(light, throughBead(bead, within, normal, cap), bead.cover * far);
#endif
  light *= frame.brightness;
#else
#ifdef MIRROR
  if (!wet) discard;
#else
  if (!wet && frame.dry_reflection == 0u) discard;
#endif
  surface = normalize(mix(surface, cap, bead.cover));
  slope = mix(slope, normal - cap, bead.cover);
#ifdef MIRROR
  float spread = 0.02 + 4.0 * length(fwidth(slope));
  vec3 light = frame.brightness * mix(mirroredThrough(view, normal, surface, spread, at), throughDroplets(at), bead.hazy);
  float reflectance = fresnel(max(-dot(view, surface), 0.02), kWaterIndex);
#else
  vec3 within = refract(view, surface, 1.0 / kWaterIndex);
  vec3 transmitted = refract(within, normal, kWaterIndex);
  if (dot(transmitted, transmitted) < 0.5) transmitted = view;
  float first = fresnel(max(-dot(view, surface), 0.02), wet ? kWaterIndex : kWindowIndex);
  float reflectance = first + (1.0 - first) * (1.0 - first) * fresnel(max(-dot(view, normal), 0.02), kWindowIndex);
  float lever = kBehindGlass_m / (kBehindGlass_m + to_glass_m);
  vec2 shift = lever * (inPicture(eye_from_vehicle * transmitted) - inPicture(eye_from_vehicle * view));
  vec3 light = frame.brightness * mix(behind(at + shift, spanned_px(at + shift)), throughDroplets(at + shift), bead.hazy);
#endif
  vec3 reflected = mat3(frame.world_from_vehicle) * reflect(view, surface);
  light = mix(light, surroundings(reflected, 0.02 + 4.0 * length(fwidth(slope))), reflectance);
#endif
  color = vec4(encode(light), 1.0);
}
#endif
