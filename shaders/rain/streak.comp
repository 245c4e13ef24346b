// Works out each drop's streak once, and hands those to be seen to the draw call: a workgroup's stand side by side at the head of its own
// part of `drawn`, in the order of their slots, so that the same drops always give the same picture; one draw command for each workgroup.
#include "shared/rain_drop.glsl"
layout(std140, binding = 0) uniform ClassBlock {
  RainClass classes[kRainClasses];
  RainView rain_view;
};
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "rain/light.glsl"
#include "shared/rain_drawn.glsl"
#include "shared/rain_streak.glsl"

layout(local_size_x = kRainDrawnGroup) in;
layout(std430, binding = 0) readonly buffer Records { RainDrop records[]; };
layout(std430, binding = 1) writeonly buffer Drawn { RainDrawn drawn[]; };
layout(std430, binding = 2) writeonly buffer Commands { RainCommand commands[]; };
layout(location = 0) uniform uint slot_end;

const float kSharpFrom_m = 0.5;  // nearer drops are out of any lens's focus: spread until they cannot be seen (unsourced)
const float kDensest = 0.85;     // what is shown stronger than in nature hides no more of what is behind it (unsourced)

shared uint seen_bits[kRainDrawnGroup / 32u];

vec2 onScreen(vec3 p) {
  vec4 clip = look.clipFromWorldAtEye * vec4(p, 1.0);
  return clip.xy / clip.w * 0.5 * look.viewport.zw;
}

// The streak as it is to be drawn; false when none of it is in the picture.
bool drawnOf(uint slot, out RainDrawn result) {
  result = RainDrawn(vec4(0.0), vec4(0.0), vec4(0.0), 0.0, slot, 0u, 0u);
  RainDrop drop = records[slot];
  if (drop.diameter_m <= 0.0) return false;
  RainStreak streak = rainStreak(drop, classes[rainClassOf(drop)], rain_view);
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
  float gain = min(look.focal.z, max(1.0, kDensest / densest));
  float focus = smoothstep(kRainNearest_m, kSharpFrom_m, middle_m);
  result.ends_px = vec4(from_px, to_px);
  result.depths_times = vec4(depths_m, vec2(from, to) * (2.0 / exposure_s));
  result.colour = vec4(asInTarget(gathered(streak.drop_m)), gain * streak.fade * focus);
  result.radius_px_m = radius_px_m;
  return true;
}

void main() {
  uint lane = gl_LocalInvocationIndex, group = gl_WorkGroupID.x;
  if (lane < kRainDrawnGroup / 32u) seen_bits[lane] = 0u;
  barrier();
  RainDrawn result;
  bool seen = drawnOf(min(gl_GlobalInvocationID.x, slot_end - 1u), result) && gl_GlobalInvocationID.x < slot_end;
  if (seen) atomicOr(seen_bits[lane / 32u], 1u << (lane % 32u));
  barrier();
  uint before = 0u, all = 0u;
  for (uint i = 0u; i < kRainDrawnGroup / 32u; ++i) {
    uint bits = seen_bits[i];
    all += uint(bitCount(bits));
    if (i == lane / 32u) bits &= (1u << (lane % 32u)) - 1u;
    if (i <= lane / 32u) before += uint(bitCount(bits));
  }
  if (seen) drawn[group * kRainDrawnGroup + before] = result;
  if (lane == 0u) commands[group] = RainCommand(6u * all, 1u, 0u, 4u * group * kRainDrawnGroup, 0u);
}
