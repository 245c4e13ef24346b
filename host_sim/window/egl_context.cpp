#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <vector>

#include "window/context.h"

namespace host {
namespace {

bool has(const char* extensions, const char* name) {
  return extensions != nullptr && std::strstr(extensions, name) != nullptr;
}

template <typename Function>
Function load(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// GPUs first, then Mesa's surfaceless platform, then devices that are software.
std::vector<EGLDisplay> displays() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto get_display = load<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  std::vector<EGLDisplay> found, software;
  if (get_display == nullptr) return found;
  if (has(client, "EGL_EXT_platform_device") && has(client, "EGL_EXT_device_enumeration")) {
    const auto query_devices = load<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto query_string = load<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (query_devices != nullptr) query_devices(16, devices, &count);
    for (EGLint i = 0; i < count; ++i) {
      const bool is_software =
          query_string && has(query_string(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
      (is_software ? software : found).push_back(get_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
    }
  }
  if (has(client, "EGL_MESA_platform_surfaceless")) {
    found.push_back(get_display(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr));
  }
  found.insert(found.end(), software.begin(), software.end());
  return found;
}

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
  for (EGLDisplay display : displays()) {
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
