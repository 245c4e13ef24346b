// Where each drop lies on the glass and how large a rectangle shows it to this eye: once for each, not for each of its corners.
#include "optics/drop_light.glsl"
#include "optics/look_frame.glsl"
#include "optics/seen_drop.glsl"
#include "shared/glass_types.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Drops { GlassDropRecord drops[]; };
layout(std430, binding = 1) readonly buffer Mesh { float mesh[]; };  // x, y, z, nx, ny, nz, u, v of each vertex
layout(std430, binding = 2) writeonly buffer Seen { SeenDrop seen[]; };
layout(std430, binding = 5) writeonly buffer Kinds { uint kinds[]; };
layout(binding = 2) uniform sampler2D pane_position;
layout(binding = 3) uniform sampler2DArray pane_frame;
layout(binding = 4) uniform sampler2D pane_metric;

struct Place {
  vec3 position_m;  // vehicle frame
  vec3 head;
  vec3 normal;
};

// +1 where cross(along u, along v) points out of the glass, -1 where the pane's uv are mirrored: as its first vertex tells.
float handedness() {
  vec3 outward = vec3(mesh[3], mesh[4], mesh[5]);
  vec2 uv = vec2(mesh[6], mesh[7]);
  vec3 across = cross(textureLod(pane_frame, vec3(uv, 0.0), 0.0).xyz, textureLod(pane_frame, vec3(uv, 1.0), 0.0).xyz);
  return dot(across, outward) < 0.0 ? -1.0 : 1.0;
}

Place placeOf(GlassDropRecord drop) {
  vec2 uv = (drop.position_m + drop.velocity_mps * frame.drop_age_s) * frame.uv_per_m;
  vec3 along_u = textureLod(pane_frame, vec3(uv, 0.0), 0.0).xyz;
  vec3 along_v = textureLod(pane_frame, vec3(uv, 1.0), 0.0).xyz;
  vec2 metric = textureLod(pane_metric, uv, 0.0).xy;
  Place place;
  place.position_m = textureLod(pane_position, uv, 0.0).xyz;
  place.normal = normalize(cross(along_u, along_v)) * handedness();
  vec3 head = along_u * (drop.heading.x * metric.x) + along_v * (drop.heading.y * metric.y);
  head -= place.normal * dot(head, place.normal);
  place.head = dot(head, head) > 0.0 ? normalize(head) : normalize(along_u);
  return place;
}

// Drops on wettable glass keep the ragged outline in which they met others; small ones and those on coated glass are round.
// Those that run have drawn it in.
float irregularityOf(GlassDropRecord drop) {
  if (drop.seed == 0u) return 0.0;
  float contact_angle_rad = 2.0 * atan(drop.height_m / drop.base_radius_m); // of a round cap as high over a base of this area
  return (1.0 - min(abs(drop.corner), 1.0)) * smoothstep(radians(85.0), radians(40.0), contact_angle_rad) * smoothstep(0.5e-3, 2.0e-3, drop.base_radius_m);
}

// How far the cap's shadow on the glass, cast along the view ray, reaches along (1, slope), the base reaching so far there: both where the head is
// a circle of radius 1. A cap's support function; the part of the sphere below the glass is left out.
float reach(Cap cap, float base, float slope) {
  float s = inversesqrt(base * base + slope * slope);
  return cap.centre_z + cap.radius * slope * s > 0.0 ? max(base, cap.centre_z * slope + cap.radius / s) : base;
}

// How far the base reaches along a unit vector; a tail is narrower than half an ellipse.
float baseReach(Cap cap, vec2 along) { return length(vec2(along.x < 0.0 ? along.x * cap.tail : along.x, along.y)); }

// Whether a sphere about a point may be in the picture.
bool inSight(vec4 clip, float radius_m) {
  vec2 margin = radius_m * abs(vec2(frame.clip_from_eye[0][0], frame.clip_from_eye[1][1]));
  return clip.w > -radius_m && all(lessThan(abs(clip.xy), abs(clip.w) + 1.5 * margin));
}

const float kSmall_px = 1.6;  // radius; drops below are too small to show more than one colour
const float kPlain_px = 5.0;  // radius; drops below show nothing of late reflections

// A drop's light as a whole: that of four places about its middle, each standing for a quarter of it; of twelve where there are lamps, which a
// drop shows in one place alone.
vec3 meanLight(Cap cap, Place place, vec3 d, vec4 clip) {
  world_from_drop = mat3(frame.world_from_vehicle) * mat3(place.head, cross(place.normal, place.head), place.normal);
  eye_outside = d.z < 0.0;
#ifdef LAMPS
  lamps_seen_from = mat3(frame.world_from_vehicle) * (place.position_m - frame.eye_in_vehicle.xyz);
#endif
  cabin = decode(textureLod(picture, clamp(clip.xy / max(clip.w, 1e-3) * 0.5 + 0.5, 0.0, 1.0), 3.0).rgb);
  vec3 sum = vec3(0.0);
#ifdef LAMPS
  for (int k = 0; k < 16; ++k) {
    vec2 at = 0.5 * vec2(k % 4, k / 4) - 0.75;
    if (dot(at, at) > 1.0) continue;
    sum += lightThrough(cap, vec2(at.x * cap.stretch, at.y), d, 0.51 * sqrt(abs(d.z)), 2) * (1.0 / 3.0);
  }
#else
  for (int k = 0; k < 4; ++k) {
    vec2 at = 0.47 * vec2(k % 2 == 0 ? -cap.stretch : cap.stretch, k < 2 ? -1.0 : 1.0);  // 2/3 from the middle, as the mean point is
    sum += lightThrough(cap, at, d, 0.9 * sqrt(abs(d.z)), 2);
  }
#endif
  return encode(frame.brightness * 0.25 * sum);
}

