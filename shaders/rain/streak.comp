// Works out each drop's streak once, and hands those to be seen to the draw calls: a workgroup's stand side by side in its own part of `drawn`, in
// which there is room for four corners of a thin line or a rectangle of each slot, those from the head and these from the end, and for two of another
// line after them. All in the order of their slots, so that the same drops always give the same picture; a draw command of each sort for each
// workgroup.
// Defines: SOLIDS where flakes or stones may be among them, as software GL runs both sides of every branch. RG_SOFTWARE_GL: there a workgroup is as
// wide as a processor's vectors and goes through its slots in many rounds, as barriers between invocations that do not run at once are dear, and as
// each draw command costs the thread that gives it.
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

#ifdef RG_SOFTWARE_GL
const uint kLanes = 8u, kRounds = 128u;
#else
const uint kLanes = kRainPart, kRounds = 1u;
#endif
const uint kWords = (kLanes + 31u) / 32u;

layout(local_size_x = kLanes) in;
layout(std430, binding = 0) coherent buffer Records { RainDrop records[]; };
layout(std430, binding = 1) writeonly buffer Drawn { RainCorner drawn[]; };
layout(std430, binding = 4) writeonly buffer Told { vec4 told_of[]; };
layout(std430, binding = 2) writeonly buffer Commands { RainCommand commands[]; };
layout(std430, binding = 3) writeonly buffer LineCommands { RainLineCommand line_commands[]; };
layout(location = 0) uniform uint slot_end;
layout(location = 1) uniform uint group_parts;
layout(location = 2) uniform bool draws_lines;
// New records that are put in their slots first: `slots` and `fresh` hold them workgroup by workgroup, whose ones begin at `starts`.
layout(location = 3) uniform bool brings_records;
layout(std430, binding = 5) readonly buffer Slots { uint slots[]; };
layout(std430, binding = 6) readonly buffer Fresh { RainDrop fresh[]; };
layout(std430, binding = 7) readonly buffer Starts { uint starts[]; };

const float kSharpFrom_m = 0.5;  // nearer drops are out of any lens's focus: spread until they cannot be seen (unsourced)
const float kDensest = 0.85;     // what is shown stronger than in nature hides no more of what is behind it (unsourced)
const float kDot_px = 1e-2;      // shorter ways have no direction

// Of each sort a bit for each lane, in turn three times, so that one barrier a round will do: one is written, one cleared, one may still be read.
shared uint sort_bits[3u * 3u * kWords];
shared uint near_picture[kRainPart];  // slots

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

// Three parts of 9 bits and a common exponent of 2, to half a percent of the brightest.
uint rainPackedLight(vec3 light) {
  const float kBrightest = 65408.0, kDarkest = 1.6e-5;
  light = clamp(light, 0.0, kBrightest);
  float most = max(max(light.r, light.g), max(light.b, kDarkest));
  uint exponent = (floatBitsToUint(most * (512.0 / 511.0)) >> 23u) + 1u;  // of the least power of 2 above it, and 127
  uvec3 parts = min(uvec3(light * uintBitsToFloat((127u + 127u + 9u - exponent) << 23u) + 0.5), uvec3(511u));
  return parts.r | parts.g << 9u | parts.b << 18u | (exponent - 112u) << 27u;
}

// How far beside the picture's middle anything of a streak can lie that is seen of it, by its drop's radius where it is nearest.
vec2 edgeOf(float radius_px) { return 0.5 * look.viewport.zw + rainSoftened(radius_px) + 1.0; }

// False of many that are not in the picture, of none that is: of drops by their way through all of the exposure, whatever shelter there is; what does
// not fall straight may be anywhere.
bool mayBeSeen(uint slot) {
  RainDrop drop = records[slot];
  if (drop.diameter_m <= 0.0) return false;
  RainClass its_class = classes[rainClassOf(drop)];
#ifdef SOLIDS
  if (its_class.base.w != kRainIsRain) return true;
#endif
  const float kLonger = 1.001;  // for roundings
  vec3 drop_m = rainPlace(drop, its_class);
  vec3 way_m = (its_class.velocity_reach.xyz - rain_view.eye_velocity_exposure.xyz) * (0.5 * kLonger * rain_view.eye_velocity_exposure.w);
  float depth_m = dot(drop_m, look.forward.xyz), nearer_m = abs(dot(way_m, look.forward.xyz));
  float nearest_m = depth_m - nearer_m;
  if (depth_m + nearer_m < kRainNearest_m) return false;
  if (nearest_m < kRainNearest_m) return true;
  vec2 from_px = onScreen(drop_m - way_m), to_px = onScreen(drop_m + way_m);
  vec2 edge_px = edgeOf(0.5 * drop.diameter_m * look.focal.y / nearest_m) + 0.5;
  return !any(greaterThan(min(from_px, to_px), edge_px)) && !any(lessThan(max(from_px, to_px), -edge_px));
}

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
  vec2 edge_px = edgeOf(radius_px_m / min(depths_m.x, depths_m.y));
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

const uint kNone = 0u, kThinLine = 1u, kLine = 2u, kRectangle = 3u;  // what a streak is drawn as

