// Rain beyond the drops that are drawn one by one: open air along the pixel's ray, and how opaque and bright the rain in it is.
#include "rain/beyond.glsl"
#include "rain/streak.glsl"

layout(binding = 0) uniform sampler2D scene_depth;
layout(binding = 2) uniform sampler2D pattern;  // rgb: normals (x to the side, y up, z to the eye), 0.5 is 0; a: how much rain

layout(location = 0) noperspective in vec3 ray;
layout(location = 1) noperspective in vec3 map_relief;
layout(location = 2) noperspective in vec3 light;
layout(location = 3) noperspective in vec3 light_side;
layout(location = 4) noperspective in vec3 light_up;
layout(location = 5) noperspective in vec3 lamps_near;
layout(location = 6) noperspective in vec3 lamps_middle;
layout(location = 7) noperspective in vec4 bound_far[VOLUMES];
layout(location = 7 + VOLUMES) noperspective in vec4 bound_near[VOLUMES];
layout(location = 0) out vec4 colour;

layout(location = 1) uniform float pixel_level;  // log2 of a pixel on the map, radians: the whole draw's, as one level for all is fetched at less cost

// How far the ray goes through air that may hold rain.
float rayEnd(float stretch) {
  float rain_end = kRainCloudBase_m * stretch / max(ray.z, 1e-3 * stretch);
  if (only_layer >= 0) return rain_end;
  float stored = texelFetch(scene_depth, ivec2(gl_FragCoord.xy), 0).r;
  // At the far plane, which may be near for a sky, there is nothing.
  if (stored == (look.depth_rows.y > 0.0 ? 0.0 : 1.0)) return rain_end;
  return min(rainSceneDepth(stored, look.depth_rows, look.zero_to_one) * stretch, rain_end);
}

// The stretches of the ray outside all volumes, which may overlap.
RainOpen openAir(float stretch, float end) {
  vec2 inside[VOLUMES];
  for (int i = 0; i < VOLUMES; ++i) {
    vec4 far = bound_far[i], near = bound_near[i];
    float leave = max(max(max(far.x, far.y), max(far.z, far.w)), max(near.x, 1e-6)), enter = min(near.y, min(near.z, near.w));
    inside[i] = enter > leave ? stretch / vec2(enter, leave) : vec2(end);
  }
  for (int i = 1; i < VOLUMES; ++i) {
    for (int j = VOLUMES - 1; j >= i; --j) {
      vec2 a = inside[j - 1], b = inside[j];
      bool turned = b.x < a.x;
      inside[j - 1] = turned ? b : a;
      inside[j] = turned ? a : b;
    }
  }
  RainOpen open = RainOpen(0.0, 0.0, 0.0, 0.0, 0.0);
  float at = 0.0, mean_m = beyond.extinction.z;
  for (int i = 0; i < VOLUMES; ++i) {
    rainAddOpen(open, at, min(inside[i].x, end), mean_m);
    at = max(at, min(inside[i].y, end));
  }
  rainAddOpen(open, at, end, mean_m);
  return open;
}

// Of the pattern in a layer: how much rain, mean 1, and the light it shows.
vec4 layerOf(int layer, vec3 lit) {
  vec2 at = vec2(map_relief.x, map_relief.y / beyond.repeats.w) * (beyond.repeats[layer] / 6.2831853);
  vec4 p = textureLod(pattern, at + vec2(0.37 * float(layer), beyond.scroll[layer]), pixel_level + beyond.level[layer]);
  float contrast = beyond.contrast[layer] * map_relief.z;
  vec2 normal = (2.0 * p.xy - 1.0) * contrast;
  // A drop is a lens: what it shows is upside down.
  return vec4(max(lit - normal.x * light_side - normal.y * light_up, vec3(0.0)), 1.0 + contrast * (p.a / beyond.contrast.w - 1.0));
}

vec4 over(vec4 behind, vec4 layer, float opacity) {
  float a = clamp(opacity * layer.a, 0.0, 1.0);
  return behind * (1.0 - a) + vec4(layer.rgb * a, a);
}

void main() {
  float stretch = length(ray);
  vec4 depths = rainOpticalDepths(openAir(stretch, rayEnd(stretch)), beyond.extinction) * beyond.bias;
  vec4 opacity = 1.0 - exp(-depths);
  if (only_layer >= 0) opacity *= vec4(equal(ivec4(0, 1, 2, 3), ivec4(only_layer)));
  vec4 sum = vec4(light, 1.0) * opacity.w;
  sum = over(sum, layerOf(2, light), opacity.z);
  sum = over(sum, layerOf(1, light + lamps_middle), opacity.y);
  sum = over(sum, layerOf(0, light + lamps_near), opacity.x);
  colour = sum * beyond.extinction.w;
}
