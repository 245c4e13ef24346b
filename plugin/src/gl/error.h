// What the GL layer throws. The ABI's edge turns the kind into a result code and the text into last_error().
#pragma once

#include <glad/gl.h>

#include <stdexcept>
#include <string>

namespace rg::gl {

class Error : public std::runtime_error {
 public:
  enum class Kind {
    kVersion,      // the context is not OpenGL 4.5
    kDriver,       // the driver refused something
    kOutOfMemory,  // GL_OUT_OF_MEMORY
    kWrongOrder    // the host's context is in a state the plugin cannot work in
  };
  Error(Kind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

// "GL_INVALID_ENUM" for 0x0500, and so on.
const char* errorName(GLenum error);

// Takes all pending GL errors. Throws the first as Error (kOutOfMemory or kDriver): "`what`:
// GL_INVALID_ENUM".
void throwOnError(const GladGLContext& gl, const char* what);

}  // namespace rg::gl