// What is drawn lies in the picture's plane; fragments tell from their place in it when the drop passed, and how far beside them.
struct Shape {
  vec2 along;
  vec4 ends_px;     // the way with that of the drop itself and of the pixels, from the viewport's middle
  float length_px;  // of that
  float middle_px;  // radius, as a drop's pace on the picture goes with the depths' product
  float pixel_half_px;
  vec2 radii_px;
  float side_px;
};

Shape shapeOf(Seen s) {
  Shape shape;
  vec2 way = s.ends_px.zw - s.ends_px.xy;
  float way_px = length(way);
  shape.along = way_px > kDot_px ? way / way_px : vec2(0.0, 1.0);
  vec2 depths_m = s.depths_times.xy;
  shape.radii_px = vec2(rainSoftened(s.radius_px_m / depths_m.x), rainSoftened(s.radius_px_m / depths_m.y));
  shape.middle_px = s.radius_px_m * inversesqrt(depths_m.x * depths_m.y);
  shape.pixel_half_px = rainPixelHalf(shape.along);
  shape.length_px = rainLength(way_px, shape.middle_px);
  vec2 longer_px = shape.along * (0.5 * (shape.length_px - way_px));
  shape.ends_px = s.ends_px + vec4(-longer_px, longer_px);
  shape.side_px = max(shape.radii_px.x, shape.radii_px.y) + shape.pixel_half_px;
  return shape;
}

// The part, 0 .. 1, of its way that lies in the picture; its first number above its second: none.
vec2 inPicture(vec4 ends_px) {
  const float kWithin = 0.99999;  // for roundings
  vec2 edge_px = (0.5 * kWithin) * look.viewport.zw, way = ends_px.zw - ends_px.xy;
  way = mix(way, vec2(1e-6), lessThan(abs(way), vec2(1e-6)));
  vec2 a = (-edge_px - ends_px.xy) / way, b = (edge_px - ends_px.xy) / way;
  vec2 enter = min(a, b), leave = max(a, b);
  return vec2(max(max(enter.x, enter.y), 0.0), min(min(leave.x, leave.y), 1.0));
}

// GL gives a line its width along that axis of the picture along which it is shorter, and none where its middle lies beside the picture.
uint sortOf(Shape shape, vec2 kept) {
  vec2 size = abs(shape.along), half_px = 0.5 * look.viewport.zw;
  vec2 farthest_px = max(abs(shape.ends_px.xy), abs(shape.ends_px.zw));
  bool inside = size.x > size.y ? farthest_px.y < half_px.y : farthest_px.x < half_px.x;
  float width_px = 2.0 * shape.side_px / max(size.x, size.y);
  if (!draws_lines || !inside || kept.x >= kept.y || width_px > kRainLine_px) return kRectangle;
  return width_px > kRainThinLine_px ? kLine : kThinLine;
}

// The part of its way, of that which lies in the picture, between whose ends a line is drawn. A line covers those rows of pixels (columns, where it
// is the more level) whose middles it passes before its end, so that each end may as well lie just before the next middle: there software GL's tests
// of how an end lies in its pixel always come out alike, which a processor foresees. An end that would leave the picture stays.
vec2 lineEnds(vec2 from_px, vec2 to_px, vec2 kept) {
  const float kBefore_px = 1.0 / 64.0;
  vec2 way = to_px - from_px, middle_px = 0.5 * look.viewport.zw;
  vec2 from_way = abs(way.x) < abs(way.y) ? vec2(from_px.y + middle_px.y, way.y) : vec2(from_px.x + middle_px.x, way.x);
  // Along the way: whole numbers are pixels' edges.
  float begin_px = from_way.y < 0.0 ? -from_way.x : from_way.x, length_px = abs(from_way.y);
  vec2 before = (ceil(begin_px + kept * length_px - 0.5) + (0.5 - kBefore_px) - begin_px) / length_px;
  bvec2 leaves = bvec2(any(greaterThan(abs(from_px + way * before.x), middle_px)), any(greaterThan(abs(from_px + way * before.y), middle_px)));
  return mix(before, kept, leaves);
}

