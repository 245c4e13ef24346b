// Scenes with a ground that rain splashes on, as a host draws it.
#pragma once

#include <algorithm>
#include <vector>

#include "../rain/scene.h"
#include "rain/region.h"
#include "surroundings/splashes.h"

namespace rg::surroundings::test {

using glm::dvec3, glm::vec3;
using namespace rg::rain::test;

inline Scene sceneOnGround(double rain_mm_h, const dvec3& eye = dvec3(0, 0, 1.5)) {
  Scene scene = sceneWithView(rain_mm_h, eye);
  scene.weather.ground_height_m = 0.0;
  return scene;
}

inline SplashPicture pictureOf(const Scene& scene) {
  Splashes splashes;
  splashes.tick(scene.tick(), rain::WindProfile{});
  return splashes.picture();
}

// As pictureOf, with the volumes that the field knows after the scene's tick.
inline SplashPicture pictureOf(const Scene& scene, rain::Field& field) {
  SplashPicture picture = pictureOf(scene);
  field.tick(scene.tick());
  field.volumesNear(picture.eyes_m, kSplashShelter_m, picture.volumes);
  return picture;
}

// All splashes of a setup: visit(job, index, splash).
template <class Visit>
void each(const SplashSetup& setup, const Visit& visit) {
  for (size_t k = 0; k < setup.jobs.size(); ++k) {
    const shared::SplashJob& job = setup.jobs[k];
    const uint32_t end = k + 1 < setup.jobs.size() ? setup.jobs[k + 1].first : setup.count;
    for (uint32_t i = 0; i < end - job.first; ++i) visit(job, i, shared::splashOf(job, i, setup.rain));
  }
}

inline constexpr double kNear_m = 0.1, kFar_m = 1000.0;  // of scene.h's views

// How far from the eye, in lengths of `ray`, the scene is that the host has drawn.
using Surface = double (*)(const dvec3& eye, const dvec3& ray);
inline double levelGround(const dvec3& eye, const dvec3& ray) { return ray.z < 0.0 ? -eye.z / ray.z : 1e9; }
inline double wallAt2m(const dvec3&, const dvec3& ray) { return ray.x > 0.0 ? 2.0 / ray.x : 1e9; }

// What a host's depth buffer holds of a surface.
inline std::vector<float> storedDepth(const ViewState& view, int width, int height, Surface surface) {
  const rain::Cone cone = rain::coneOf(view);
  const rain::Rays rays = rain::raysOf(cone, view);
  std::vector<float> stored;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double clip_x = 2.0 * (x + 0.5) / width - 1.0, clip_y = 2.0 * (y + 0.5) / height - 1.0;
      const double depth_m = std::clamp(
          surface(cone.eye_m, rays.middle + clip_x * rays.right + clip_y * rays.up), kNear_m, kFar_m);
      const double ndc =
          (kFar_m + kNear_m) / (kFar_m - kNear_m) - 2.0 * kFar_m * kNear_m / ((kFar_m - kNear_m) * depth_m);
      stored.push_back(static_cast<float>(0.5 * ndc + 0.5));
    }
  }
  return stored;
}

}  // namespace rg::surroundings::test
