#include "rain/picture.h"

#include <algorithm>
#include <cmath>

#include "rain/motion.h"
#include "rain/region.h"
#include "rain/size_law.h"
#include "rain/standing.h"

namespace rg::rain {
namespace {

using glm::dvec3, glm::vec3, glm::vec4;

struct Posed {
  const NearVolume* volume;
  Pose pose;  // at the time of drawing
  dvec3 centre;
  double gap_m;  // between its sphere and the eye
};

std::vector<Posed> nearestFirst(std::span<const NearVolume> volumes, const dvec3& eye, double after_s) {
  std::vector<Posed> posed;
  for (const NearVolume& volume : volumes) {
    const Pose pose = movedOn(volume.pose, after_s);
    const dvec3 centre = outOfBody(pose, volume.centre);
    posed.push_back({&volume, pose, centre, glm::distance(centre, eye) - volume.radius_m});
  }
  std::stable_sort(posed.begin(), posed.end(),
                   [](const Posed& a, const Posed& b) { return a.gap_m < b.gap_m; });
  return posed;
}

}  // namespace

double setUpShelter(std::span<const NearVolume> volumes, const dvec3& eye, double after_s,
                    shared::RainShelter& shelter) {
  uint32_t planes = 0;
  double known_m = 1e30;
  shelter.volume_count = 0;
  for (const Posed& posed : nearestFirst(volumes, eye, after_s)) {
    const auto count = static_cast<uint32_t>(posed.volume->planes.size());
    if (shelter.volume_count == shared::kRainNearVolumes || planes + count > shared::kRainNearPlanes) {
      known_m = std::min(known_m, posed.gap_m);
      continue;
    }
    shared::RainVolume& volume = shelter.volumes[shelter.volume_count++];
    volume = {vec4(vec3(posed.centre - eye), static_cast<float>(posed.volume->radius_m)),
              vec4(vec3(posed.pose.velocity_mps), posed.volume->vehicle != 0 ? 1.0f : 0.0f),
              planes,
              count,
              0,
              0};
    for (const Plane& plane : posed.volume->planes) {
      const dvec3 normal = posed.pose.orientation * plane.normal;
      const double d = plane.d + glm::dot(normal, posed.pose.position_m - eye);
      shelter.planes[planes++] = vec4(vec3(normal), static_cast<float>(d));
    }
  }
  return known_m;
}

bool Picture::volumesFit() const {
  size_t planes = 0;
  for (const NearVolume& volume : volumes) planes += volume.planes.size();
  return volumes.size() <= shared::kRainNearVolumes && planes <= shared::kRainNearPlanes;
}

void setUpStreaks(const Picture& picture, const ViewState& view, int64_t time_ns, StreakSetup& out) {
  const dvec3 eye = coneOf(view).eye_m;
  const double after_s = static_cast<double>(time_ns - picture.time_ns) * 1e-9;
  const double known_m = setUpShelter(picture.volumes, eye, after_s, out.shelter);
  for (uint32_t kind = 0; kind < kClasses; ++kind) {
    const ClassPicture& c = picture.classes[kind];
    const ClassLattice& lattice = classLattices()[kind];
    const dvec3 corner = c.origin_m + c.velocity_mps * after_s;
    const dvec3 base = glm::clamp(glm::floor((eye - corner) / c.cell_m), dvec3(-2e9), dvec3(2e9));
    out.classes[kind].corner_cell = vec4(vec3(corner + base * c.cell_m - eye), static_cast<float>(c.cell_m));
    // Where a volume may be that cannot be told, no streak is drawn: half of it reaches beyond its drop.
    const double half_m = 0.5 * exposureOf(view) * glm::length(c.velocity_mps - eyeVelocityOf(view)),
                 known_reach =
                     std::max(known_m - half_m, 1e-3) / (1e-3 * lattice.reach_mm / lattice.drops.seen);
    out.classes[kind].velocity_reach =
        vec4(vec3(c.velocity_mps), static_cast<float>(std::min(c.reach_per_diameter, known_reach)));
    out.classes[kind].base = glm::ivec4(glm::ivec3(base), static_cast<int32_t>(lattice.drops.hydrometeor));
  }
  out.view.eye_velocity_exposure = vec4(vec3(eyeVelocityOf(view)), static_cast<float>(exposureOf(view)));
  const double units =
      std::floor(after_s * static_cast<double>(kTickHz) * static_cast<double>(shared::kRainEndUnits));
  out.view.now = picture.epoch_ticks * 1024u + static_cast<uint32_t>(static_cast<int64_t>(units));
  out.view.tick_s = static_cast<float>(kTickSeconds);
}

}  // namespace rg::rain
