#include "gl/error.h"

namespace rg::gl {

const char* errorName(GLenum error) {
  switch (error) {
    case GL_NO_ERROR:
      return "GL_NO_ERROR";
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_STACK_OVERFLOW:
      return "GL_STACK_OVERFLOW";
    case GL_STACK_UNDERFLOW:
      return "GL_STACK_UNDERFLOW";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST";
    default:
      return "an unknown GL error";
  }
}

void throwOnError(const GladGLContext& gl, const char* what) {
  const GLenum first = gl.GetError();
  // A lost context answers GL_CONTEXT_LOST for ever; eight flags are more than GL has.
  for (int i = 0; i < 8 && gl.GetError() != GL_NO_ERROR; ++i) {
  }
  if (first == GL_NO_ERROR) return;
  const auto kind = first == GL_OUT_OF_MEMORY ? Error::Kind::kOutOfMemory : Error::Kind::kDriver;
  throw Error(kind, std::string(what) + ": " + errorName(first));
}

}  // namespace rg::gl
