#include "context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cmath>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace compare {

GladGLContext makeContext() {
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (!eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
    throw std::runtime_error("there is no EGL");
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

Target::Target(const GladGLContext& context) : gl(context) {
  gl.CreateTextures(GL_TEXTURE_2D, 1, &colour);
  gl.CreateTextures(GL_TEXTURE_2D, 1, &depth);
  gl.TextureStorage2D(colour, 1, GL_RGBA16F, kWidth_px, kHeight_px);
  gl.TextureStorage2D(depth, 1, GL_DEPTH_COMPONENT32F, kWidth_px, kHeight_px);
  gl.CreateFramebuffers(1, &framebuffer);
  gl.NamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, colour, 0);
  gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, depth, 0);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.Viewport(0, 0, kWidth_px, kHeight_px);
}

void Cover::add(const Target& target) {
  std::vector<float> red(size_t{kWidth_px} * kHeight_px);
  target.gl.GetTextureImage(target.colour, 0, GL_RED, GL_FLOAT,
                            static_cast<GLsizei>(red.size() * sizeof(float)), red.data());
  for (size_t i = 0; i < red.size(); ++i) {
    const size_t column = i % kWidth_px / kBlock_px, row = i / kWidth_px / kBlock_px;
    black_[row * kColumns + column] += red[i] > 0.0f ? 0.0 : 1.0;
  }
  pictures_ += 1.0;
}

double Cover::px() const {
  static_assert(kWidth_px % kBlock_px == 0 && kHeight_px % kBlock_px == 0);
  const double pixels = kBlock_px * kBlock_px * pictures_;
  double sum = 0.0;
  for (const double black : black_) sum -= kBlock_px * kBlock_px * std::log(std::max(black, 0.5) / pixels);
  return sum;
}

}  // namespace compare
