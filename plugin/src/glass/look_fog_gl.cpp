#include "glass/look_fog_gl.h"

#include <glad/gl.h>

#include <string>

namespace rg::glass {

void FogPainter::bind(const LookFog& fog, size_t with_environment, uint32_t unit) {
  std::optional<gl::Program>& program = programs_[with_environment];
  if (!program) {
    static const std::array<std::string, 1> kEnvironment{"ENVIRONMENT"};
    program.emplace(*gl_,
                    std::initializer_list<std::string_view>{"glass/look_pane.vert", "glass/look_fog.frag"},
                    std::span<const std::string>(kEnvironment).first(with_environment));
  }
  if (!covered_ || covered_.width() != fog.cells.x || covered_.height() != fog.cells.y)
    covered_ = gl::Texture2D(*gl_, GL_R16F, fog.cells.x, fog.cells.y);
  covered_.write(0, 0, 0, 0, fog.cells.x, fog.cells.y, GL_RED, GL_FLOAT, fog.covered.data());
  gl_->BindTextureUnit(unit, covered_.name());
  program->use();
}

void FogPainter::forget() {
  covered_.forget();
  for (std::optional<gl::Program>& program : programs_) {
    if (program) program->forget();
  }
}

}  // namespace rg::glass
