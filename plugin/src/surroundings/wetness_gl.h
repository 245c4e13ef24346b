// Makes what the host has drawn look wet where rain reaches it, for hosts that do not do so themselves.
#pragma once

#include <memory>

#include "gl/loader.h"
#include "rain/draw_gl.h"
#include "rain/picture.h"

namespace rg::surroundings {

// As far from the eye volumes keep ground dry, the nearest of them that find room (kRainNearVolumes); beyond
// all is wet.
inline constexpr double kWetShelter_m = 150.0;

struct WetnessPicture {
  int64_t time_ns = 0;
  double water_mm = 0.0;                // on open ground
  bool has_volumes = false;             // `volumes` are told; else nothing can be drawn
  glm::dvec3 fall_mps{0.0, 0.0, -1.0};  // of the drops that bring most of it
  glm::dvec3 origin_m{0.0};             // of its pattern, in the host's world as it is now
  std::vector<rain::NearVolume> volumes;
};

// [thread: GL, context current, for all of it]
class WetnessRenderer {
 public:
  explicit WetnessRenderer(const gl::Context& context);
  ~WetnessRenderer();
  WetnessRenderer(const WetnessRenderer&) = delete;
  WetnessRenderer& operator=(const WetnessRenderer&) = delete;

  void take(const WetnessPicture& picture);
  // `strength` 0: nothing is drawn .. 1. Only where the target's depth can be read. Call within a state
  // guard; touches a part of what RainRenderer::draw does. Each draw darkens anew.
  void draw(const rain::RainDraw& draw, double strength);
  void forget();  // the context is lost: free nothing

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace rg::surroundings
