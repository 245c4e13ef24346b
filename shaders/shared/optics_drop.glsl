// A drop on glass as a lens: a spherical cap (stretched along its axis when it moves) whose flat face lies on the glass, and what light does at
// its faces. Lengths are in base radii, the frame is the drop's own: x along its axis, y across, z out of the glass, origin in the base's middle.
#ifndef RG_SHARED_OPTICS_DROP_GLSL
#define RG_SHARED_OPTICS_DROP_GLSL
#include "shared/compat.glsl"
RG_SHARED_BEGIN

RG_CONST float kWaterIndex = 1.333f;
RG_CONST float kWindowIndex = 1.52f; // soda-lime float glass

// Reflectance of unpolarised light. `cosine` is that of the incident ray, >= 0; `eta` = n behind / n before. 1 where all is reflected.
// Fresnel's equations: Born & Wolf, Principles of Optics, 1.5.2 eq. (21a, b).
RG_FN float fresnel(float cosine, float eta) {
  float g2 = eta * eta - 1.0f + cosine * cosine;
  if (g2 <= 0.0f) return 1.0f;
  float g = sqrt(g2);
  float rs = (cosine - g) / (cosine + g);
  float rp = (eta * eta * cosine - g) / (eta * eta * cosine + g);
  return 0.5f * (rs * rs + rp * rp);
}

// The ellipsoid a cap is cut from: centre (0, 0, z), radius in the space where x is divided by `stretch`.
struct Cap {
  float centre_z;
  float radius;
  float stretch;
};

// A sphere that meets the plane of its base circle of radius 1 at the contact angle.
RG_FN Cap capOf(float contact_angle_rad, float stretch) {
  float s = max(sin(contact_angle_rad), 0.01f);
  Cap cap;
  cap.radius = 1.0f / s;
  cap.centre_z = -cos(contact_angle_rad) / s;
  cap.stretch = stretch;
  return cap;
}

// How much wider than its ellipse a drop is at a place along it, -1 (tail) .. 1 (head). As much wider before the middle as narrower behind it, so
// that the base's area and the volume of any cap over it are the ellipse's. With corner 1 the tail is one, of tan(half its angle) =
// sqrt(2) / elongation: for x = t - 1, t small, the ellipse is sqrt(2 t) wide and this sqrt(t).
RG_FN float cornered(float along, float corner) {
  float x = clamp(along, -1.0f, 1.0f);
  return 1.0f + corner * x / (1.0f + sqrt(1.0f - abs(x)));
}
RG_CONST float kMostCornered = 0.13f; // of its half width a drop with a corner is wider than its ellipse, at most

// Where the line p + t d meets the ellipsoid: t of entry and of exit, and in z the squared root's radicand (< 0: it misses).
RG_FN vec3 meetCap(RG_IN(Cap) cap, RG_IN(vec3) p, RG_IN(vec3) d) {
  float inv = 1.0f / cap.stretch;
  vec3 o = vec3(p.x * inv, p.y, p.z - cap.centre_z);
  vec3 e = vec3(d.x * inv, d.y, d.z);
  float a = dot(e, e);
  float b = dot(o, e);
  float radicand = b * b - a * (dot(o, o) - cap.radius * cap.radius);
  float root = sqrt(max(radicand, 0.0f));
  return vec3((-b - root) / a, (-b + root) / a, radicand);
}

// Unit outward normal of the ellipsoid at a point on it.
RG_FN vec3 capNormal(RG_IN(Cap) cap, RG_IN(vec3) p) {
  return normalize(vec3(p.x / (cap.stretch * cap.stretch), p.y, p.z - cap.centre_z));
}

// A ray inside the drop at its next face: where, the face's outward normal, and whether it is the flat one on the glass.
struct InnerHit {
  vec3 position;
  vec3 normal;
  float path;
};

RG_FN InnerHit nextFace(RG_IN(Cap) cap, RG_IN(vec3) p, RG_IN(vec3) d) {
  float t_cap = max(meetCap(cap, p, d).y, 0.0f);
  float t_base = d.z < -1e-6f ? max(-p.z / d.z, 0.0f) : 1e30f;
  InnerHit hit;
  hit.path = min(t_cap, t_base);
  hit.position = p + d * hit.path;
  hit.normal = vec3(0.0f, 0.0f, -1.0f);
  if (t_base >= t_cap) {
    hit.position.z = max(hit.position.z, 0.0f);
    hit.normal = capNormal(cap, hit.position);
  } else {
    hit.position.z = 0.0f;
  }
  return hit;
}

RG_SHARED_END
#endif
