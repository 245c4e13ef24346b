// A tile of the picture. All that is not linear across it is worked out here.
#include "shared/rain_drop.glsl"
#include "rain/beyond.glsl"
layout(std140, binding = 1) uniform ShelterBlock { RainShelter rain_shelter; };
#include "rain/light.glsl"

layout(location = 0) in uvec4 tile_place;      // column and row; farthest
layout(location = 1) in uvec4 tile_bounds[4];  // as RainTile's

layout(location = 0) noperspective out vec3 ray;         // of unit depth
layout(location = 1) noperspective out vec3 map_relief;  // xy: on the pattern's map, radians; z: contrast, 0 where the map ends
layout(location = 2) noperspective out vec3 light;       // of the rain, as the target holds it,
layout(location = 3) noperspective out vec3 light_side;  // and by how much what lies beyond is brighter to the side
layout(location = 4) noperspective out vec3 light_up;    // and up
layout(location = 5) noperspective out vec3 lamps_near;
layout(location = 6) noperspective out vec3 lamps_middle;
// 1 / depth where the ray leaves a volume, the greatest of five counting, and where it enters it, the least of three: far 0 .. 3; far 4, near.
layout(location = 7) noperspective out vec4 bound_far[VOLUMES];
layout(location = 7 + VOLUMES) noperspective out vec4 bound_near[VOLUMES];

const float kBent = 1.0;  // tangent of the angle by which a drop's rim bends what is seen through it (unsourced)
const float kLeastRise = 0.1;  // sine of the elevation up to which the horizon's ground shows in the blurred sky
const float kLampWide = 1.5;  // tiles; what is finer would be seen as a tile, or not, by where its corners lie (here a fifth more or less)
const float kSkyLevels = 5.0;  // of the cube map that are kept: 16 texels a face, blurred by 6 degrees
const vec4 kLayerDepth_m = vec4(8.0, 28.0, 70.0, 200.0);  // where a layer is tested as a whole

// As bright as the sky that is seen through it, or below the horizon the sky at it: so is the air along a level way that is long enough
// (Koschmieder 1924), and rain that hid the sky would be the sky.
vec3 airlight(vec3 towards) {
  vec3 sky = look.sky.rgb;
  if (look.environment > 0u) {
    vec3 rising = normalize(vec3(towards.xy, max(towards.z, kLeastRise)));
    sky = textureLod(environment, rising, max(float(look.environment) - kSkyLevels, 0.0)).rgb;
  }
  return sky + look.sun_irradiance.rgb * rainPhase(dot(towards, look.sun_direction.xyz));
}

float boundOf(uint first, uint planes, uint shift, vec3 to, float none) {
  uint plane = (planes >> shift) & 63u;
  return plane == kRainNoPlane ? none : rainPlaneBound(rain_shelter.planes[first + plane], to);
}

// A place on the map that does not jump by a turn within the tile.
vec2 onMap(vec3 to, vec3 middle) {
  vec3 turned = vec3(dot(to, beyond.axis.xyz), dot(to, beyond.axis_side.xyz), dot(to, beyond.axis_up.xyz));
  vec2 at = rainMap(turned);
  float near = atan(dot(middle, beyond.axis_up.xyz), dot(middle, beyond.axis_side.xyz));
  return vec2(at.x + 6.2831853 * round((near - at.x) / 6.2831853), at.y);
}

float clipDepth(float depth_m) {
  vec4 rows = look.depth_rows;
  return (rows.y - rows.x * depth_m) / (rows.w - rows.z * depth_m);
}

vec3 rayThrough(vec2 clip) { return beyond.ray_middle.xyz + clip.x * beyond.ray_right.xyz + clip.y * beyond.ray_up.xyz; }

float leaves(uint first, uvec2 words, vec3 to) {
  float far = boundOf(first, words.y, 0u, to, 0.0);
  for (uint shift = 0u; shift < 24u; shift += 6u) far = max(far, boundOf(first, words.x, shift, to, 0.0));
  return far;
}

