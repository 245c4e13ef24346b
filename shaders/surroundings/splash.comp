// Finds where each splash's line meets what the host has drawn, and hands those to be seen to the draw calls: a workgroup's stand side by side in
// its own part of `drawn`, in the order of their numbers, so that the same splashes always give the same picture; a draw command for each workgroup.
// Defines: READ_DEPTH where the host's depth can be read. Else splashes stand at the reference height, and the depth buffer hides them.
#include "shared/rain_drop.glsl"
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "rain/light.glsl"
#include "shared/rain_drawn.glsl"
#define SPLASH_RAIN_BINDING 0
#include "shared/splash.glsl"

layout(local_size_x = kSplashLanes) in;
layout(std430, binding = 0) readonly buffer Jobs { SplashJob jobs[]; };
layout(std430, binding = 1) writeonly buffer Drawn { SplashPoint drawn[]; };
layout(std430, binding = 2) writeonly buffer Commands { RainLineCommand commands[]; };
layout(std430, binding = 3) readonly buffer Starts { uint starts[]; };  // the job of every kSplashStride-th splash
layout(location = 0) uniform uint job_count;
layout(location = 1) uniform uint splash_count;
layout(location = 2) uniform float most_px;  // a point's side at most

const float kNowhere = -1e9;
const float kLift_m = 0.05;        // so much nearer to the eye a splash is held against a depth buffer, as it stands on what is there
const float kBrightest = 65408.0;  // that halves hold
const float kLeastFall_m = 0.3;    // of the ground below the eye, for what a pixel's depth is worth

shared uint maybe[kSplashGroup], job_of[kSplashGroup], maybe_bits[kSplashGroup / 32u], maybe_before[kSplashGroup / 32u + 1u];
shared uint seen_bits[kSplashLanes / 32u], seen_before[kSplashLanes / 32u + 1u];

// From the viewport's middle.
vec2 onScreen(vec3 p) {
  vec4 clip = look.clipFromWorldAtEye * vec4(p, 1.0);
  return clip.xy / clip.w * 0.5 * look.viewport.zw;
}

// What depth changes on level ground there, for a step of 1 px, and for one of 1 m up the line.
vec2 depthSteps(vec3 p) {
  float depth = dot(p, look.forward.xyz), fall_m = max(-p.z, kLeastFall_m);
  return vec2(depth * depth / look.focal.y, depth) / fall_m;
}

// The height over the reference from which down a line is followed: near by what stands on the ground is the vehicle's, and not the world's.
float highest(Splash s, uint lattice) {
  vec4 search = splash_rain.search[lattice];
  bool is_near = max(length(splashOnLine(s, search.x)), length(splashOnLine(s, search.y))) < search.w;
  return lattice == 0u && is_near ? min(search.y, search.z + kSplashOnGround_m) : search.y;
}

#ifdef READ_DEPTH
layout(binding = 0) uniform sampler2D scene_depth;
layout(binding = 2) uniform sampler2D scene_colour;

const int kHeights = 5, kHalvings = 5;
const float kLeastUp = 0.5;           // of a surface's normal: steeper ones water runs down (unsourced)

ivec2 texelAt(vec2 px) {
  vec2 size_px = look.viewport.zw;
  return ivec2(look.viewport.xy + clamp(px + 0.5 * size_px, vec2(0.5), size_px - 0.5));
}

float sceneAt(vec2 px) { return rainSceneDepth(texelFetch(scene_depth, texelAt(px), 0).r, look.depth_rows, look.zero_to_one); }

// How far behind a place the scene is; kNowhere, as if it hid the place, beside the picture.
float clearance(vec3 p) {
  float depth = dot(p, look.forward.xyz);
  vec2 px = onScreen(p);
  if (depth < kRainNearest_m || any(greaterThanEqual(abs(px), 0.5 * look.viewport.zw))) return kNowhere;
  return sceneAt(px) - depth;
}

