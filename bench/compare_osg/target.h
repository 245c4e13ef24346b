// What is drawn into.
#pragma once

#include <glad/gl.h>

#include <array>
#include <cstddef>

#include "side.h"

namespace compare {

// As an image generator has it: linear light in half floats, and depth.
struct Target {
  explicit Target(const GladGLContext& gl);
  const GladGLContext& gl;
  GLuint framebuffer = 0, colour = 0, depth = 0;
};

// Pixels that streaks cover, each counted as often as streaks lie over it: a mean of pictures on black, told
// from the pixels that stay black. Of streaks that fall anywhere, independently, n lie over a pixel on
// average where the share exp(-n) stays black (Poisson); block by block, as they are not everywhere alike.
class Cover {
 public:
  void add(const Target& target);
  double px() const;

 private:
  static constexpr int kBlock_px = 20;
  static constexpr int kColumns = kWidth_px / kBlock_px, kRows = kHeight_px / kBlock_px;
  std::array<double, std::size_t{kColumns} * kRows> black_{};
  double pictures_ = 0.0;
};

}  // namespace compare