// Whether all that is seen in the tile lies inside the nearest volume, and the eye too. Its planes bound it farthest off at the tile's corners.
bool isSheltered(vec2 low, vec2 high) {
  uvec2 words = tile_bounds[0].xy;
  if (only_layer >= 0 || words.x == 0u || ((words.y >> 6u) & 63u) != kRainNoPlane) return false;
  uint first = rain_shelter.volumes[(words.x >> 24u) & 63u].first;
  // A thousandth more: walls lie in the planes.
  float most = 1.001 / max(uintBitsToFloat(tile_place.y), 1e-3);
  return leaves(first, words, rayThrough(low)) <= most && leaves(first, words, rayThrough(high)) <= most &&
         leaves(first, words, rayThrough(vec2(low.x, high.y))) <= most && leaves(first, words, rayThrough(vec2(high.x, low.y))) <= most;
}

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  vec2 place = vec2(tile_place.x & 0xffffu, tile_place.x >> 16u);
  vec2 step_clip = 2.0 * beyond.scroll.w / look.viewport.zw;
  vec2 clip = (place + corner) * step_clip - 1.0, middle_clip = (place + 0.5) * step_clip - 1.0;
  ray = rayThrough(clip);
  vec3 middle = rayThrough(middle_clip);
  gl_Position = vec4(clip, only_layer < 0 ? 0.0 : clipDepth(kLayerDepth_m[only_layer]), 1.0);
  if (isSheltered(middle_clip - 0.5 * step_clip, middle_clip + 0.5 * step_clip)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);

  vec3 towards = normalize(ray);
  // Near the axis the map shrinks to nothing: streaks are seen end on there, and the haze is even.
  float off_axis = length(cross(towards, beyond.axis.xyz));
  map_relief = vec3(onMap(ray, middle), smoothstep(0.03, 0.14, off_axis));

  vec3 up = normalize(towards * dot(towards, beyond.axis.xyz) - beyond.axis.xyz + vec3(0.0, 0.0, 1e-5));  // the map's second way
  vec3 side = cross(towards, up);
  light = asInTarget(airlight(towards));
  light_side = 0.5 * (asInTarget(gatheredFromSky(normalize(towards + kBent * side))) - asInTarget(gatheredFromSky(normalize(towards - kBent * side))));
  light_up = 0.5 * (asInTarget(gatheredFromSky(normalize(towards + kBent * up))) - asInTarget(gatheredFromSky(normalize(towards - kBent * up))));
  lamps_near = vec3(0.0);
  lamps_middle = vec3(0.0);
  if (look.lamp_count > 0u) {
    float wide_rad = kLampWide * max(step_clip.x * length(beyond.ray_right.xyz), step_clip.y * length(beyond.ray_up.xyz));
    lamps_near = asInTarget(gatheredFromLampsAlong(towards, 0.0, kRainNearEnd_m, wide_rad));
    lamps_middle = asInTarget(gatheredFromLampsAlong(towards, kRainNearEnd_m, kRainMiddleEnd_m, wide_rad));
  }

  for (int i = 0; i < VOLUMES; ++i) {
    uvec2 words = (i & 1) == 0 ? tile_bounds[i / 2].xy : tile_bounds[i / 2].zw;
    if (words.x == 0u) {  // no volume: left before it is entered
      bound_far[i] = vec4(kRainNoBound);
      bound_near[i] = vec4(0.0);
      continue;
    }
    uint first = rain_shelter.volumes[(words.x >> 24u) & 63u].first;
    bound_far[i] = vec4(boundOf(first, words.x, 0u, ray, 0.0), boundOf(first, words.x, 6u, ray, 0.0), boundOf(first, words.x, 12u, ray, 0.0),
                        boundOf(first, words.x, 18u, ray, 0.0));
    bound_near[i] = vec4(boundOf(first, words.y, 0u, ray, 0.0), boundOf(first, words.y, 6u, ray, kRainNoBound),
                         boundOf(first, words.y, 12u, ray, kRainNoBound), boundOf(first, words.y, 18u, ray, kRainNoBound));
  }
}
