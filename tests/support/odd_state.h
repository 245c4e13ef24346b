// Sets a context's state to something a guest would never expect: as a hostile host does, or (within what the
// plugin has to itself) as a messy guest does. The two variants differ in every item, so that whatever is not
// put back shows.
#pragma once

#include <array>
#include <vector>

#include "gl_context.h"

namespace rg::test {

// Below which indices, and whether state beyond the plugin's own (current attributes, stencil functions,
// matrices ...) is changed too.
struct OddScope {
  bool host = true;
  GLuint texture_units = 32;
  GLuint image_units = 8;
  GLuint uniform_bindings = 24;
  GLuint storage_bindings = 8;
  GLuint draw_buffers = 8;
  GLuint viewports = 16;
};

class OddState {
 public:
  static constexpr int kSize = 64;  // of the framebuffers

  OddState(const GladGLContext& gl, Profile profile);
  ~OddState();
  OddState(const OddState&) = delete;
  OddState& operator=(const OddState&) = delete;

  // variant 0 or 1.
  void apply(size_t variant, const OddScope& scope = {}) const;
  // Of variant: three colour attachments and depth; draw buffers {none, 2, 1}, read buffer 2.
  GLuint framebuffer(size_t variant) const { return framebuffers_[variant]; }
  // As apply() leaves it with both framebuffers' draw and read buffers as they were made.
  void resetDrawBuffers() const;

 private:
  static constexpr size_t kKinds = 11;
  static constexpr size_t kBuffers = 16;
  void makeTextures(size_t variant);
  void makeFramebuffer(size_t variant);
  void flip(GLenum name, bool on) const;
  void bindings(size_t v, const OddScope& scope) const;
  void textures(size_t v, const OddScope& scope) const;
  void buffers(size_t v, const OddScope& scope) const;
  void switches(size_t v, const OddScope& scope) const;
  void viewports(size_t v, const OddScope& scope) const;
  void blending(size_t v, const OddScope& scope) const;
  void raster(size_t v) const;
  void pixels(size_t v) const;
  void hostOnly(size_t v) const;
  void compatibility(size_t v, const OddScope& scope) const;

  const GladGLContext& gl;
  Profile profile_;
  std::array<GLuint, 2> programs_{}, pipelines_{}, vertex_arrays_{}, samplers_{}, framebuffers_{},
      renderbuffers_{}, feedbacks_{};
  std::array<std::array<GLuint, kBuffers>, 2> buffers_{};
  std::array<std::array<GLuint, kKinds>, 2> textures_{};
  std::vector<GLuint> attachments_;
};

}  // namespace rg::test
