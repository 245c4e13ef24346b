// The glow about all that is bright: what a picture on a screen cannot do to the eye, as the lamps themselves
// would.
#pragma once

#include <memory>

#include "gl/loader.h"
#include "rain/draw_gl.h"

namespace rg::surroundings {

// [thread: GL, context current, for all of it]
class GlowRenderer {
 public:
  explicit GlowRenderer(const gl::Context& context);
  ~GlowRenderer();
  GlowRenderer(const GlowRenderer&) = delete;
  GlowRenderer& operator=(const GlowRenderer&) = delete;

  // Spreads the light of the viewport over it as an eye does (glare.h), `strength` times as much; 0: nothing
  // is done. No light is made. Only in targets of linear radiance: others no longer know how bright their
  // lamps were. What is no number, or negative, gives no light. Call within a state guard, once a picture.
  void draw(const rain::RainDraw& draw, double strength);
  void forget();  // the context is lost: free nothing

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace rg::surroundings
