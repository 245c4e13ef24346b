// Scenes with a ground that rain splashes on, as a host draws it.
#pragma once

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
    for (uint32_t i = 0; i < end - job.first; ++i)
      visit(job, job.from + i, shared::splashOf(job, job.from + i, setup.rain));
  }
}

}  // namespace rg::surroundings::test
