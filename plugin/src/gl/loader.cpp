#include "gl/loader.h"

#include <array>

namespace rg::gl {
namespace {

struct HostLoader {
  GetProc getProc;
  void* user;
};

GLADapiproc loadForGlad(void* host, const char* name) {
  const auto* loader = static_cast<const HostLoader*>(host);
  return reinterpret_cast<GLADapiproc>(loader->getProc(loader->user, name));
}

std::string text(const GladGLContext& gl, GLenum name) {
  const GLubyte* found = gl.GetString(name);
  return found ? reinterpret_cast<const char*>(found) : "";
}

[[noreturn]] void refuse(const std::string& found) {
  throw Error(Error::Kind::kVersion, "OpenGL 4.5 is needed; found " + found);
}

std::string describe(const Context& context) {
  return "OpenGL " + context.version + " (" + context.renderer + ")";
}

// A get_proc may hand out addresses of functions the context does not have, and may lack some it should have.
void requireFunctions(const Context& context) {
  const GladGLContext& gl = context.gl;
  const bool complete = gl.CreateBuffers && gl.CreateTextures && gl.ClipControl && gl.NamedBufferStorage &&
                        gl.DispatchCompute && gl.QueryCounter && gl.FenceSync && gl.BindTextureUnit &&
                        gl.ObjectLabel && gl.DrawElementsIndirect;
  if (!complete) refuse(describe(context) + ", but get_proc gives null for some of its functions");
}

}  // namespace

bool isSoftwareRenderer(const std::string& renderer) {
  static constexpr std::array kNames{"llvmpipe",   "softpipe", "swrast", "SwiftShader", "Software Rasterizer",
                                     "GDI Generic"};
  for (const char* name : kNames) {
    if (renderer.find(name) != std::string::npos) return true;
  }
  return false;
}

std::unique_ptr<Context> loadContext(GetProc getProc, void* user) {
  auto context = std::make_unique<Context>();
  HostLoader loader{getProc, user};
  GladGLContext& gl = context->gl;
  const int loaded = gladLoadGLContextUserPtr(&gl, loadForGlad, &loader);
  gl.userptr = nullptr;
  if (loaded == 0) refuse(gl.GetString ? "no current context" : "a get_proc that does not know glGetString");
  context->vendor = text(gl, GL_VENDOR);
  context->renderer = text(gl, GL_RENDERER);
  context->version = text(gl, GL_VERSION);
  if (context->version.rfind("OpenGL ES", 0) == 0) refuse(context->version + " (" + context->renderer + ")");
  if (!gl.VERSION_4_5) refuse(describe(*context));
  requireFunctions(*context);
  GLint profile = 0;
  gl.GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  context->compatibility = (profile & GL_CONTEXT_COMPATIBILITY_PROFILE_BIT) != 0;
  context->software = isSoftwareRenderer(context->renderer);
  return context;
}

}  // namespace rg::gl
