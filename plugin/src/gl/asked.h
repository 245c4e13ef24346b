#pragma once
// What a context answers when asked for one number.

#include <glad/gl.h>

namespace rg::gl {

inline GLuint asName(GLint value) { return static_cast<GLuint>(value); }
inline GLenum asEnum(GLint value) { return static_cast<GLenum>(value); }

inline GLint integer(const GladGLContext& gl, GLenum name) {
  GLint value = 0;
  gl.GetIntegerv(name, &value);
  return value;
}

inline GLint integer(const GladGLContext& gl, GLenum name, GLuint index) {
  GLint value = 0;
  gl.GetIntegeri_v(name, index, &value);
  return value;
}

}  // namespace rg::gl
