// Cars' lamps as an eye looks into them: small bright discs.
#pragma once

#include <span>

#include "render/program.h"
#include "render/renderer.h"

namespace host {

class GlarePainter {
 public:
  explicit GlarePainter(const GladGLContext& gl);
  ~GlarePainter();
  GlarePainter(const GlarePainter&) = delete;
  GlarePainter& operator=(const GlarePainter&) = delete;

  /// Adds them to what is drawn; `extinction_per_m` is the air's.
  void paint(std::span<const Glare> glares, const View& view, glm::ivec2 size_px, double extinction_per_m);

 private:
  const GladGLContext& gl_;
  Program program_;
  GLuint no_vertices_ = 0;
};

}  // namespace host
