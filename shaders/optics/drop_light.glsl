// The light that a drop sends to the eye: rays traced through its cap, face by face; what leaves it looks up its surroundings.
#ifndef RG_OPTICS_DROP_LIGHT_GLSL
#define RG_OPTICS_DROP_LIGHT_GLSL
#include "optics/surroundings.glsl"
#include "shared/optics_drop.glsl"

// Of the drop being looked at; set before.
mat3 world_from_drop = mat3(1.0);
bool eye_outside = false;
vec3 cabin = vec3(0.0);  // what an eye outside sees close behind the glass

// Light that arrives from where a ray leaves to, drop's frame.
vec3 arriving(vec3 direction, float spread_rad) {
  vec3 light = surroundingsOfGlass(world_from_drop * direction, world_from_drop[2], spread_rad);
  return eye_outside && direction.z < 0.0 ? cabin : light;
}

// Follows a ray that has entered. At each face a share leaves by Fresnel, the rest stays. A pixel's bundle of rays is `footprint` wide and
// widens by `spread` rad for each radius of path; both are followed across the plane of incidence (d' = n d - (n cos i - cos t) N, N' = x / R),
// where a bundle spreads least, so that pictures in drops stay sharp.
vec3 traceInside(Cap cap, vec3 p, vec3 d, float footprint, float spread, int reflections) {
  vec3 sum = vec3(0.0);
  float staying = 1.0;
  for (int k = 0; k <= reflections; ++k) {
    InnerHit hit = nextFace(cap, p, d);
    float cosine = dot(d, hit.normal);
    float curvature = hit.normal.z > -0.999 ? 1.0 / cap.radius : 0.0;
    float reflected = fresnel(cosine, 1.0 / kWaterIndex);
    float leaving = staying * (1.0 - reflected);
    float across = footprint + spread * hit.path;  // of the ray bundle at this face
    if (leaving > 0.004) {
      vec3 out_direction = refract(d, -hit.normal, kWaterIndex);
      float bend = (kWaterIndex * cosine - dot(out_direction, hit.normal)) * curvature * across;
      sum += leaving * arriving(out_direction, abs(kWaterIndex * spread - bend));
    }
    staying *= reflected;
    if (staying < 0.01) break;
    spread = spread - 2.0 * curvature * across * cosine;
    footprint = across;
    d = reflect(d, hit.normal);
    p = hit.position;
  }
  return sum + staying * arriving(d, 1.0);  // what is still inside leaves by many ways: the surroundings' mean about its direction
}

// Light that comes along the view ray through a place on the glass, out of the drop. `footprint`: width of the pixel's rays there.
vec3 lightThrough(Cap cap, vec2 place, vec3 d, float footprint, int reflections) {
  vec3 p = vec3(place, 0.0);
  vec3 meet = meetCap(cap, p, d);
  bool from_dry = d.z > 0.0;
  float from_middle = length(vec2(place.x / cap.stretch, place.y));
  bool through_base = from_dry && from_middle < 1.0;
  bool on_cap = !through_base && meet.x * d.z > 0.0 && meet.z > 0.0;
  vec3 normal = vec3(0.0, 0.0, -1.0);
  if (on_cap) {
    p += d * meet.x;
    normal = capNormal(cap, p);
  } else {  // a ray that just misses sees what its neighbour within does
    p.xy *= min(1.0, 0.98 / max(from_middle, 1e-4));
    if (!from_dry) normal = capNormal(cap, vec3(p.xy, 0.02));
  }
  float cosine = max(-dot(d, normal), 0.02);
  float reflected = fresnel(cosine, kWaterIndex);
  float curvature = on_cap ? 1.0 / cap.radius : 0.0;
  vec3 light = vec3(0.0);
  if (reflected > 0.004) light = reflected * arriving(reflect(d, normal), 2.0 * curvature * footprint * cosine);
  vec3 inner = refract(d, normal, 1.0 / kWaterIndex);
  float spread = curvature * footprint * (cosine / kWaterIndex + dot(inner, normal));
  return light + (1.0 - reflected) * traceInside(cap, p, inner, footprint, spread, reflections);
}
#endif
