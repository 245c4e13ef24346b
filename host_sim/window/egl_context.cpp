#include <array>

#include "window/context.h"
#include "window/egl_displays.h"

namespace host {
namespace {

class EglContext final : public Context {
 public:
  EglContext(EGLDisplay display, bool debug) : display_(display) {
    // A context without the asked version is made too, so that a person is told what is there.
    for (const EGLint minor : {5, 3, 1}) {
      if (create(minor == 5 ? 4 : 3, minor, debug && minor == 5)) break;
    }
    if (context_ == EGL_NO_CONTEXT) throw NoGl45("OpenGL 4.5 is needed; found no OpenGL by " + driver());
    if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
      destroy();
      throw NoGl45("OpenGL 4.5 is needed; EGL of " + driver() + " cannot draw without a surface");
    }
    try {
      load(debug);
    } catch (...) {
      destroy();
      throw;
    }
  }
  ~EglContext() override { destroy(); }

 private:
  Proc proc(const char* name) const override { return eglGetProcAddress(name); }

  bool create(EGLint major, EGLint minor, bool debug) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display_, wanted, &config, 1, &count) || count == 0) config = nullptr;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 major,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 minor,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 debug ? EGL_TRUE : EGL_FALSE,
                                 EGL_NONE};
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes);
    return context_ != EGL_NO_CONTEXT;
  }
  std::string driver() const {
    const char* vendor = eglQueryString(display_, EGL_VENDOR);
    return vendor ? vendor : "EGL";
  }
  void destroy() {
    if (context_ == EGL_NO_CONTEXT) return;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    context_ = EGL_NO_CONTEXT;
  }

  EGLDisplay display_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> makeHeadlessContext(bool debug) {
  std::string why = "OpenGL 4.5 is needed; found no EGL that draws without a display";
  std::array<EGLDisplay, kMostEglDisplays> displays{};
  const int count = egl_displays(displays.data());
  for (int i = 0; i < count; ++i) {
    const EGLDisplay display = displays[static_cast<size_t>(i)];
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
      continue;
    try {
      return std::make_unique<EglContext>(display, debug);
    } catch (const NoGl45& found) {
      why = found.what();
    }
  }
  throw NoGl45(why);
}

}  // namespace host
