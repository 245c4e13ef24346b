// Draws the rain beyond the particles: before them, over the host's scene.
#pragma once

#include <memory>

#include "gl/loader.h"
#include "rain/beyond.h"
#include "rain/beyond_pattern.h"
#include "rain/draw_gl.h"

namespace rg::rain {

// [thread: GL, context current, for all of it]
class BeyondRenderer {
 public:
  explicit BeyondRenderer(const gl::Context& context);
  ~BeyondRenderer();
  BeyondRenderer(const BeyondRenderer&) = delete;
  BeyondRenderer& operator=(const BeyondRenderer&) = delete;

  void setPattern(const RainPattern& pattern);
  void take(const BeyondPicture& picture);

  // Draws the picture last taken, at draw.time_ns. With the target's depth to read, each pixel has the rain
  // between the eye and what it shows, without what particles take at draw.gain (see setUpBeyond). Without,
  // each layer is drawn as a whole where what is there lies behind its middle. Call within a state guard;
  // touches: program, vertex array, uniform buffers 0 .. 2, shader storage buffer 0, texture units 0 .. 2
  // with their samplers, draw framebuffer, viewport, blend, depth, raster state. Twice the same draw gives
  // the same picture.
  void draw(const RainDraw& draw, const BeyondLook& look);

  void forget();  // the context is lost: free nothing

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace rg::rain