// The height over the reference at which the line meets the scene; of several the lowest. kNowhere: none that is seen.
float meets(Splash s, uint lattice) {
  vec3 p = splashOnLine(s, 0.0);
  float before, now = clearance(p);
  if (abs(now) <= 0.6 * depthSteps(p).x + 0.01) return 0.0;
  // Seen where it passes the reference, it meets the scene below that; hidden there, above.
  bool is_hidden = now < 0.0;
  float top = is_hidden ? highest(s, lattice) : 0.0, step_m = (top - (is_hidden ? 0.0 : splash_rain.search[lattice].x)) / float(kHeights);
  float upper = kNowhere, above = 0.0, below = 0.0;
  before = clearance(splashOnLine(s, top));
  for (int i = 1; i <= kHeights; ++i) {
    float height = top - float(i) * step_m;
    now = clearance(splashOnLine(s, height));
    if (before >= 0.0 && now < 0.0) {
      upper = height + step_m;
      above = before;
      below = now;
    }
    before = now;
  }
  if (upper == kNowhere) return kNowhere;
  float lower = upper - step_m;
  for (int i = 0; i < kHalvings; ++i) {
    float middle = 0.5 * (lower + upper);
    now = clearance(splashOnLine(s, middle));
    if (now >= 0.0) {
      upper = middle;
      above = now;
    } else {
      lower = middle;
      below = now;
    }
  }
  // Where the line only goes behind something, the scene's depth jumps.
  float height = 0.5 * (lower + upper);
  vec2 steps = depthSteps(splashOnLine(s, height));
  return above - below <= 0.05 + 2.0 * (steps.x + (upper - lower) * steps.y) ? height : kNowhere;
}

vec3 sceneFrom(vec2 px) {
  vec2 clip = px / (0.5 * look.viewport.zw);
  return (splash_rain.ray_middle.xyz + clip.x * splash_rain.ray_right.xyz + clip.y * splash_rain.ray_up.xyz) * sceneAt(px);
}

// Whether the surface that is seen at a place looks up, told by the pixels round it: of each two the one that is nearer to it, as the other may
// lie beyond an edge.
bool looksUp(vec3 p) {
  vec2 px = floor(onScreen(p)) + 0.5;
  vec3 at = sceneFrom(px);
  vec3 left = sceneFrom(px - vec2(1.0, 0.0)) - at, right = sceneFrom(px + vec2(1.0, 0.0)) - at;
  vec3 low = sceneFrom(px - vec2(0.0, 1.0)) - at, high = sceneFrom(px + vec2(0.0, 1.0)) - at;
  vec3 x = dot(left, left) < dot(right, right) ? -left : right, y = dot(low, low) < dot(high, high) ? -low : high;
  vec3 normal = cross(x, y);
  return abs(normal.z) >= kLeastUp * length(normal);
}

// The surface that a splash stands on, as the target holds it.
vec3 surfaceAt(vec3 foot) { return texelFetch(scene_colour, texelAt(onScreen(foot)), 0).rgb; }

// The sine of the elevation up to which the scene stands behind a place, as far as the picture tells it above there.
float standsBehind(vec3 foot) {
  const int kLooks = 4;
  float sky = look.depth_rows.y > 0.0 ? 0.0 : 1.0;
  vec2 px = onScreen(foot), up = normalize(onScreen(foot + vec3(0.0, 0.0, 0.01 * dot(foot, look.forward.xyz))) - px + vec2(0.0, 1e-6));
  vec2 rim_px = 0.5 * look.viewport.zw - 0.5;  // beyond it depths are not those of their places
  float behind = 0.0, step_px = 3.0;
  for (int i = 0; i < kLooks; ++i) {
    vec2 there = clamp(floor(px + step_px * up) + 0.5, -rim_px, rim_px);
    vec3 way = sceneFrom(there) - foot;
    if (dot(way.xy, foot.xy) > 0.0 && texelFetch(scene_depth, texelAt(there), 0).r != sky) behind = max(behind, way.z / length(way));
    step_px *= 3.0;
  }
  return behind;
}

// Where on its line a splash stands. False where it stands nowhere.
bool stands(Splash s, uint lattice, out vec3 foot) {
  float height = meets(s, lattice);
  foot = splashOnLine(s, max(height, -1e3));
  if (height == kNowhere || foot.z > 0.0 || !looksUp(foot)) return false;
  vec4 search = splash_rain.search[lattice];
  bool is_vehicles = height - search.z > kSplashOnGround_m && length(foot) < search.w;
  return is_vehicles == (lattice > 0u);
}
#else
vec3 surfaceAt(vec3 foot) { return asInTarget(look.ground.rgb); }
float standsBehind(vec3 foot) { return 0.0; }

