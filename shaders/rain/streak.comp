// Works out each drop's streak once, and hands those to be seen to the draw call: a workgroup's stand side by side at the head of its own
// part of `drawn`, in the order of their slots, so that the same drops always give the same picture; one draw command for each workgroup.
// Defines: SOLIDS where flakes or stones may be among them, as software GL runs both sides of every branch.
#include "shared/rain_drop.glsl"
layout(std140, binding = 0) uniform ClassBlock {
  RainClass classes[kRainClasses];
  RainView rain_view;
};
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "rain/gain.glsl"
#include "rain/light.glsl"
#include "shared/rain_drawn.glsl"
#include "shared/rain_streak.glsl"

layout(local_size_x = kRainDrawnGroup) in;
layout(std430, binding = 0) readonly buffer Records { RainDrop records[]; };
layout(std430, binding = 1) writeonly buffer Drawn { RainCorner drawn[]; };
layout(std430, binding = 2) writeonly buffer Commands { RainCommand commands[]; };
layout(location = 0) uniform uint slot_end;

const float kSharpFrom_m = 0.5;  // nearer drops are out of any lens's focus: spread until they cannot be seen (unsourced)
const float kDensest = 0.85;     // what is shown stronger than in nature hides no more of what is behind it (unsourced)
const float kDot_px = 1e-2;      // shorter ways have no direction

shared uint seen_bits[kRainDrawnGroup / 32u];

vec2 onScreen(vec3 p) {
  vec4 clip = look.clipFromWorldAtEye * vec4(p, 1.0);
  return clip.xy / clip.w * 0.5 * look.viewport.zw;
}

// What is to be drawn of a drop.
struct Seen {
  vec4 ends_px;       // xy: where the streak begins, from the viewport's middle; zw: where it ends
  vec4 depths_times;  // xy: its ends' depth along the view, m; zw: their times, -1 .. 1 over the whole exposure
  vec4 colour;        // rgb: as the target holds it; a: how much more than in nature it covers (1: as much)
  float radius_px_m;  // of the drop, px at 1 m
  uint solid;         // rainSolidCode
};

// False when none of it is in the picture.
bool seenOf(uint slot, out Seen result) {
  result = Seen(vec4(0.0), vec4(0.0), vec4(0.0), 0.0, 0u);
  RainDrop drop = records[slot];
  if (drop.diameter_m <= 0.0) return false;
  RainClass its_class = classes[rainClassOf(drop)];
#ifndef SOLIDS
  its_class.base.w = kRainIsRain;
#endif
  int is_of = its_class.base.w;
  RainStreak streak = rainStreak(drop, its_class, rain_view);
  float depth = dot(streak.drop_m, look.forward.xyz);
  float approach = dot(streak.velocity_mps, look.forward.xyz);
  float from = streak.from_s, to = streak.to_s;
  // The part before the eye.
  if (depth + approach * from < kRainNearest_m) from = approach > 0.0 ? (kRainNearest_m - depth) / approach : 1.0;
  if (depth + approach * to < kRainNearest_m) to = approach < 0.0 ? (kRainNearest_m - depth) / approach : -1.0;
  if (from >= to) return false;

  vec2 from_px = onScreen(streak.drop_m + streak.velocity_mps * from), to_px = onScreen(streak.drop_m + streak.velocity_mps * to);
  vec2 depths_m = vec2(depth + approach * from, depth + approach * to);
  float radius_px_m = 0.5 * drop.diameter_m * look.focal.y;
  vec2 edge_px = 0.5 * look.viewport.zw + rainSoftened(radius_px_m / min(depths_m.x, depths_m.y)) + 1.0;
  if (any(greaterThan(min(from_px, to_px), edge_px)) || any(lessThan(max(from_px, to_px), -edge_px))) return false;

  float middle_m = 0.5 * (depths_m.x + depths_m.y);
  float exposure_s = rain_view.eye_velocity_exposure.w;
  float densest = rainDensest(distance(from_px, to_px) * exposure_s / (to - from), radius_px_m / middle_m);
  vec3 light = asInTarget(shown(streak.drop_m, is_of));
  float gain = rainFilled(is_of) * min(gainOf(from_px, to_px, light), max(1.0, kDensest / densest));
  float focus = smoothstep(kRainNearest_m, kSharpFrom_m, middle_m);
  result.ends_px = vec4(from_px, to_px);
  result.depths_times = vec4(depths_m, vec2(from, to) * (2.0 / exposure_s));
  result.colour = vec4(light, gain * streak.fade * focus);
  result.radius_px_m = radius_px_m;
  result.solid = rainSolidCode(is_of, drop.id);
  return true;
}

