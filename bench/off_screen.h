// OpenGL 4.5 without a window.
#pragma once

#include <glad/gl.h>

namespace bench {

// With the old functions, which OpenSceneGraph wants. Made current for good. Throws std::runtime_error.
GladGLContext makeContext();
// As rg_gl_info wants it.
void* getProc(void* user, const char* name);

}  // namespace bench
