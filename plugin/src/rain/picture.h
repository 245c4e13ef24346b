// What passes from the field (ticking thread) to the renderer (GL thread): changed records, and what is
// needed to draw all of them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "rain/hydrometeors.h"
#include "rain/volume.h"
#include "shared/rain_streak.glsl"
#include "tick.h"

namespace rg::rain {

using shared::RainDrop;

// A class's standing frame at the picture's tick.
struct ClassPicture {
  glm::dvec3 origin_m{0.0};  // world position of the corner of cell (0, 0, 0)
  glm::dvec3 velocity_mps{0.0};
  double cell_m = 1.0;
  double reach_per_diameter = 1.0;  // a drop is seen as far as this times its diameter
};

// A volume near some view. Of a moving body: planes in its frame, to be posed at the time of drawing.
struct NearVolume {
  uint32_t vehicle = 0;
  Pose pose;  // of the body at the picture's tick; of a static volume the identity
  std::vector<Plane> planes;
  glm::dvec3 centre{0.0};  // of a sphere that holds it, in the planes' frame
  double radius_m = 0.0;
};

struct Picture {
  int64_t tick = 0;
  int64_t time_ns = 0;
  uint32_t epoch_ticks = 0;  // the tick in the records' own count (RainDrop.end)
  uint32_t slot_end = 0;     // all live drops lie in slots below
  std::array<ClassPicture, kClasses> classes;
  std::vector<NearVolume> volumes;
  bool volumesFit() const;  // into what a view can be told of them
};

// Filled by Field::publish, emptied by RainRenderer::upload. Not locked: the owner guards it.
struct Upload {
  bool whole = false;  // forget all records held so far
  std::vector<uint32_t> slots;
  std::vector<RainDrop> records;  // of `slots`, in the order written
  Picture picture;
};

// What the kernel wants to know for one view and moment.
struct StreakSetup {
  std::array<shared::RainClass, kClasses> classes;
  shared::RainShelter shelter;
  shared::RainView view;
};
// Fills in the volumes nearest to the eye that find room (kRainNearVolumes with kRainNearPlanes in all),
// nearest first, as they stand then. Returns how far from the eye a place is surely in none that found no
// room.
double setUpShelter(std::span<const NearVolume> volumes, const glm::dvec3& eye_m, double after_s,
                    shared::RainShelter& shelter);
// Where not all volumes find room, streaks are drawn only as far as the first that found none: rain is seen
// less far, never in the dry.
void setUpStreaks(const Picture& picture, const ViewState& view, int64_t time_ns, StreakSetup& out);

}  // namespace rg::rain
