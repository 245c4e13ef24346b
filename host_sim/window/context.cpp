#include "window/context.h"

#include <cstdio>

namespace host {
namespace {

constexpr std::uint64_t kTextsShown = 20;

GLADapiproc loadProc(void* context, const char* name) {
  return reinterpret_cast<GLADapiproc>(Context::getProc(context, name));
}

}  // namespace

void* Context::getProc(void* context, const char* name) {
  return reinterpret_cast<void*>(static_cast<Context*>(context)->proc(name));
}

void Context::load(bool debug) {
  const int version = gladLoadGLContextUserPtr(&gl_, loadProc, this);
  if (version == 0) throw NoGl45("OpenGL 4.5 is needed; the driver's functions cannot be loaded");
  if (version < GLAD_MAKE_VERSION(4, 5)) {
    throw NoGl45("OpenGL 4.5 is needed; found OpenGL " + this->version() + " by " + rendererName());
  }
  debug_ = debug;
  if (!debug) return;
  gl_.Enable(GL_DEBUG_OUTPUT);
  gl_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl_.DebugMessageCallback(&Context::onMessage, errors_.get());
}

std::uint64_t Context::glErrors() const {
  // A lost context answers for ever; eight flags are more than GL has.
  for (int i = 0; i < 8 && gl_.GetError() != GL_NO_ERROR; ++i) errors_->count += debug_ ? 0 : 1;
  return errors_->count;
}

std::string Context::text(GLenum name) const {
  const GLubyte* found = gl_.GetString(name);
  return found ? reinterpret_cast<const char*>(found) : "unknown";
}

void GLAD_API_PTR Context::onMessage(GLenum, GLenum type, GLuint id, GLenum severity, GLsizei,
                                     const GLchar* text, const void* user) {
  // Performance hints and notifications are the driver's talk; errors, undefined and deprecated use are ours.
  const bool ours = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
                    type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR || severity == GL_DEBUG_SEVERITY_HIGH;
  if (!ours) return;
  Errors& errors = *static_cast<Errors*>(const_cast<void*>(user));
  if (++errors.count <= kTextsShown) std::fprintf(stderr, "GL error %u: %s\n", id, text);
}

}  // namespace host
