// The water of a pane made ready to be looked at, and where on it there is any: of the rest nothing is drawn.
#pragma once

#include "gl/objects.h"
#include "glass/look_gl.h"
#include "glass/look_picture_gl.h"
#include "glass/look_programs_gl.h"

namespace rg::glass {

class LookWater {
 public:
  LookWater(const GladGLContext& gl, LookPrograms& programs);

  // Makes the pane's pictures of film and beads ready. `film_reach`: how many texels off film is seen; the
  // look's frame is bound. Touches texture units 2 .. 6, storage buffers 0 .. 2 and 5 .. 7, framebuffer,
  // viewport, blend, raster; depth is not tested then.
  void prepare(const LookPane& pane, int film_reach);
  // RGBA16F of the grid as look_water.frag writes them, of the pane prepared last.
  uint32_t film() const { return film_; }
  uint32_t beads() const { return beads_; }

  // The pieces of the pane's mesh that show water, of the pane prepared last: a list for each kind, see
  // shared/glass_tile.glsl.
  uint32_t indices() const { return drawn_.name(); }
  uint32_t commands() const { return commands_.name(); }  // DrawElementsIndirectCommand of each list

  void forget();

 private:
  void bindMaps(const LookPane& pane);
  void sort(const LookPane& pane, int film_reach);
  void compose(const LookPane& pane);
  void addCraters(const LookPane& pane);

  const GladGLContext* gl_;
  LookPrograms* programs_;
  gl::VertexArray no_layout_;
  gl::Sampler exact_, smooth_;
  gl::Texture2D no_film_, no_beads_;  // a dry texel
  gl::Canvases films_, bead_maps_;
  gl::Framebuffer both_;
  gl::Buffer cells_, tiles_, drawn_, commands_;
  uint32_t film_ = 0, beads_ = 0;
};

}  // namespace rg::glass
