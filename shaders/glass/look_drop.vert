// One drop: a rectangle on the glass that covers all pixels in which its cap can be seen.
#include "optics/look_frame.glsl"
#include "shared/glass_types.glsl"
#include "shared/optics_drop.glsl"

layout(std430, binding = 0) readonly buffer Drops { GlassDropRecord drops[]; };
layout(std430, binding = 1) readonly buffer Mesh { float mesh[]; };  // x, y, z, nx, ny, nz, u, v of each vertex
layout(binding = 2) uniform sampler2D pane_position;
layout(binding = 3) uniform sampler2DArray pane_frame;
layout(binding = 4) uniform sampler2D pane_metric;

out DropToPixel {
  vec2 base;                    // on the glass, in base radii, drop's frame
  vec3 from_eye;                // eye to that point, m, drop's frame
  flat vec4 cap;                // centre z, radius, stretch, width of a pixel across in base radii
  flat vec4 outline;            // irregularity, taper, phase, weight
  flat mat3 world_from_drop;
  flat int samples;             // across and along a pixel
} o;

// Where a drop is and how it lies, vehicle frame.
struct Place {
  vec3 position_m;
  mat3 vehicle_from_drop;  // columns: towards the head, across, out of the glass
};

// +1 where cross(along u, along v) points out of the glass, -1 where the pane's uv are mirrored: as its first vertex tells.
float handedness() {
  vec3 outward = vec3(mesh[3], mesh[4], mesh[5]);
  vec2 uv = vec2(mesh[6], mesh[7]);
  vec3 across = cross(textureLod(pane_frame, vec3(uv, 0.0), 0.0).xyz, textureLod(pane_frame, vec3(uv, 1.0), 0.0).xyz);
  return dot(across, outward) < 0.0 ? -1.0 : 1.0;
}

Place placeOf(GlassDropRecord drop) {
  vec2 grid_m = drop.position_m + drop.velocity_mps * frame.drop_age_s;
  vec2 uv = grid_m * frame.uv_per_m;
  Place place;
  place.position_m = textureLod(pane_position, uv, 0.0).xyz;
  vec3 along_u = textureLod(pane_frame, vec3(uv, 0.0), 0.0).xyz;
  vec3 along_v = textureLod(pane_frame, vec3(uv, 1.0), 0.0).xyz;
  vec2 metric = textureLod(pane_metric, uv, 0.0).xy;
  vec3 normal = normalize(cross(along_u, along_v)) * handedness();
  vec3 head = along_u * (drop.heading.x * metric.x) + along_v * (drop.heading.y * metric.y);
  head = dot(head, head) > 0.0 ? normalize(head - normal * dot(head, normal)) : normalize(along_u);
  place.vehicle_from_drop = mat3(head, cross(normal, head), normal);
  return place;
}

// Drops on wettable glass keep the ragged outline in which they met others; small ones and those on coated glass are round.
float irregularityOf(GlassDropRecord drop) {
  if (drop.seed == 0u) return 0.0;
  return smoothstep(radians(85.0), radians(40.0), drop.contact_angle_rad) * smoothstep(0.5e-3, 2.0e-3, drop.base_radius_m);
}

// How far the cap's shadow on the glass, cast along the view ray, reaches along (1, slope) from the middle, in the space where the base is a
// circle of radius 1. A cap's support function; the part of the sphere below the glass is left out.
float reach(Cap cap, float slope) {
  float s = inversesqrt(1.0 + slope * slope);
  return cap.centre_z + cap.radius * slope * s > 0.0 ? max(1.0, cap.centre_z * slope + cap.radius / s) : 1.0;
}

void main() {
  GlassDropRecord drop = drops[gl_InstanceID];
  Place place = placeOf(drop);
  vec3 from_eye = (place.position_m - frame.eye_in_vehicle.xyz) * place.vehicle_from_drop;
  vec3 view = normalize(from_eye);
  vec4 eye_position = frame.eye_from_vehicle * vec4(place.position_m, 1.0);
  float pixel_m = max(-eye_position.z, 1e-3) / frame.pixels_per_rad;

  // A drop narrower than a pixel is drawn a pixel wide and as much paler.
  float stretch = max(drop.elongation, 1.0);
  float across_m = drop.base_radius_m * inversesqrt(stretch);
  float radius_m = max(across_m, 0.5 * pixel_m);
  float weight = across_m / radius_m;
  Cap cap = capOf(2.0 * atan(drop.height_m / across_m), stretch);

  // The rectangle lies along the view ray's shadow on the glass; a grazing view would make it endless.
  vec2 shadow = vec2(view.x / stretch, view.y) * (view.z > 0.0 ? -1.0 : 1.0);
  float shadow_length = length(shadow);
  vec2 forth = shadow_length > 1e-4 ? shadow / shadow_length : vec2(1.0, 0.0);
  float steep = max(abs(view.z), 0.06);
  float slope = shadow_length / steep;
  float irregularity = irregularityOf(drop);
  vec2 pad = 0.3 * irregularity + vec2(pixel_m / (radius_m * steep), pixel_m / radius_m);
  float ahead = reach(cap, slope) + pad.x;
  float behind = reach(cap, -slope) + pad.x;
  float beside = (cap.centre_z > 0.0 ? cap.radius : 1.0) + pad.y;
  vec2 corner = vec2((gl_VertexID & 1) == 0 ? -behind : ahead, (gl_VertexID & 2) == 0 ? -beside : beside);
  vec2 circle = forth * corner.x + vec2(-forth.y, forth.x) * corner.y;

  o.base = vec2(circle.x * stretch, circle.y);
  vec3 on_glass = vec3(o.base * radius_m, 0.0);
  o.from_eye = from_eye + on_glass;
  o.cap = vec4(cap.centre_z, cap.radius, stretch, pixel_m / radius_m);
  float taper = smoothstep(0.0, 0.1, length(drop.velocity_mps)) * step(1.05, stretch);
  o.outline = vec4(irregularity, taper, float(drop.seed & 0xffffu) * (6.2831853 / 65536.0), weight * weight);
  o.world_from_drop = mat3(frame.world_from_vehicle) * place.vehicle_from_drop;
  o.samples = radius_m < frame.fine_radius_px * pixel_m ? 2 : 1;
  gl_Position = frame.clip_from_eye * (eye_position + vec4(mat3(frame.eye_from_vehicle) * (place.vehicle_from_drop * on_glass), 0.0));
}
