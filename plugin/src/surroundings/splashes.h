// Splashes of the rain on whatever the host has drawn: what they are made from. Where and when they are is a
// function of place, time and rate alone (shared/splash.glsl).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "rain/picture.h"
#include "rain/region.h"
#include "rain/wind_profile.h"
#include "saved/inputs.h"
#include "shared/splash.glsl"
#include "tick.h"

namespace rg::surroundings {

inline constexpr double kMostSplashReach_m = 40.0;
// As far from the eye volumes may stand in a splash's way: its reach, and what wind slants drops over the
// height of a roof.
inline constexpr double kSplashShelter_m = kMostSplashReach_m + 20.0;

// So many a view all about is to look at; where the rain makes more of them all are thinned alike. A driver's
// sees less than half of them at 80 km/h: some 100 000 in 100 mm/h, which takes 10 MB on the GPU.
inline constexpr uint32_t kMostSplashes = 1u << 18u;

struct SplashLook {
  double gain = 1.0;  // on what they cover; 0: none
  double reach_m = 20.0;
};

// What passes from the ticking thread to the GL thread.
struct SplashPicture {
  struct Vehicle {
    uint32_t id = 0;
    Pose pose;
    static void visit(auto& a, auto& vehicle) { a(vehicle.id, vehicle.pose); }
  };
  int64_t time_ns = 0;
  double flux_per_m2s = 0.0;  // of drops over kSplashFrom_mm through level ground
  std::array<float, shared::kSplashSizes + 1> sizes_mm{};  // below which k / kSplashSizes of them lie
  glm::dvec3 drift_mps{0.0};                               // of the wind, as far as they have it
  double ground_m = 0.0;                                   // where they are looked for first, world z
  bool ground_known = false;                               // told by the host; else by the eye's height
  // Of the lattices: where the first vehicle stood, in the host's world as it is now.
  glm::dvec3 origin_m{0.0};
  std::vector<Vehicle> vehicles;  // that views are in
  std::vector<glm::dvec3> eyes_m;
  std::vector<rain::NearVolume> volumes;

  // All but the volumes.
  static void visit(auto& a, auto& picture) {
    constexpr size_t kMost = 4096;
    a.within(picture.time_ns, -kLatestTime_ns, kLatestTime_ns);
    a.within(picture.flux_per_m2s, 0.0, 1e6);
    a.within(picture.sizes_mm, 0.0, 20.0);
    a(picture.drift_mps, picture.ground_m, picture.ground_known, picture.origin_m);
    a.list(picture.vehicles, kMost);
    a.list(picture.eyes_m, kMost, [&a](auto& eye_m) { a.within(eye_m, -kAnyNumber, kAnyNumber); });
  }
};

// Follows the weather from tick to tick.
class Splashes {
 public:
  void tick(const Tick& tick, const rain::WindProfile& profile);
  void reset();
  void rebase(const glm::dvec3& shift_m);  // the host's world moved: p_new = p_old - shift
  // All but the volumes.
  const SplashPicture& picture() const { return picture_; }

  static void visit(auto& a, auto& splashes) {
    a(splashes.sized_for_mm_h_, splashes.started_, splashes.picture_);
  }

 private:
  double sized_for_mm_h_ = -1.0;
  bool started_ = false;  // the lattice has its origin
  SplashPicture picture_;
};

// What the kernel wants to know for one view and moment.
struct SplashSetup {
  shared::SplashRain rain;
  shared::RainShelter shelter;
  std::vector<shared::SplashJob> jobs;
  std::vector<uint32_t> starts;  // the job of every kSplashStride-th splash
  uint32_t count = 0;            // of all their splashes
  double kept = 1.0;             // share of all there are, alike for all views; each counts for the rest
};
// False when there is nothing to draw.
bool setUpSplashes(const SplashPicture& picture, const ViewState& view, int64_t time_ns,
                   const SplashLook& look, SplashSetup& out);

// How many splashes begin in a cell during an epoch: Poisson's law, by inversion, so that each cell's number
// only grows with the mean.
class SplashesInCells {
 public:
  explicit SplashesInCells(double mean);
  uint32_t of(uint32_t x, uint32_t y, uint32_t epoch, uint32_t level) const;

 private:
  std::vector<double> sums_;  // share of cells with at most so many
};

}  // namespace rg::surroundings
