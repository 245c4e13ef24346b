// The light that a drop sends to the eye: rays traced through its cap, face by face; what leaves it looks up its surroundings.
#ifndef RG_OPTICS_DROP_LIGHT_GLSL
#define RG_OPTICS_DROP_LIGHT_GLSL
#include "optics/surroundings.glsl"
#ifdef LAMPS
#include "optics/lamps.glsl"
#endif
#include "shared/optics_drop.glsl"

// Of the drop being looked at; set before.
mat3 world_from_drop = mat3(1.0);
bool eye_outside = false;
vec3 cabin = vec3(0.0);  // what an eye outside sees close behind the glass

// Light that arrives from where a ray leaves to, drop's frame. Spreads: what neighbouring pixels see, across the plane of incidence and in it.
vec3 arriving(vec3 direction, float spread_rad, float spread_in_plane_rad) {
  vec3 light = surroundingsOfGlass(world_from_drop * direction, world_from_drop[2], spread_rad);
#ifdef LAMPS
  light += behindGlassShare(world_from_drop * direction, world_from_drop[2]) *
           lampsTowards(world_from_drop * direction, max(abs(spread_rad), abs(spread_in_plane_rad)));
#endif
  return eye_outside && direction.z < 0.0 ? cabin : light;
}

// Follows a ray that has entered. At each face a share leaves by Fresnel, the rest stays. A pixel's bundle of rays is `footprint` wide and
// widens by `spread` rad for each radius of path; both are followed across the plane of incidence (d' = n d - (n cos i - cos t) N, N' = x / R),
// where a bundle spreads least, so that pictures in drops stay sharp. Lamps want the widest: `in_plane` holds width and spread in that plane,
// as if it were the same at each face (d' cos t = n d cos i - (n cos i - cos t) N, N' = x / (R cos i): Coddington's equations).
vec3 traceInside(Cap cap, vec3 p, vec3 d, float footprint, float spread, vec2 in_plane, int reflections) {
  vec3 sum = vec3(0.0);
  float staying = 1.0;
  for (int k = 0; k <= reflections; ++k) {
    InnerHit hit = nextFace(cap, p, d);
    float cosine = dot(d, hit.normal);
    float curvature = hit.normal.z > -0.999 ? 1.0 / cap.radius : 0.0;
    float reflected = fresnel(cosine, 1.0 / kWaterIndex);
#ifdef MIRROR  // its silver lies so close below the drop as if at its base: nothing leaves there
    bool silvered = hit.normal.z < -0.999;
    if (silvered) reflected = 1.0;
#endif
    float leaving = staying * (1.0 - reflected);
    float across = footprint + spread * hit.path;  // of the ray bundle at this face
    in_plane.x += in_plane.y * hit.path;
    float turned = curvature * in_plane.x / max(cosine, 0.1);
    if (leaving > 0.004) {
      vec3 out_direction = refract(d, -hit.normal, kWaterIndex);
      float out_cosine = dot(out_direction, hit.normal);
      float bend = (kWaterIndex * cosine - out_cosine) * curvature * across;
      float wide = (kWaterIndex * cosine * in_plane.y - (kWaterIndex * cosine - out_cosine) * turned) / max(out_cosine, 0.1);
      sum += leaving * arriving(out_direction, abs(kWaterIndex * spread - bend), wide);
    }
#ifdef MIRROR
    if (silvered) reflected = frame.mirror;
#endif
    staying *= reflected;
    if (staying < 0.01) break;
    spread = spread - 2.0 * curvature * across * cosine;
    in_plane.y -= 2.0 * turned;
    footprint = across;
    d = reflect(d, hit.normal);
    p = hit.position;
  }
  return sum + staying * arriving(d, 1.0, 1.0);  // what is still inside leaves by many ways: the surroundings' mean about its direction
}

// Light that comes along the view ray through a place on the glass, out of the drop. `footprint`: width of the pixel's rays there.
vec3 lightThrough(Cap cap, vec2 place, vec3 d, float footprint, int reflections) {
  vec3 p = vec3(place, 0.0);
  vec3 meet = meetCap(cap, p, d);
  bool from_dry = d.z > 0.0;
  float from_middle = outlineAt(cap, vec2(place.x / cap.stretch, place.y));
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
  if (reflected > 0.004) light = reflected * arriving(reflect(d, normal), 2.0 * curvature * footprint * cosine, 2.0 * curvature * footprint / cosine);
  vec3 inner = refract(d, normal, 1.0 / kWaterIndex);
  float inner_cosine = -dot(inner, normal);
  float spread = curvature * footprint * (cosine / kWaterIndex - inner_cosine);
  vec2 in_plane = vec2(footprint * inner_cosine, spread / inner_cosine) / cosine;
  return light + (1.0 - reflected) * traceInside(cap, p, inner, footprint, spread, in_plane, reflections);
}
#endif
