#include "off_screen.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <stdexcept>

#include "window/egl_displays.h"

namespace bench {

GladGLContext makeContext() {
  EGLDisplay display = egl_first_display();
  if (display == EGL_NO_DISPLAY) throw std::runtime_error("there is no EGL");
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                           4,
                           EGL_CONTEXT_MINOR_VERSION,
                           5,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                           EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                           EGL_NONE};
  const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    throw std::runtime_error("there is no OpenGL 4.5 with the compatibility profile");
  GladGLContext gl{};
  if (gladLoadGLContext(&gl, eglGetProcAddress) == 0)
    throw std::runtime_error("OpenGL's functions cannot be loaded");
  return gl;
}

void* getProc(void*, const char* name) {
  const auto function = eglGetProcAddress(name);
  void* address = nullptr;
  std::memcpy(&address, &function, sizeof address);
  return address;
}

}  // namespace bench
