// An OpenGL context without a window, for tests: EGL on Mesa's surfaceless platform or on a device. It is a
// debug context: whatever the driver calls an error or undefined behaviour fails the test it happens in.
#pragma once

#include <glad/gl.h>

#include <memory>
#include <string>
#include <vector>

namespace rg::test {

enum class Profile { kCore, kCompatibility };

// A debug message worth failing for.
struct GlMessage {
  GLenum type = 0;
  std::string text;
};

class GlContext {
 public:
  // Makes it current on this thread. Throws std::runtime_error when there is no OpenGL `major`.`minor`.
  explicit GlContext(Profile profile = Profile::kCore, int major = 4, int minor = 5);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  GladGLContext gl{};
  void makeCurrent() const;
  // A second context of the same kind that shares objects with this one; not current. Destroy it before this
  // one.
  std::unique_ptr<GlContext> shared() const;

  // Errors and undefined behaviour since the last call; takes glGetError's flags too. Empty when all is
  // clean.
  std::vector<GlMessage> takeMessages();

  // As rg_gl_info wants it; `user` is not used.
  static void* getProc(void* user, const char* name);

 private:
  struct Egl;
  GlContext(Profile profile, int major, int minor, const Egl* share);
  void start(Profile profile, int major, int minor, const Egl* share);
  std::unique_ptr<Egl> egl_;
  std::vector<GlMessage> messages_;
};

}  // namespace rg::test
