// A drop on glass as a lens: a spherical cap (stretched along its axis) whose flat face lies on the glass, and what light does at its faces. The
// cap of one that runs is drawn out behind into a tail. Lengths are in half widths of the base, the frame is the drop's own: x along its axis
// towards its head, y across, z out of the glass, origin in the middle of the base, or of its head's circle.
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

// The ellipsoid a cap is cut from: centre (0, 0, z), radius in the space where x is divided by `stretch`. There, behind `tail_from` (< 0), it goes
// over into another that touches it all round and ends on the glass at -tail: Q_tail = Q_head - tail_grows (x - tail_from)^2.
struct Cap {
  float centre_z;
  float radius;
  float stretch;
  float tail;        // 1: none
  float tail_from;
  float tail_grows;  // 0: none
};

// How much a tail tapers. At 0 it is half an ellipse; at 1 its sides would be the two tangents from its end to the head's circle, a corner with sin(half
// its angle) = 1 / tail; up to 0.5 it is part of an ellipsoid. What one sees is round at its end (how much, by eye).
RG_CONST float kTaper = 0.35f;

RG_FN Cap capWithTail(float centre_z, float radius, float stretch, float tail) {
  Cap cap;
  cap.centre_z = centre_z;
  cap.radius = radius;
  cap.stretch = stretch;
  cap.tail = tail;
  cap.tail_from = -kTaper / tail;
  float beyond = tail + cap.tail_from;
  cap.tail_grows = (tail * tail - 1.0f) / (beyond * beyond);
  return cap;
}

// A sphere that meets the plane of its base circle of radius 1 at the contact angle.
RG_FN Cap capOf(float contact_angle_rad, float stretch) {
  float s = max(sin(contact_angle_rad), 0.01f);
  return capWithTail(-cos(contact_angle_rad) / s, 1.0f / s, stretch, 1.0f);
}

// The base's area, and a cap's volume, by those over half an ellipse to the head and half of another to the tail's end. Fitted to sums of slices for
// this taper: within 0.1 % and, up to a contact angle of 60 degrees, 1 %, of tails up to the longest.
RG_CONST float kLongestTail = 2.5f;
RG_FN float tailedArea(float tail) { return 1.0f - 0.1025f * (1.0f - 1.0f / tail); }
RG_FN float tailedVolume(float tail) { return 1.0f - 0.22f * (1.0f - 1.0f / tail); }

// The cap of a drop of a record's length by width and corner, `height` by half the width its base has as an ellipse. Its base's area, its length by
// width and its volume (of caps as h (3 + h^2)) are that ellipse's; its head is the rounder the more of a corner it has. One that overhangs its base
// has no tail.
RG_FN Cap capOfDrop(float height, float elongation, float corner) {
  float tail = min(1.0f + 2.0f * corner * (1.0f - smoothstep(0.9f, 1.0f, height)) * (elongation - 1.0f), kLongestTail);
  float area = tailedArea(tail), square = height * height;
  float more = area * sqrt(area) / tailedVolume(tail) - 1.0f;
  float tailed = height * (1.0f + more * (3.0f + square) / (3.0f + 3.0f * square));
  Cap cap = capOf(2.0f * atan(tailed), 2.0f * elongation / (1.0f + tail));
  return capWithTail(cap.centre_z, cap.radius, cap.stretch, tail);
}

RG_CONST float kBlend = 0.9f; // half the way on which the head's curvature goes over into the tail's, by eye

// Half the gradient of what is 0 on the surface, at a place `o` from the ellipsoid's centre in the space where that is a sphere. Where curvature changed
// at once each line seen through it would have a bend: it is let change by and by, which the surface itself does not follow.
RG_FN vec3 capGradient(RG_IN(Cap) cap, RG_IN(vec3) o) {
  float behind = cap.tail_from - o.x, ramp = clamp(behind + kBlend, 0.0f, 2.0f * kBlend);
  return vec3(o.x + cap.tail_grows * (ramp * ramp / (4.0f * kBlend) + max(behind - kBlend, 0.0f)), o.y, o.z);
}

// Unit outward normal at a point on the cap.
RG_FN vec3 capNormal(RG_IN(Cap) cap, RG_IN(vec3) p) {
  vec3 g = capGradient(cap, vec3(p.x / cap.stretch, p.y, p.z - cap.centre_z));
  return normalize(vec3(g.x / cap.stretch, g.y, g.z));
}

// 1 on the base's outline, less inside: of a circle the way from its middle. `place`: in the space where the head is one.
RG_FN float outlineAt(RG_IN(Cap) cap, RG_IN(vec2) place) {
  float behind = min(place.x - cap.tail_from, 0.0f);
  return sqrt(max(dot(place, place) - cap.tail_grows * behind * behind, 1e-8f));
}

// Where the line p + t d meets the head's ellipsoid (grows 0) or the tail's: t of entry and of exit, and in z the squared root's radicand (< 0: it
// misses).
RG_FN vec3 meetEllipsoid(RG_IN(Cap) cap, float grows, RG_IN(vec3) p, RG_IN(vec3) d) {
  float inv = 1.0f / cap.stretch;
  vec3 o = vec3(p.x * inv, p.y, p.z - cap.centre_z);
  vec3 e = vec3(d.x * inv, d.y, d.z);
  float behind = o.x - cap.tail_from;
  float a = dot(e, e) - grows * e.x * e.x;
  float b = dot(o, e) - grows * behind * e.x;
  float radicand = b * b - a * (dot(o, o) - cap.radius * cap.radius - grows * behind * behind);
  float root = sqrt(max(radicand, 0.0f));
  return vec3((-b - root) / a, (-b + root) / a, radicand);
}

// The same of the cap, as far as it goes on below the glass: each end of the line in it lies on the head or on the tail.
RG_FN vec3 meetCap(RG_IN(Cap) cap, RG_IN(vec3) p, RG_IN(vec3) d) {
  vec3 meet = meetEllipsoid(cap, 0.0f, p, d);
  if (cap.tail_grows <= 0.0f) return meet;
  float from = cap.stretch * cap.tail_from;
  bool misses_head = meet.z < 0.0f;
  bool enters_tail = misses_head || p.x + meet.x * d.x < from, leaves_tail = misses_head || p.x + meet.y * d.x < from;
  if (!enters_tail && !leaves_tail) return meet;
  vec3 tail = meetEllipsoid(cap, cap.tail_grows, p, d);
  if (misses_head) meet.z = p.x + tail.x * d.x < from ? tail.z : -1.0f;
  if (enters_tail) meet.x = tail.x;
  if (leaves_tail) meet.y = tail.y;
  return meet;
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
