// The host's pending GL error. GL has no way to look at the error flag without taking it, nor to set it. So
// the flag is taken on entry and, on leaving, raised again by a call that is wrong in just that way and
// changes nothing, with debug output off meanwhile.
#pragma once

#include "gl/loader.h"

namespace rg::gl {

struct PendingErrors {
  GLenum first = GL_NO_ERROR;  // of several flags (distributed implementations) the first is kept
  void take(const Context& context);
  void raiseAgain(const Context& context) const;
};

// Makes glGetError return `error` where it would have returned GL_NO_ERROR. A stack error that cannot be had
// without popping what is the host's becomes GL_INVALID_OPERATION; GL_CONTEXT_LOST stays by itself.
void raiseError(const Context& context, GLenum error);

}  // namespace rg::gl
