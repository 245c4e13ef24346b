// Draws the falling drops.
#pragma once

#include <cstdint>
#include <memory>

#include "gl/loader.h"
#include "rain/draw_gl.h"
#include "rain/picture.h"

namespace rg::rain {

// [thread: GL, context current, for all of it]
class RainRenderer {
 public:
  RainRenderer(const gl::Context& context, uint32_t capacity);  // capacity as of the field
  ~RainRenderer();
  RainRenderer(const RainRenderer&) = delete;
  RainRenderer& operator=(const RainRenderer&) = delete;

  // Takes over what is new and empties `upload`. Where uploadBinds says so it touches: program, buffer
  // bindings GL_SHADER_STORAGE_BUFFER 0 .. 2; else nothing that is not the plugin's own.
  void upload(Upload& upload);
  bool uploadBinds(const Upload& upload) const;

  // Draws the drops as of the last upload, placed at draw.time_ns. Call within a state guard; touches:
  // program, vertex array, uniform buffers 0 .. 2, buffer bindings GL_SHADER_STORAGE_BUFFER 0 .. 7 and
  // GL_DRAW_INDIRECT_BUFFER, texture units 0 .. 2 with their samplers, draw framebuffer, viewport, blend,
  // depth, raster state. Twice the same draw gives the same picture.
  void draw(const RainDraw& draw);

  void forget();  // the context is lost: free nothing

 private:
  struct Objects;
  std::unique_ptr<Objects> objects_;
};

}  // namespace rg::rain