// The rectangle lies in the picture's plane; fragments tell from their place in it when the drop passed, and how far beside them.
void put(uint first, uint slot, Seen s) {
  vec2 way = s.ends_px.zw - s.ends_px.xy;
  float way_px = length(way);
  vec2 along = way_px > kDot_px ? way / way_px : vec2(0.0, 1.0);
  vec2 depths_m = s.depths_times.xy, times = s.depths_times.zw;
  vec2 radii_px = vec2(rainSoftened(s.radius_px_m / depths_m.x), rainSoftened(s.radius_px_m / depths_m.y));
  float middle_px = s.radius_px_m * inversesqrt(depths_m.x * depths_m.y);  // as a drop's pace on the picture goes with the depths' product
  float pixel_half_px = rainPixelHalf(along);
  float length_px = rainLength(way_px, middle_px), longer_px = 0.5 * (length_px - way_px);
  float side_px = max(radii_px.x, radii_px.y) + pixel_half_px;
  vec2 side = vec2(-along.y, along.x) * side_px, clip = 2.0 / look.viewport.zw;
  vec2 from_px = s.ends_px.xy - along * longer_px, to_px = s.ends_px.zw + along * longer_px;
  float from_stored = rainStoredDepth(depths_m.x, look.depth_rows), to_stored = rainStoredDepth(depths_m.y, look.depth_rows);
  vec4 colour = vec4(s.colour.rgb, s.colour.a * rainDwell(middle_px, times.y - times.x, length_px, pixel_half_px));
  vec2 from_per = 1.0 / vec2(depths_m.x, radii_px.x), to_per = 1.0 / vec2(depths_m.y, radii_px.y);
  drawn[first] =
      RainCorner(vec4((from_px - side) * clip, from_stored, 1.0), vec4(0.0, -side_px, from_per), vec4(times, to_per.x, pixel_half_px + float(s.solid)));
  drawn[first + 1u] = RainCorner(vec4((from_px + side) * clip, from_stored, 1.0), vec4(0.0, side_px, from_per), colour);
  drawn[first + 2u] = RainCorner(vec4((to_px - side) * clip, to_stored, 1.0), vec4(1.0, -side_px, to_per), s.ends_px);
  drawn[first + 3u] = RainCorner(vec4((to_px + side) * clip, to_stored, 1.0), vec4(1.0, side_px, to_per), vec4(float(slot), 0.0, 0.0, 0.0));
}

void main() {
  uint lane = gl_LocalInvocationIndex, group = gl_WorkGroupID.x;
  if (lane < kRainDrawnGroup / 32u) seen_bits[lane] = 0u;
  barrier();
  Seen result;
  bool seen = seenOf(min(gl_GlobalInvocationID.x, slot_end - 1u), result) && gl_GlobalInvocationID.x < slot_end;
  if (seen) atomicOr(seen_bits[lane / 32u], 1u << (lane % 32u));
  barrier();
  uint before = 0u, all = 0u;
  for (uint i = 0u; i < kRainDrawnGroup / 32u; ++i) {
    uint bits = seen_bits[i];
    all += uint(bitCount(bits));
    if (i == lane / 32u) bits &= (1u << (lane % 32u)) - 1u;
    if (i <= lane / 32u) before += uint(bitCount(bits));
  }
  if (seen) put(4u * (group * kRainDrawnGroup + before), gl_GlobalInvocationID.x, result);
  if (lane == 0u) commands[group] = RainCommand(6u * all, 1u, 0u, 4u * group * kRainDrawnGroup, 0u);
}