// Of a line only the part in the picture: where an end lies outside, software GL takes all of a draw call a slower way.
void put(uint first, uint slot, Seen s, Shape shape, bool as_line, vec2 kept) {
  vec2 depths_m = s.depths_times.xy, times = s.depths_times.zw, clip = 2.0 / look.viewport.zw;
  vec2 from_px = shape.ends_px.xy, to_px = shape.ends_px.zw;
  vec2 stored = vec2(rainStoredDepth(depths_m.x, look.depth_rows), rainStoredDepth(depths_m.y, look.depth_rows));
  vec2 per_length = shape.along / shape.length_px, origin_px = from_px + look.viewport.xy + 0.5 * look.viewport.zw;
  vec4 line = vec4(per_length, -dot(origin_px, per_length), origin_px.x * shape.along.y - origin_px.y * shape.along.x);
  // Time passes evenly in the world, not on the picture, where one over the depth does.
  float nearer = depths_m.x / depths_m.y;
  float cover = s.colour.a * rainDwell(shape.middle_px, times.y - times.x, shape.length_px, shape.pixel_half_px);
  vec2 per_radius = 1.0 / shape.radii_px;
  uvec4 told = uvec4(rainPackedLight(s.colour.rgb), packHalf2x16(vec2(times.x, times.y * nearer - times.x)),
                     packHalf2x16(vec2(nearer - 1.0, sqrt(cover))), packHalf2x16(per_radius));
  vec2 side = vec2(-shape.along.y, shape.along.x) * shape.side_px;
  vec4 places[4];
  if (as_line) {
    kept = lineEnds(from_px, to_px, kept);
    places[0] = vec4(mix(from_px, to_px, kept.x) * clip, mix(stored.x, stored.y, kept.x), 1.0);
    places[1] = vec4(mix(from_px, to_px, kept.y) * clip, mix(stored.x, stored.y, kept.y), 1.0);
  } else {
    places[0] = vec4((from_px - side) * clip, stored.x, 1.0);
    places[1] = vec4((from_px + side) * clip, stored.x, 1.0);
    places[2] = vec4((to_px - side) * clip, stored.y, 1.0);
    places[3] = vec4((to_px + side) * clip, stored.y, 1.0);
  }
  drawn[first] = RainCorner(places[0], line);
  drawn[first + 1u] = RainCorner(places[1], uintBitsToFloat(told));
  told_of[first] = s.ends_px;
  told_of[first + 1u] = vec4(float(slot), depths_m, float(s.solid));
  if (as_line) return;
  drawn[first + 2u].place = places[2];
  drawn[first + 3u].place = places[3];
}

// How many lanes of each sort but kNone there are before this one, and in all. `turn` goes up by one from call to call.
void countSorts(uint sort, uint turn, out uvec3 before, out uvec3 all_lanes) {
  uint lane = gl_LocalInvocationIndex, now = turn % 3u * 3u * kWords, next = (turn + 1u) % 3u * 3u * kWords, bit = 1u << (lane % 32u);
  if (lane < 3u * kWords) sort_bits[next + lane] = 0u;
  if (sort != kNone) atomicOr(sort_bits[now + (sort - 1u) * kWords + lane / 32u], bit);
  barrier();
  before = all_lanes = uvec3(0u);
  for (uint i = 0u; i < kWords; ++i) {
    uvec3 bits = uvec3(sort_bits[now + i], sort_bits[now + kWords + i], sort_bits[now + 2u * kWords + i]);
    all_lanes += uvec3(bitCount(bits));
    if (i == lane / 32u) bits &= bit - 1u;
    if (i <= lane / 32u) before += uvec3(bitCount(bits));
  }
}

// Sifts slots from `first` on: how many may hold streaks in the picture, which are then in near_picture.
uint sift(uint first, inout uint turn) {
  uint found = 0u;
  for (uint round = 0u; round < kRounds; ++round) {
    uint slot = first + round * kLanes + gl_LocalInvocationIndex;
    bool near = slot < slot_end && mayBeSeen(slot);
    uvec3 before, all_lanes;
    countSorts(near ? kThinLine : kNone, turn++, before, all_lanes);
    if (near) near_picture[found + before.x] = slot;
    found += all_lanes.x;
  }
  barrier();
  return found;
}

void main() {
  uint lane = gl_LocalInvocationIndex, group = gl_WorkGroupID.x, turn = 0u;
  if (lane < 3u * kWords) sort_bits[lane] = 0u;
  uint fresh_end = brings_records ? starts[group + 1u] : 0u;
  for (uint i = brings_records ? starts[group] + lane : 0u; i < fresh_end; i += kLanes) records[slots[i]] = fresh[i];
  memoryBarrierBuffer();
  barrier();
  uint first_slot = group * group_parts * kRainPart;
  uint begin = kRainSlotCorners * first_slot, end = begin + 4u * group_parts * kRainPart;
  uvec3 done = uvec3(0u);
  for (uint part = 0u; part < group_parts; ++part) {
    uint found = sift(first_slot + part * kRainPart, turn);
    for (uint from = 0u; from < found; from += kLanes) {
      uint place = from + lane, slot = near_picture[min(place, found - 1u)];
      Seen result;
      bool seen = seenOf(slot, result) && place < found;
      Shape shape = shapeOf(result);
      vec2 kept = inPicture(shape.ends_px);
      uint sort = seen ? sortOf(shape, kept) : kNone;
      uvec3 before, all_lanes;
      countSorts(sort, turn++, before, all_lanes);
      before += done;
      uint corner = sort == kThinLine ? begin + 2u * before.x : sort == kLine ? end + 2u * before.y : end - 4u * (before.z + 1u);
      if (seen) put(corner, slot, result, shape, sort != kRectangle, kept);
      done += all_lanes;
    }
    barrier();
  }
  if (lane > 0u) return;
  commands[group] = RainCommand(6u * done.z, 1u, 0u, end - 4u * done.z, 0u);
  line_commands[2u * group] = RainLineCommand(2u * done.x, 1u, begin, 0u);
  line_commands[2u * group + 1u] = RainLineCommand(2u * done.y, 1u, end, 0u);
}
