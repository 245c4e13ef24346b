// Draws the splashes.
#pragma once

#include <memory>

#include "gl/loader.h"
#include "rain/draw_gl.h"
#include "surroundings/splashes.h"

namespace rg::surroundings {

// [thread: GL, context current, for all of it]
class SplashRenderer {
 public:
  explicit SplashRenderer(const gl::Context& context);
  ~SplashRenderer();
  SplashRenderer(const SplashRenderer&) = delete;
  SplashRenderer& operator=(const SplashRenderer&) = delete;

  void take(const SplashPicture& picture);

  // Call within a state guard; touches what RainRenderer::draw does. Twice the same draw gives the same
  // picture. Where the target's depth cannot be read splashes stand on the ground's height, and there are
  // none where the host told none. Returns the share that was looked at (SplashSetup::kept).
  double draw(const rain::RainDraw& draw, const SplashLook& look);

  void forget();  // the context is lost: free nothing

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace rg::surroundings
