#include "glass/look_fog_gl.h"

#include <glad/gl.h>

namespace rg::glass {

void FogPainter::bind(const LookFog& fog, uint32_t unit) {
  if (!covered_ || covered_.width() != fog.cells.x || covered_.height() != fog.cells.y)
    covered_ = gl::Texture2D(*gl_, GL_R16F, fog.cells.x, fog.cells.y);
  covered_.write(0, 0, 0, 0, fog.cells.x, fog.cells.y, GL_RED, GL_FLOAT, fog.covered.data());
  gl_->BindTextureUnit(unit, covered_.name());
}

void FogPainter::forget() { covered_.forget(); }

}  // namespace rg::glass
