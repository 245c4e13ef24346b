// One streak: a quad along the drop's way past the eye.
#include "shared/rain_drop.glsl"
layout(std140, binding = 0) uniform ClassBlock {
  RainClass classes[kRainClasses];
  RainView rain_view;
};
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "shared/rain_streak.glsl"
#include "rain/light.glsl"

layout(location = 0) in ivec4 record_cell;  // cell_x, cell_y, cell_z, fraction_xy
layout(location = 1) in uvec4 record_rest;  // fraction_z_class, diameter_m, end, id

layout(location = 0) out vec3 streak_at;           // along and across the streak, -1..1; depth along the view, m
layout(location = 1) flat out vec4 streak_colour;  // rgb: as the target holds it; a: mean cover
out vec3 segment_end_m;  // of what is drawn, from the eye: for transform feedback; no stage takes it, so that the linker leaves it out else

const float kSharpFrom_m = 0.5;      // nearer drops are out of any lens's focus: spread until they cannot be seen
const float kLeastWidth_px = 1.7;    // narrower streaks would be broken into dots by the pixel grid: spread and paler instead
const float kDensest = 0.85;         // no streak hides what is behind it

RainDrop readRecord() {
  return RainDrop(record_cell.x, record_cell.y, record_cell.z, uint(record_cell.w), record_rest.x, uintBitsToFloat(record_rest.y),
                  record_rest.z, record_rest.w);
}

vec2 onScreen(vec3 p) {
  vec4 clip = look.clipFromWorldAtEye * vec4(p, 1.0);
  return clip.xy / clip.w * 0.5 * look.viewport.zw;
}

void drawNothing() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  streak_at = vec3(0.0);
  streak_colour = vec4(0.0);
  segment_end_m = vec3(0.0);
}

void main() {
  RainDrop drop = readRecord();
  if (drop.diameter_m <= 0.0) {
    drawNothing();
    return;
  }
  RainStreak streak = rainStreak(drop, classes[rainClassOf(drop)], rain_view);
  float depth = dot(streak.drop_m, look.forward.xyz);
  float approach = dot(streak.velocity_mps, look.forward.xyz);
  float from = streak.from_s, to = streak.to_s;
  // The part before the eye.
  if (depth + approach * from < kRainNearest_m) from = approach > 0.0 ? (kRainNearest_m - depth) / approach : 1.0;
  if (depth + approach * to < kRainNearest_m) to = approach < 0.0 ? (kRainNearest_m - depth) / approach : -1.0;
  if (from >= to) {
    drawNothing();
    return;
  }

  vec3 a = streak.drop_m + streak.velocity_mps * from, b = streak.drop_m + streak.velocity_mps * to;
  vec2 a_px = onScreen(a), b_px = onScreen(b);
  float drawn_px = distance(a_px, b_px);
  vec2 along = drawn_px > 1e-3 ? (b_px - a_px) / drawn_px : vec2(0.0, 1.0);
  vec2 across = vec2(-along.y, along.x);

  bool at_end = (gl_VertexID & 1) != 0;
  float side = (gl_VertexID & 2) != 0 ? 1.0 : -1.0;
  vec3 p = at_end ? b : a;
  segment_end_m = p;
  float p_depth = dot(p, look.forward.xyz);
  float diameter_px = drop.diameter_m * look.focal.y / p_depth;
  float width_px = sqrt(diameter_px * diameter_px + kLeastWidth_px * kLeastWidth_px);
  // A streak seen end on is a disk.
  float longer_px = max(0.0, 0.5 * (width_px - drawn_px));
  vec2 shift_px = along * (at_end ? longer_px : -longer_px) + across * (0.5 * side * width_px);

  gl_Position = look.clipFromWorldAtEye * vec4(p, 1.0);
  gl_Position.xy += shift_px * 2.0 / look.viewport.zw * gl_Position.w;
  float half_s = 0.5 * rain_view.eye_velocity_exposure.w;
  streak_at = vec3((at_end ? to : from) / half_s, side, p_depth);

  // Cover by energy: the disk the drop is seen as, spread over all the streak would be, clipped or not. Measured at the streak's middle, so that
  // both its ends agree.
  float middle_depth = 0.5 * (dot(a, look.forward.xyz) + dot(b, look.forward.xyz));
  float middle_px = drop.diameter_m * look.focal.y / middle_depth;
  float middle_width_px = sqrt(middle_px * middle_px + kLeastWidth_px * kLeastWidth_px);
  float whole_px = max(drawn_px * 2.0 * half_s / (to - from), middle_width_px);
  float cover = look.focal.z * rainCover(middle_px) / (whole_px * middle_width_px);
  float focus = smoothstep(kRainNearest_m, kSharpFrom_m, middle_depth);
  streak_colour = vec4(asInTarget(gathered(streak.drop_m)), min(cover, kDensest) * streak.fade * focus);
}