// A disc that fades over a pixel covers 1/12 of a square pixel's circle too much: pi (R^2 + 1/12) by integration.
float fadedDisc(float area_px) { return area_px / (area_px + 0.2618); }

void main() {
  uint k = gl_GlobalInvocationID.x;
  if (k >= uint(frame.drop_count)) return;
  GlassDropRecord drop = drops[k];
  Place place = placeOf(drop);
  float pixel_m = max(-(frame.eye_from_vehicle * vec4(place.position_m, 1.0)).z, 1e-3) / frame.pixels_per_rad;

  // A drop narrower than a pixel is drawn a pixel wide and as much paler. A small one shows no tail.
  float elongation = max(drop.elongation, 1.0);
  float across_m = drop.base_radius_m * inversesqrt(elongation);
  bool small = max(across_m, 0.5 * pixel_m) * sqrt(elongation) < kSmall_px * pixel_m;  // of a circle of the base's area
  Cap cap = capOfDrop(drop.height_m / across_m, elongation, small ? 0.0 : abs(drop.corner));
  across_m *= inversesqrt(tailedArea(cap.tail));
  float stretch = cap.stretch;
  float radius_m = max(across_m, 0.5 * pixel_m);
  float weight = across_m / radius_m;

  // A drop's place is the middle of its length.
  if (drop.corner < 0.0) place.head = -place.head;
  place.position_m += place.head * (0.5 * (cap.tail - 1.0) * stretch * radius_m);
  vec3 from_eye = place.position_m - frame.eye_in_vehicle.xyz;
  vec4 eye_position = frame.eye_from_vehicle * vec4(place.position_m, 1.0);

  // The rectangle lies along the view ray's shadow on the glass; a grazing view would make it endless.
  vec3 view = vec3(dot(from_eye, place.head), dot(from_eye, cross(place.normal, place.head)), dot(from_eye, place.normal)) / length(from_eye);
  vec2 shadow = vec2(view.x / stretch, view.y) * (view.z > 0.0 ? -1.0 : 1.0);
  float shadow_length = length(shadow);
  float steep = max(abs(view.z), 0.06);
  float slope = shadow_length / steep;
  float irregularity = irregularityOf(drop);
  float pixel = pixel_m / radius_m;
  float wider = 0.2 * irregularity * cap.tail;
  float pad = wider + pixel / steep;
  bool visible = inSight(frame.clip_from_eye * eye_position, 2.0 * radius_m * max(stretch * cap.tail, slope));

  float radius_px = radius_m / pixel_m;
  small = small && visible;
  vec4 light_weight = vec4(0.0);
  if (small) {
    vec3 light = meanLight(cap, place, view, frame.clip_from_eye * eye_position);
    weight *= sqrt(fadedDisc(3.14159 * radius_px * radius_px * stretch * max(abs(view.z), 0.2)));
    light_weight = vec4(light, eye_outside ? -weight * weight : weight * weight);
    irregularity = 0.0;
    pad = 0.0;
  }

  SeenDrop o;
  o.position_radius = vec4(place.position_m, radius_m);
  o.head_stretch = vec4(place.head, stretch);
  o.light_weight = light_weight;
  o.normal_reflections = vec4(place.normal, min(float(frame.internal_reflections), radius_px < kPlain_px ? 3.0 : 6.0));
  // A small drop's third number: how much wider than its ellipse the triangle is for the faded edge.
  o.cap_outline = vec4(cap.centre_z, cap.radius, small ? 1.0 + 0.5 * pixel / steep : irregularity, drop.corner < 0.0 ? -cap.tail : cap.tail);
  vec2 forth = shadow_length > 1e-4 ? shadow / shadow_length : vec2(1.0, 0.0), aside = vec2(-forth.y, forth.x);
  o.reach = vec4(forth, reach(cap, baseReach(cap, forth), slope) + pad, reach(cap, baseReach(cap, -forth), -slope) + pad);
  float sideways = max(baseReach(cap, aside), baseReach(cap, -aside)) * (cap.centre_z > 0.0 ? cap.radius : 1.0);
  o.beside_phase = vec4(sideways + (small ? 0.0 : wider + pixel), float(drop.seed & 0xffffu) * (6.2831853 / 65536.0),
                        weight * weight, radius_m < frame.fine_radius_px * pixel_m ? 2.0 : 1.0);
  vec2 middle = vec2(0.0), along = vec2(1.0, 0.0), across = vec2(0.0, 1.0);
  if (small) {
    vec2 forth = vec2(o.reach.x * stretch, o.reach.y), beside = vec2(-o.reach.y * stretch, o.reach.x);
    middle = 0.5 * (o.reach.z - o.reach.w) * forth;
    along = 0.5 * (o.reach.z + o.reach.w) * forth;
    across = o.beside_phase.x * beside;
  }
  mat4 clip_from_vehicle = frame.clip_from_eye * frame.eye_from_vehicle;
  vec3 beside = cross(place.normal, place.head);
  o.clip_middle = frame.clip_from_eye * eye_position + clip_from_vehicle * vec4(radius_m * (place.head * middle.x + beside * middle.y), 0.0);
  o.clip_along = clip_from_vehicle * vec4(radius_m * (place.head * along.x + beside * along.y), 0.0);
  o.clip_across = clip_from_vehicle * vec4(radius_m * (place.head * across.x + beside * across.y), 0.0);
  seen[k] = o;
  kinds[k] = !visible || weight <= 0.0 ? kUnseenDrop : small ? kSmallDrop : kLargeDrop;
}
