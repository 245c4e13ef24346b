// A pixel of a drop: the ray from the eye is traced through the cap, face by face, and what leaves it looks up its surroundings.
#include "optics/drop_light.glsl"
#include "optics/near.glsl"
#include "optics/seen_drop.glsl"

layout(std430, binding = 2) readonly buffer Seen { SeenDrop seen[]; };

in vec2 base;
flat in int which;

layout(location = 0) out vec4 color;

const float kEnlarged = 0.25;  // of the way to the middle; so little that a blade stays whole (unsourced)

// Merged drops and those on dirty glass are not round. Maps the glass so that the outline becomes the one that is traced.
vec2 straighten(SeenDrop drop, vec2 place) {
  float irregularity = drop.cap_outline.z;
  if (irregularity == 0.0) return place;
  vec2 q = vec2(place.x / drop.head_stretch.w, place.y) * sign(drop.cap_outline.w);
  float phase = drop.beside_phase.y;
  float angle = atan(q.y, q.x) + phase;
  float ragged = irregularity * (0.07 * cos(2.0 * angle + 1.7 * phase) + 0.05 * cos(3.0 * angle) + 0.025 * cos(5.0 * angle - phase));
  return place / (1.0 + ragged);
}

// Signed distance of a line from the cap's limb by what the footprint spans across it; q and e in the space where the head is part of a sphere.
float insideLimb(Cap cap, vec2 q, vec3 e, vec2 dx, vec2 dy) {
  vec3 o = vec3(q, -cap.centre_z);
  if (o.x * dot(e, e) - e.x * dot(o, e) >= cap.tail_from * dot(e, e)) cap.tail_grows = 0.0;  // it is the head's
  float behind = o.x - cap.tail_from;
  vec3 mo = o - vec3(cap.tail_grows * behind, 0.0, 0.0), me = e - vec3(cap.tail_grows * e.x, 0.0, 0.0);
  float a = dot(e, me), b = dot(mo, e);
  float nearest_length = sqrt(max(dot(o, o) - cap.tail_grows * behind * behind - b * b / a, 1e-8));
  vec3 nearest = mo - me * (b / a);
  vec2 limb = vec2(nearest.x / cap.stretch, nearest.y) / nearest_length;
  return (cap.radius - nearest_length) / max(length(vec2(dot(limb, dx), dot(limb, dy))), 1e-6);
}

// Share of a footprint (edges dx, dy) about a place on the glass in which the drop is seen: over its base's outline, from the dry side, or over
// its cap's. Signed distances to both in base radii by the distance that the footprint spans across the edge.
float coverage(Cap cap, vec2 place, vec3 d, vec2 dx, vec2 dy) {
  float inv = 1.0 / cap.stretch;
  vec2 q = vec2(place.x * inv, place.y);
  float q_length = outlineAt(cap, q);
  vec2 gradient = capGradient(cap, vec3(q, 0.0)).xy;
  vec2 outline = vec2(gradient.x * inv, gradient.y) / max(q_length, 1e-4);
  float inside = d.z > 0.0 ? (1.0 - q_length) / max(length(vec2(dot(outline, dx), dot(outline, dy))), 1e-6) : -1e6;
  if (meetCap(cap, vec3(place, 0.0), d).x * d.z > 0.0) inside = max(inside, insideLimb(cap, q, vec3(d.x * inv, d.yz), dx, dy));
  return clamp(inside + 0.5, 0.0, 1.0);
}

// What stands close behind the drop: the visible picture, enlarged about the drop's middle as by a weak lens. `inwards`: to the middle, px.
vec3 enlarged(vec2 inwards) {
  vec2 at = gl_FragCoord.xy - frame.viewport.xy + kEnlarged * inwards;
  return decode(textureLod(picture, at / frame.viewport.zw, 0.0).rgb);
}

void main() {
  SeenDrop drop = seen[which];
  mat3 vehicle_from_drop = mat3(drop.head_stretch.xyz, cross(drop.normal_reflections.xyz, drop.head_stretch.xyz), drop.normal_reflections.xyz);
  world_from_drop = mat3(frame.world_from_vehicle) * vehicle_from_drop;
  Cap cap = capWithTail(drop.cap_outline.x, drop.cap_outline.y, drop.head_stretch.w, abs(drop.cap_outline.w));
  vec3 middle_from_eye = (drop.position_radius.xyz - frame.eye_in_vehicle.xyz) * vehicle_from_drop;
  vec3 to_glass = middle_from_eye + vec3(base * drop.position_radius.w, 0.0);
  vec3 d = normalize(to_glass);
#ifdef LAMPS
  lamps_seen_from = world_from_drop * to_glass;
#endif
  eye_outside = d.z < 0.0;
  cabin = decode(textureLod(picture, (gl_FragCoord.xy - frame.viewport.xy) / frame.viewport.zw, 3.0).rgb);
  vec2 dx = dFdx(base);
  vec2 dy = dFdy(base);
  int samples = int(drop.beside_phase.w);
  float count = float(samples);
  float cover = 0.0;
  vec2 middle = vec2(0.0);  // of the covered part: there the pixel's one ray goes
  for (int a = 0; a < samples * samples; ++a) {
    vec2 offset = (vec2(a % samples, a / samples) + 0.5) / count - 0.5;
    vec2 place = straighten(drop, base + dx * offset.x + dy * offset.y);
    float share = coverage(cap, place, d, dx / count, dy / count);
    cover += share;
    middle += share * place;
  }
  if (cover <= 0.0) discard;
  float footprint = sqrt(abs(dx.x * dy.y - dx.y * dy.x) * max(abs(d.z), 0.05));
  vec3 light = lightThrough(cap, middle / cover, d, footprint, int(drop.normal_reflections.w));
  float near = eye_outside ? 0.0 : nearness(behindGlass_m(length(to_glass)), d.z);
  if (near > 0.0) light = mix(light, enlarged(inverse(mat2(dx, dy)) * -base), near);
  float alpha = cover / (count * count) * drop.beside_phase.z;
  color = vec4(encode(frame.brightness * light) * alpha, alpha);
}
