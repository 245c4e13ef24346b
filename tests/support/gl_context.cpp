#include "gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "window/egl_displays.h"

namespace rg::test {
namespace {

// One display per process, never terminated: Mesa's own thread pools are set up only once, which keeps
// LeakSanitizer quiet.
EGLDisplay display() {
  static EGLDisplay opened = egl_first_display();
  return opened;
}

}  // namespace

struct GlContext::Egl {
  EGLContext context = EGL_NO_CONTEXT;
  Profile profile = Profile::kCore;
  int major = 0, minor = 0;
};

void* GlContext::getProc(void*, const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); }

GlContext::GlContext(Profile profile, int major, int minor) { start(profile, major, minor, nullptr); }

GlContext::GlContext(Profile profile, int major, int minor, const Egl* share) {
  start(profile, major, minor, share);
}

std::unique_ptr<GlContext> GlContext::shared() const {
  std::unique_ptr<GlContext> other(new GlContext(egl_->profile, egl_->major, egl_->minor, egl_.get()));
  makeCurrent();
  return other;
}

void GlContext::start(Profile profile, int major, int minor, const Egl* share) {
  if (display() == EGL_NO_DISPLAY || !eglBindAPI(EGL_OPENGL_API))
    throw std::runtime_error("EGL: no display for OpenGL");
  const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                     EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  eglChooseConfig(display(), wanted.data(), &config, 1, &count);
  const std::array<EGLint, 9> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                         major,
                                         EGL_CONTEXT_MINOR_VERSION,
                                         minor,
                                         EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                         profile == Profile::kCore
                                             ? EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT
                                             : EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                                         EGL_CONTEXT_OPENGL_DEBUG,
                                         EGL_TRUE,
                                         EGL_NONE};
  egl_ = std::make_unique<Egl>();
  *egl_ = {eglCreateContext(display(), count > 0 ? config : EGL_NO_CONFIG_KHR,
                            share ? share->context : EGL_NO_CONTEXT, attributes.data()),
           profile, major, minor};
  if (egl_->context == EGL_NO_CONTEXT) throw std::runtime_error("EGL: no such OpenGL context");
  makeCurrent();
  if (!gladLoadGLContextUserPtr(
          &gl, [](void*, const char* name) { return reinterpret_cast<GLADapiproc>(eglGetProcAddress(name)); },
          nullptr)) {
    throw std::runtime_error("glad: no OpenGL functions");
  }
  if (!gl.DebugMessageCallback) return;
  gl.Enable(GL_DEBUG_OUTPUT);
  gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  gl.DebugMessageCallback(
      [](GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text, const void* user) {
        if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
        auto* messages = static_cast<std::vector<GlMessage>*>(const_cast<void*>(user));
        messages->push_back({type, std::string(text, static_cast<size_t>(length))});
      },
      &messages_);
}

GlContext::~GlContext() {
  if (!egl_ || egl_->context == EGL_NO_CONTEXT) return;
  if (eglGetCurrentContext() == egl_->context)
    eglMakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display(), egl_->context);
}

void GlContext::makeCurrent() const {
  if (!eglMakeCurrent(display(), EGL_NO_SURFACE, EGL_NO_SURFACE, egl_->context))
    throw std::runtime_error("EGL: cannot make current");
}

std::vector<GlMessage> GlContext::takeMessages() {
  for (int i = 0; i < 8; ++i) {
    const GLenum error = gl.GetError();
    if (error == GL_NO_ERROR) break;
    if (messages_.empty()) messages_.push_back({GL_DEBUG_TYPE_ERROR, "glGetError " + std::to_string(error)});
  }
  return std::exchange(messages_, {});
}

}  // namespace rg::test
