// What is done to whole pictures: edges smoothed, and HDR written as a screen shows it.
#pragma once

#include <memory>

#include "render/program.h"
#include "render/target.h"

namespace host {

class Filters {
 public:
  explicit Filters(const GladGLContext& gl);
  ~Filters();
  Filters(const Filters&) = delete;
  Filters& operator=(const Filters&) = delete;

  /// Smooths the edges in the target's colour, as they will be seen at `exposure`.
  void smooth(const Target& target, double exposure);
  /// Writes the target's colour, times `exposure`, as sRGB; `curve`: through a filmic one.
  void write(const Target& target, GLuint framebuffer, double exposure, bool curve);

 private:
  void fill(const Program& program, GLuint from, GLuint framebuffer, glm::ivec2 size_px);

  const GladGLContext& gl_;
  Program compressing_, smoothing_, tone_;
  GLuint no_vertices_ = 0;
  std::unique_ptr<ColourPicture> unsmoothed_;
};

}  // namespace host