bool stands(Splash s, uint lattice, out vec3 foot) {
  foot = splashOnLine(s, 0.0);
  return lattice == 0u && foot.z <= 0.0;
}
#endif

// Whether a splash is at work, and its line may be in the picture near enough to count: most are not.
bool mayBeSeen(SplashJob job, uint number) {
  Splash s = splashOf(job, number - job.first);
  uint lattice = job.level >> 2u & 1u;
  vec3 low = splashOnLine(s, splash_rain.search[lattice].x), high = splashOnLine(s, highest(s, lattice));
  vec4 a = look.clipFromWorldAtEye * vec4(low, 1.0), b = look.clipFromWorldAtEye * vec4(high, 1.0);
  bvec2 left = lessThan(max(a.xy + a.w, b.xy + b.w), vec2(0.0)), right = lessThan(max(a.w - a.xy, b.w - b.xy), vec2(0.0));
  // A line is nowhere nearer than where it passes the eye, and farther ranks count less.
  vec2 way = high.xy - low.xy, nearest = low.xy + way * clamp(-dot(low.xy, way) / max(dot(way, way), 1e-6), 0.0, 1.0);
  return splashIsAlive(s) && !any(left) && !any(right) && splashTimes(s.rank, length(nearest), s.diameter_m) > 0.0;
}

struct Seen {
  vec3 foot;
  float depth;
  float times;  // it counts
};

bool seenOf(SplashJob job, uint number, out Splash s, out Seen seen) {
  uint lattice = job.level >> 2u & 1u;
  s = splashOf(job, number - job.first);
  if (!stands(s, lattice, seen.foot)) return false;
  seen.depth = dot(seen.foot, look.forward.xyz);
  float distance_m = length(seen.foot), reach_m = splash_rain.reach.x;
  seen.times = splashTimes(s.rank, distance_m, s.diameter_m) * (1.0 - smoothstep(0.7 * reach_m, reach_m, distance_m)) * splash_rain.reach.y;
  vec2 px = onScreen(seen.foot);
  if (seen.depth < kRainNearest_m || !(seen.times > 0.0) || any(greaterThan(abs(px), 0.5 * look.viewport.zw))) return false;
  float skin_m = 0.01 + seen.depth / look.focal.y;
  return !splashIsSheltered(seen.foot, s.velocity_mps, splash_rain.moves[lattice].xyz, s.age_s, skin_m);
}

// As the target holds it.
vec3 lightOf(vec3 foot) {
  vec3 towards = normalize(foot), above = look.sky.rgb;
  float behind = standsBehind(foot);
  if (look.environment > 0u) {
    vec3 up_behind = normalize(vec3(towards.xy, 0.7 * length(towards.xy) + 1e-3));
    above = textureLod(environment, up_behind, max(float(look.environment) - 2.5, 0.0)).rgb;
  }
  if (look.sun_direction.z > behind) above += look.sun_irradiance.rgb * rainPhase(dot(towards, look.sun_direction.xyz));
  vec3 from_lamps = gatheredFromLamps(foot);
  return min(splashLight(fromTarget(surfaceAt(foot)), above, towards.z, behind) + from_lamps, vec3(1e9));
}

