#include "gl/state_guard.h"

#include <array>
#include <utility>

#include "gl/host_state.h"

namespace rg::gl {
namespace {

// Queries that would count what we draw. TIME_ELAPSED may run: it only grows by our time, which is true.
constexpr std::array<std::pair<GLenum, const char*>, 5> kCountingQueries{
    {{GL_SAMPLES_PASSED, "SAMPLES_PASSED"},
     {GL_ANY_SAMPLES_PASSED, "ANY_SAMPLES_PASSED"},
     {GL_ANY_SAMPLES_PASSED_CONSERVATIVE, "ANY_SAMPLES_PASSED_CONSERVATIVE"},
     {GL_PRIMITIVES_GENERATED, "PRIMITIVES_GENERATED"},
     {GL_TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN, "TRANSFORM_FEEDBACK_PRIMITIVES_WRITTEN"}}};

}  // namespace

std::string findObstacle(const Context& context) {
  const GladGLContext& gl = context.gl;
  GLint active = 0, paused = 0;
  gl.GetIntegerv(GL_TRANSFORM_FEEDBACK_BUFFER_ACTIVE, &active);
  if (active) gl.GetIntegerv(GL_TRANSFORM_FEEDBACK_BUFFER_PAUSED, &paused);
  if (active && !paused) return "transform feedback is active and not paused";
  for (const auto& [target, name] : kCountingQueries) {
    GLint query = 0;
    gl.GetQueryiv(target, GL_CURRENT_QUERY, &query);
    if (query != 0) return std::string("a query of target ") + name + " is active";
  }
  return {};
}

void requireDrawable(const Context& context, GLuint framebuffer) {
  const GladGLContext& gl = context.gl;
  const std::string name = "framebuffer " + std::to_string(framebuffer);
  if (framebuffer != 0 && !gl.IsFramebuffer(framebuffer))
    throw Error(Error::Kind::kWrongOrder, name + " does not exist in this context");
  if (gl.CheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(Error::Kind::kWrongOrder, name + " is not complete");
  }
  GLint samples = 0;
  gl.GetNamedFramebufferParameteriv(framebuffer, GL_SAMPLES, &samples);
  if (samples > 1) throw Error(Error::Kind::kWrongOrder, name + " is multisampled");
}

namespace {

// Mesa does not tell a texture's target in the compatibility profile; there any texture passes.
bool isTextureOf(const Context& context, GLuint texture, GLenum target) {
  const GladGLContext& gl = context.gl;
  if (!gl.IsTexture(texture)) return false;
  if (context.compatibility) return true;
  GLint found = 0;
  gl.GetTextureParameteriv(texture, GL_TEXTURE_TARGET, &found);
  return static_cast<GLenum>(found) == target;
}

}  // namespace

void requireAttached(const Context& context, GLuint framebuffer, GLenum attachment, GLuint texture,
                     const char* field) {
  if (texture == 0) return;
  const GladGLContext& gl = context.gl;
  const std::string name = std::string(field) + " (" + std::to_string(texture) + ")";
  if (!isTextureOf(context, texture, GL_TEXTURE_2D))
    throw Error(Error::Kind::kWrongOrder, name + " is no GL_TEXTURE_2D of this context");
  GLint attached = 0;
  if (framebuffer != 0) {
    gl.GetNamedFramebufferAttachmentParameteriv(framebuffer, attachment,
                                                GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME, &attached);
  }
  if (static_cast<GLuint>(attached) != texture) {
    throw Error(Error::Kind::kWrongOrder,
                name + " is not attached to framebuffer " + std::to_string(framebuffer));
  }
}

void requireCube(const Context& context, GLuint texture, const char* field) {
  if (texture == 0 || isTextureOf(context, texture, GL_TEXTURE_CUBE_MAP)) return;
  throw Error(Error::Kind::kWrongOrder, std::string(field) + " (" + std::to_string(texture) +
                                            ") is no GL_TEXTURE_CUBE_MAP of this context");
}

StateGuard::StateGuard(const Context& context, uint32_t touches, bool host_resets_state)
    : context_(context), touches_(touches) {
  const std::string obstacle = findObstacle(context);
  if (!obstacle.empty()) throw Error(Error::Kind::kWrongOrder, obstacle);
  if (!host_resets_state) {
    host_ = std::make_unique<HostState>();
    host_->save(context, touches);
  }
  setOurState(context, touches);
}

StateGuard::~StateGuard() {
  if (host_) host_->restore(context_, touches_);
}

void StateGuard::drawInto(GLuint host_framebuffer) {
  if (host_) {
    host_->framebuffer.drawInto(context_, host_framebuffer);
  } else {
    FramebufferState().drawInto(context_, host_framebuffer);
  }
}

void StateGuard::readFrom(GLuint host_framebuffer) {
  if (host_) {
    host_->framebuffer.readFrom(context_, host_framebuffer);
  } else {
    FramebufferState().readFrom(context_, host_framebuffer);
  }
}

namespace {

// Calls `visit(group)` for each group in `touches`, always in this order.
template <class State, class Visit>
void forEachGroup(State& state, uint32_t touches, const Visit& visit) {
  if (touches & RG_TOUCHED_PROGRAM) visit(state.program);
  if (touches & RG_TOUCHED_VERTEX_ARRAY) visit(state.vertex);
  if (touches & RG_TOUCHED_BUFFERS) visit(state.buffers);
  if (touches & RG_TOUCHED_TEXTURES) visit(state.textures);
  if (touches & RG_TOUCHED_IMAGES) visit(state.images);
  if (touches & RG_TOUCHED_FRAMEBUFFER) visit(state.framebuffer);
  if (touches & RG_TOUCHED_VIEWPORT) visit(state.viewport);
  if (touches & RG_TOUCHED_BLEND) visit(state.blend);
  if (touches & RG_TOUCHED_DEPTH) visit(state.depth);
  if (touches & RG_TOUCHED_RASTER) visit(state.raster);
  if (touches & RG_TOUCHED_PIXEL_STORE) visit(state.pixels);
}

}  // namespace

void HostState::save(const Context& context, uint32_t touches) {
  errors.take(context);
  forEachGroup(*this, touches, [&](auto& group) { group.save(context); });
}

void HostState::restore(const Context& context, uint32_t touches) const {
  forEachGroup(*this, touches, [&](const auto& group) { group.restore(context); });
  errors.raiseAgain(context);
}

}  // namespace rg::gl
