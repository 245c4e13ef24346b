#include "gl/pending_error.h"

#include <limits>

namespace rg::gl {
namespace {

// An empty framebuffer of size 0 is never complete; neither blit nor clear gets past that.
void raiseFramebufferError(const GladGLContext& gl) {
  GLuint empty = 0;
  gl.CreateFramebuffers(1, &empty);
  gl.BlitNamedFramebuffer(empty, empty, 0, 0, 1, 1, 0, 0, 1, 1, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl.DeleteFramebuffers(1, &empty);
}

// No machine has an address space of which this would be a part.
void raiseOutOfMemory(const GladGLContext& gl) {
  GLuint buffer = 0;
  gl.CreateBuffers(1, &buffer);
  gl.NamedBufferData(buffer, std::numeric_limits<GLsizeiptr>::max() / 2, nullptr, GL_STATIC_DRAW);
  gl.DeleteBuffers(1, &buffer);
}

// The name 2^32 - 1 was never generated.
void raiseInvalidOperation(const GladGLContext& gl) {
  gl.BindVertexArray(std::numeric_limits<GLuint>::max());
}

// The stack of debug groups is there in every context, and what we push on it we can pop.
void raiseStackOverflow(const GladGLContext& gl) {
  GLint limit = 0, pushed = 0;
  gl.GetIntegerv(GL_MAX_DEBUG_GROUP_STACK_DEPTH, &limit);
  GLint depth = 0;
  for (gl.GetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth); depth + pushed < limit; ++pushed) {
    gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, 1, " ");
  }
  gl.PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, 1, " ");
  for (; pushed > 0; --pushed) gl.PopDebugGroup();
}

void raiseStackUnderflow(const GladGLContext& gl) {
  GLint depth = 0;
  gl.GetIntegerv(GL_DEBUG_GROUP_STACK_DEPTH, &depth);
  if (depth <= 1) {
    gl.PopDebugGroup();
  } else {
    raiseInvalidOperation(gl);
  }
}

void raise(const GladGLContext& gl, GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return gl.Enable(0xFFFF);
    case GL_INVALID_VALUE:
      return gl.Viewport(0, 0, -1,
                         -1);  // no clear: where nothing is bound to draw into, that is another error
    case GL_INVALID_OPERATION:
      return raiseInvalidOperation(gl);
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return raiseFramebufferError(gl);
    case GL_OUT_OF_MEMORY:
      return raiseOutOfMemory(gl);
    case GL_STACK_OVERFLOW:
      return raiseStackOverflow(gl);
    case GL_STACK_UNDERFLOW:
      return raiseStackUnderflow(gl);
    default:
      return;
  }
}

}  // namespace

void PendingErrors::take(const Context& context) {
  first = context.gl.GetError();
  if (first == GL_NO_ERROR) return;
  // A lost context answers GL_CONTEXT_LOST for ever; eight flags are more than GL has.
  for (int i = 0; i < 8 && context.gl.GetError() != GL_NO_ERROR; ++i) {
  }
}

void PendingErrors::raiseAgain(const Context& context) const {
  if (first != GL_NO_ERROR) raiseError(context, first);
}

void raiseError(const Context& context, GLenum error) {
  const GladGLContext& gl = context.gl;
  const bool debug = gl.IsEnabled(GL_DEBUG_OUTPUT);
  gl.Disable(GL_DEBUG_OUTPUT);
  raise(gl, error);
  if (debug) gl.Enable(GL_DEBUG_OUTPUT);
}

}  // namespace rg::gl
