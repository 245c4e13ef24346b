// An OpenGL 4.5 core context, made current on the thread that made it: by EGL without a display, or by GLFW
// in a window.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

namespace host {

/// No OpenGL 4.5 is to be had; what() says what was found, e.g. "OpenGL 4.5 is needed; found OpenGL 3.3 by
/// Mesa".
struct NoGl45 : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const GladGLContext& gl() const { return gl_; }
  /// Loader for the plugin (rg_gl_info::get_proc with get_proc_user = this context).
  static void* getProc(void* context, const char* name);
  /// GL errors since the context was made. With `debug` all of them, told by the driver when they happen,
  /// their first texts on standard error; else the kinds that happened. With the context current.
  std::uint64_t glErrors() const;
  std::string vendor() const { return text(GL_VENDOR); }
  std::string rendererName() const { return text(GL_RENDERER); }
  std::string version() const { return text(GL_VERSION); }

 protected:
  using Proc = void (*)();
  virtual Proc proc(const char* name) const = 0;
  /// To be called with the context current: loads GL, asks for 4.5, collects errors. Throws NoGl45.
  void load(bool debug);

 private:
  struct Errors {
    std::uint64_t count = 0;
  };
  std::string text(GLenum name) const;
  static void GLAD_API_PTR onMessage(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                     const GLchar* text, const void* user);

  GladGLContext gl_{};
  bool debug_ = false;
  std::unique_ptr<Errors> errors_ = std::make_unique<Errors>();
};

/// A context without display: a GPU by EGL's device platform, else Mesa's surfaceless platform (software).
/// `debug` has the driver check and tell errors at once. Throws NoGl45.
std::unique_ptr<Context> makeHeadlessContext(bool debug);

}  // namespace host
