// The promise to the host: every GL call of the plugin leaves the context as it found it.
//
//   StateGuard guard(context, RG_TOUCHED_PROGRAM | RG_TOUCHED_TEXTURES | ..., host_resets_state);
//   guard.drawInto(target.framebuffer);
//   ...                                   // bind and draw; only what the mask names, only units below
//                                         // restored here
// What keeps the list short: objects are changed through direct state access; only the units and indices
// below are used; state that other state makes meaningless (a scissor box while the test is off) is neither
// set nor saved.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "gl/loader.h"
#include "rainglass/rainglass.h"

namespace rg::gl {

// All the plugin binds lies below these. GL 4.5 promises at least 16 texture units per stage and 8 image
// units; of shader storage it promises 8 bindings, of uniform buffers 36.
inline constexpr int kTextureUnits =
    8;  // of kinds 2D, 2D array, 3D and cube map; never unbound with name 0, which would unbind all kinds
inline constexpr int kImageUnits = 5;
inline constexpr int kUniformBindings = 4;
inline constexpr int kStorageBindings = 8;
inline constexpr int kDrawBuffers = 4;  // fragment outputs
inline constexpr int kViewports = 1;    // no shader writes gl_ViewportIndex

// Why the plugin cannot work in the state the host is in, or empty: transform feedback that runs, a query
// that would count our fragments. (Conditional rendering cannot be asked for.)
std::string findObstacle(const Context& context);

// Throws Error::kWrongOrder unless `framebuffer` is complete for drawing and single-sampled.
void requireDrawable(const Context& context, GLuint framebuffer);

// Throws Error::kWrongOrder, naming `field`, unless the texture is 0 or a GL_TEXTURE_2D that is attached
// there (level 0 of it).
void requireAttached(const Context& context, GLuint framebuffer, GLenum attachment, GLuint texture,
                     const char* field);
// The same unless it is 0 or a GL_TEXTURE_CUBE_MAP.
void requireCube(const Context& context, GLuint texture, const char* field);

// Puts everything in `touches` in the state the plugin draws with: no tests, no blending, no culling, all
// colour written, depth neither tested nor written, clip space as OpenGL's own, samplers and buffers for
// pixels unbound, pixel store at its defaults. A stage changes what it wants from there and need not put it
// back.
void setOurState(const Context& context, uint32_t touches);

struct HostState;

class StateGuard {
 public:
  // Remembers and clears the host's pending errors, saves what `touches` (RG_TOUCHED_*) names, then
  // setOurState. With `host_resets_state` nothing is saved or restored, and pending errors stay. Throws
  // Error::kWrongOrder when findObstacle finds one.
  StateGuard(const Context& context, uint32_t touches, bool host_resets_state = false);
  // Restores, and raises the host's error again (see pending_error.h).
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

  // Binds a framebuffer of the host for drawing. Of it only colour 0 is drawn until the guard ends, whatever
  // other draw buffers it has. At most one of the host's per guard; bind your own with glBindFramebuffer.
  // Needs RG_TOUCHED_FRAMEBUFFER.
  void drawInto(GLuint host_framebuffer);
  // Binds it for reading, and colour 0 as its read buffer (the back buffer of framebuffer 0).
  void readFrom(GLuint host_framebuffer);

  uint32_t touched() const { return touches_; }

 private:
  const Context& context_;
  uint32_t touches_;
  std::unique_ptr<HostState> host_;  // null when the host resets its state
};

}  // namespace rg::gl