void put(uint at, Splash s, Seen seen) {
  vec3 foot = seen.foot, light = clamp(asInTarget(lightOf(foot)), vec3(0.0), vec3(kBrightest));
  vec2 foot_px = onScreen(foot), up_px = onScreen(foot + vec3(0.0, 0.0, 0.01 * seen.depth)) - foot_px;
  vec2 up = length(up_px) > 1e-3 ? normalize(up_px) : vec2(0.0, 1.0);
  SplashDrawn d = splashDrawn(splashShape(s.diameter_m, s.age_s), look.focal.y / seen.depth, abs(foot.z) / length(foot), seen.times);
  float pixel = rainPixelHalf(up), away = d.radius * d.sine, high = max(d.wall_height, d.high);
  float half_px = max(d.radius, away + 0.5 * high);
  float shrunk = clamp((0.25 * most_px / pixel - pixel) / half_px, 0.01, 1.0);
  d = splashScaled(d, shrunk);
  half_px = shrunk * half_px + pixel;
  // Points are drawn where their middle is in the picture.
  vec2 free_px = foot_px + up * (0.5 * shrunk * high), rim_px = 0.5 * look.viewport.zw - 0.5;
  vec2 middle_px = clamp(free_px, -rim_px, rim_px), moved_px = abs(free_px - middle_px);
  float side_px = min(4.0 * pixel * half_px + 2.0 * max(moved_px.x, moved_px.y), most_px);
  float before = max(seen.depth - kLift_m - 2.0 * depthSteps(foot).x, 0.5 * seen.depth);
  float seed = float(s.seed & 1023u);
  drawn[at] = SplashPoint(vec4(middle_px * (2.0 / look.viewport.zw), rainStoredDepth(before, look.depth_rows), side_px),
                          vec4(foot_px + look.viewport.xy + 0.5 * look.viewport.zw, uintBitsToFloat(packHalf2x16(up)), before),
                          vec4(d.radius, d.wall_height, d.low, d.high),
                          vec4(uintBitsToFloat(packHalf2x16(light.rg)), uintBitsToFloat(packHalf2x16(vec2(light.b, d.sine))),
                               uintBitsToFloat(packHalf2x16(vec2(d.wall, seed))), d.droplets));
}

// How many of the bits stand before one. `before`: how many do in the words before each.
#define RANK(bits, before, number) (before[(number) / 32u] + uint(bitCount(bits[(number) / 32u] & ((1u << ((number) % 32u)) - 1u))))

// Fills in `before`, which has a word more than `bits`, by one lane a word. Each read of what lanes share costs software GL much.
#define COUNT_BEFORE(bits, before, words)                                            \
  if (lane <= words) {                                                               \
    uint sum = 0u;                                                                   \
    for (uint word = 0u; word < lane; ++word) sum += uint(bitCount(bits[word]));     \
    before[lane] = sum;                                                              \
  }

// Those of the group's splashes that may be seen, in order. Returns how many.
uint gather(uint lane, uint begin) {
  uint end = min(begin + kSplashGroup, splash_count);
  for (uint i = lane; i < kSplashGroup / 32u; i += kSplashLanes) maybe_bits[i] = 0u;
  barrier();
  for (uint number = begin + lane; number < end; number += kSplashLanes) {
    uint job = starts[number / kSplashStride];
    while (job + 1u < job_count && jobs[job + 1u].first <= number) ++job;
    uint i = number - begin;
    if (!mayBeSeen(jobs[job], number)) continue;
    atomicOr(maybe_bits[i / 32u], 1u << (i % 32u));
    job_of[i] = job;
  }
  barrier();
  COUNT_BEFORE(maybe_bits, maybe_before, kSplashGroup / 32u)
  barrier();
  for (uint i = lane; i < kSplashGroup; i += kSplashLanes) {
    if ((maybe_bits[i / 32u] >> (i % 32u) & 1u) != 0u) maybe[RANK(maybe_bits, maybe_before, i)] = i;
  }
  barrier();
  return maybe_before[kSplashGroup / 32u];
}

void main() {
  uint lane = gl_LocalInvocationIndex, group = gl_WorkGroupID.x, begin = group * kSplashGroup;
  uint count = gather(lane, begin), drawn_so_far = 0u;
  for (uint from = 0u; from < count; from += kSplashLanes) {
    if (lane < kSplashLanes / 32u) seen_bits[lane] = 0u;
    barrier();
    Splash s;
    Seen seen;
    bool is_seen = false;
    // A loop that runs once at most: software GL leaves those that none enters, but goes through what a branch leaves out.
    for (uint i = from + lane; i < count; i = count) is_seen = seenOf(jobs[job_of[maybe[i]]], begin + maybe[i], s, seen);
    if (is_seen) atomicOr(seen_bits[lane / 32u], 1u << (lane % 32u));
    barrier();
    COUNT_BEFORE(seen_bits, seen_before, kSplashLanes / 32u)
    barrier();
    for (bool shows = is_seen; shows; shows = false) put(begin + drawn_so_far + RANK(seen_bits, seen_before, lane), s, seen);
    drawn_so_far += seen_before[kSplashLanes / 32u];
    barrier();
  }
  if (lane == 0u) commands[group] = RainLineCommand(drawn_so_far, 1u, begin, 0u);
}
