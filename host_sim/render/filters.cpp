#include "render/filters.h"

namespace host {

Filters::Filters(const GladGLContext& gl)
    : gl_(gl),
      compressing_(gl, {"full.vert"}, {"smooth.frag"}, {"COMPRESS"}),
      smoothing_(gl, {"full.vert"}, {"smooth.frag"}),
      tone_(gl, {"full.vert"}, {"tone.frag"}) {
  gl_.CreateVertexArrays(1, &no_vertices_);
}

Filters::~Filters() { gl_.DeleteVertexArrays(1, &no_vertices_); }

void Filters::smooth(const Target& target, double exposure) {
  if (!unsmoothed_ || unsmoothed_->sizePx() != target.sizePx())
    unsmoothed_ = std::make_unique<ColourPicture>(gl_, target.sizePx());
  compressing_.set("u_exposure", static_cast<float>(exposure));
  fill(compressing_, target.colour(), unsmoothed_->framebuffer(), target.sizePx());
  smoothing_.set("u_texel", 1.0F / glm::vec2(target.sizePx()));
  smoothing_.set("u_exposure", static_cast<float>(exposure));
  fill(smoothing_, unsmoothed_->texture(), target.framebuffer(), target.sizePx());
}

void Filters::write(const Target& target, GLuint framebuffer, double exposure, bool curve) {
  tone_.set("u_exposure", static_cast<float>(exposure));
  tone_.set("u_curve", curve ? 1 : 0);
  fill(tone_, target.colour(), framebuffer, target.sizePx());
}

// Each pixel of a picture from another picture.
void Filters::fill(const Program& program, GLuint from, GLuint framebuffer, glm::ivec2 size_px) {
  beginPicture(gl_, framebuffer, size_px);
  gl_.Disable(GL_DEPTH_TEST);
  gl_.Disable(GL_CULL_FACE);
  gl_.BindTextureUnit(0, from);
  program.use();
  gl_.BindVertexArray(no_vertices_);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace host
