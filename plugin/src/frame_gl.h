// The GL half of an instance: what lives in the host's context.
#pragma once

#include <map>
#include <memory>

#include "frame.h"
#include "gl/state_guard.h"
#include "rain/beyond_gl.h"
#include "surroundings/glow_gl.h"
#include "surroundings/splashes_gl.h"

namespace rg {

struct Frame::Gl {
  Gl(const rg_gl_info& info, uint32_t capacity);

  // All but the stages' own queries is touched under a guard made of this.
  gl::StateGuard guard(uint32_t touches) const { return {*context, touches, host_resets_state}; }
  // As PaneGl::hash, of a pane that has its half.
  uint64_t filmHash(uint32_t pane) const;
  // The context is gone, or never to be current again: nothing is freed in it.
  void forget();

  struct PaneHalf {
    std::shared_ptr<glass::PaneSim> sim;
    std::unique_ptr<glass::PaneGl> gl;
  };

  std::unique_ptr<gl::Context> context;
  bool host_resets_state = false;
  std::unique_ptr<rain::RainRenderer> rain;
  std::unique_ptr<rain::BeyondRenderer> beyond;
  std::unique_ptr<surroundings::SplashRenderer> splashes;
  std::unique_ptr<surroundings::WetnessRenderer> wetness;
  std::unique_ptr<surroundings::GlowRenderer> glow;
  uint32_t pattern_version = 0;
  std::shared_ptr<glass::FilmPrograms> film_programs;
  std::unique_ptr<glass::GlassLook> look;
  std::map<uint32_t, PaneHalf> panes;
};

}  // namespace rg
