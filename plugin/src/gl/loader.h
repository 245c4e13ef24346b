// The host's context as the plugin sees it: its functions, and the few facts about it that the GL layer
// decides by.
#pragma once

#include <glad/gl.h>

#include <memory>
#include <string>

#include "gl/error.h"

namespace rg::gl {

// The host's loader, as in rg_gl_info: address of a GL function by name, or null.
using GetProc = void* (*)(void* user, const char* name);

struct Context {
  GladGLContext gl{};
  bool compatibility = false;  // the profile has the fixed-function state too
  bool software = false;       // drawn on the CPU, where GPU timestamps mean nothing
  std::string vendor, renderer, version;
};

// Loads OpenGL 4.5 of the context that is current on this thread. Throws Error::kVersion that says what was
// found instead. On the heap, so that objects can keep pointers to it.
std::unique_ptr<Context> loadContext(GetProc getProc, void* user);

// Whether GL_RENDERER names a rasteriser that runs on the CPU.
bool isSoftwareRenderer(const std::string& renderer);

}  // namespace rg::gl
