// What the tests of the field's laws share: a view's volume, its faces, and the live drops as records tell
// them.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "rain/hydrometeors.h"
#include "rain/region.h"
#include "scene.h"

namespace rg::rain::test {

inline constexpr double kReachPerDiameter = 1.25 * 1663.0;  // of the default Visibility

using DropKey = std::tuple<uint32_t, int32_t, int32_t, int32_t, uint32_t>;  // class, cell, id

struct LiveDrop {
  DropKey key;
  uint32_t kind = 0;
  double diameter_m = 0.0;
  dvec3 place_m{0.0}, velocity_mps{0.0};  // world, at the picture's tick
  double reach_m() const {
    const auto is_of = static_cast<int32_t>(fallClasses()[kind].hydrometeor);
    return kReachPerDiameter * fallClasses()[kind].seen *
           std::min(diameter_m, static_cast<double>(shared::rainReachDiameter(is_of)));
  }
};

inline LiveDrop liveDropOf(const RainDrop& d, const Picture& picture) {
  LiveDrop drop;
  drop.kind = shared::rainClassOf(d);
  drop.key = {drop.kind, d.cell_x, d.cell_y, d.cell_z, d.id};
  drop.diameter_m = static_cast<double>(d.diameter_m);
  const ClassPicture& c = picture.classes[drop.kind];
  const dvec3 fraction(d.fraction_xy & 0xffffu, d.fraction_xy >> 16, d.fraction_z_class & 0xffffu);
  drop.place_m = c.origin_m + (dvec3(d.cell_x, d.cell_y, d.cell_z) + (fraction + 0.5) / 65536.0) * c.cell_m;
  drop.velocity_mps = c.velocity_mps;
  return drop;
}

// Every live drop, whether or not some view shows it.
inline void liveDrops(Field& field, Upload& upload, std::vector<LiveDrop>& out) {
  field.publishAll(upload);
  out.clear();
  for (const RainDrop& d : upload.records) out.push_back(liveDropOf(d, upload.picture));
}

inline bool inCone(const Cone& cone, const dvec3& p) {
  for (const dvec3& n : cone.inward) {
    if (glm::dot(n, p - cone.eye_m) < 0.0) return false;
  }
  return true;
}
inline bool inVolume(const Cone& cone, const dvec3& p, double reach_m) {
  return glm::distance(p, cone.eye_m) < reach_m && inCone(cone, p);
}

// The solid angle a view looks into: two spherical triangles (Van Oosterom & Strackee 1983).
inline double solidAngle(const Cone& cone) {
  double sum = 0.0;
  for (size_t half = 0; half < 2; ++half) {
    const dvec3 a = cone.corners[0], b = cone.corners[1 + half], c = cone.corners[2 + half];
    sum += 2.0 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
                            1.0 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
  }
  return sum;
}

// Calls each(diameter_mm, drops per m3) over steps of a class's sizes.
template <class F>
void overSizes(const SizeLaw& law, size_t kind, F&& each) {
  constexpr int kSteps = 16;
  const SpeedClass& c = speedClasses()[kind];
  for (int k = 0; k < kSteps; ++k) {
    const double a = c.from_mm + (c.to_mm - c.from_mm) * k / kSteps,
                 b = c.from_mm + (c.to_mm - c.from_mm) * (k + 1) / kSteps;
    each(0.5 * (a + b), law.numberDensity(a, b));
  }
}

// How many drops of a class the law puts into a view's volume, each seen to its own reach.
inline double expectedInView(const SizeLaw& law, size_t kind, double solid_angle) {
  double sum = 0.0;
  overSizes(law, kind, [&](double mm, double per_m3) {
    sum += per_m3 * solid_angle * std::pow(kReachPerDiameter * 1e-3 * mm, 3) / 3.0;
  });
  return sum;
}

// Puts the view, and the cars with it, where they are at the scene's tick when moving along x from `from_x`
// at tick 0.
inline void place(Scene& scene, double speed_mps, double heading_rad, double from_x = 0.0) {
  const double x = from_x + speed_mps * static_cast<double>(scene.index) * kTickSeconds;
  scene.views[0].eye_velocity_mps = {speed_mps, 0, 0};
  look(scene.views[0], {x, 0, 1.5}, heading_rad);
}

}  // namespace rg::rain::test
