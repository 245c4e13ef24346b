// Rain beyond the drops that are particles: how it moves past each view, and what is needed to draw it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "rain/picture.h"
#include "rain/region.h"
#include "rain/wind_profile.h"
#include "shared/rain_beyond.glsl"
#include "tick.h"

namespace rg::rain {

inline constexpr double kBeyondRange_m = 400.0;  // volumes farther off than this shadow nothing (unsourced)

// How the layers look, in order near, middle, far, haze: a factor on their optical depth (1 = as in nature),
// and how much of the pattern they show (0 = an even haze, 1 = all).
struct BeyondLook {
  double share = 1.0;  // 0: nothing is drawn .. 1: all
  glm::dvec4 bias{1.0};
  glm::dvec3 contrast{0.4, 0.3, 0.15};
};

// What passes from the ticking thread to the GL thread.
struct BeyondPicture {
  struct View {
    uint32_t id = 0;
    double streamed_m = 0.0;  // way of the rain past the eye, in streaks as long as at kPlainStreak_m
    static void visit(auto& a, auto& view) {
      a(view.id);
      a.within(view.streamed_m, 0.0, 1e12);
    }
  };
  int64_t time_ns = 0;
  double rate_mm_h = 0.0;
  glm::dvec3 drop_velocity_mps{0.0};  // of the drops that are seen most
  double reach_per_diameter = 1.0;    // as of the particles' classes
  std::vector<View> views;
  std::vector<NearVolume> volumes;
};

// Follows each view from tick to tick. State depends on the ticks alone.
class Beyond {
 public:
  void tick(const Tick& tick, const WindProfile& profile);
  void reset();
  void rebase(const glm::dvec3& shift_m);  // the host's world moved: p_new = p_old - shift
  // All but the volumes.
  void describe(double reach_per_diameter, BeyondPicture& picture) const;
  // The views of the last tick.
  const std::vector<Cone>& cones() const { return cones_; }

  static void visit(auto& a, auto& beyond) {
    constexpr size_t kMostViews = 64;
    a.within(beyond.time_ns_, -kLatestTime_ns, kLatestTime_ns);
    a(beyond.rate_mm_h_, beyond.drop_velocity_mps_);
    a.list(beyond.views_, kMostViews);
    a.list(beyond.cones_, kMostViews);
  }

 private:
  int64_t time_ns_ = 0;
  double rate_mm_h_ = 0.0;
  glm::dvec3 drop_velocity_mps_{0.0};
  std::vector<BeyondPicture::View> views_, before_;
  std::vector<Cone> cones_;
};

// What particles take of the light at the eye, 1/m, and the mean distance to which they do, m, at a gain
// of 1. A particle of diameter D fades before its reach k D, so a size's share reaches 0.8 k D on the mean;
// over all sizes that is 1.2 k times the water in the air by their cover.
struct ParticlesShare {
  double at_eye_per_m = 0.0;
  double mean_m = 1.0;
};
ParticlesShare particlesShare(double rate_mm_h, double reach_per_diameter);

// The block that is drawn with. `gain` as of the particles: what they take, they take so many times, but
// never more than there is: with a gain that makes them cover more than the law's extinction, the sum of both
// is that much too dark near the eye and right beyond. False when there is nothing to draw: no rain, or no
// perspective view. `mean` and `greatest` are the pattern's: contrast stays where no part would be more than
// opaque, so that the mean is kept.
bool setUpBeyond(const BeyondPicture& picture, const ViewState& view, int64_t time_ns, const BeyondLook& look,
                 double gain, double pattern_mean, double pattern_greatest, shared::RainBeyond& out);

}  // namespace rg::rain
