// The look's programs. What is the same for all pixels of a draw is a variant of its own, not a branch:
// software GL runs both sides of one.
#pragma once

#include <cstdint>
#include <map>
#include <utility>

#include "gl/program.h"

struct GladGLContext;

namespace rg::glass {

enum class LookStage : uint8_t {
  cells,
  kinds,
  sort,
  list,
  water,
  craters,
  pane,
  fog,
  place,
  pick,
  drops,
  small_drops,
  unsharp,
  hide,
  halve
};

// Any of them together; those that a stage does not ask for make no difference to it.
enum LookVariant : uint32_t {
  kPlain = 0,
  kInside = 1,        // the eye is on the cabin's side of the glass
  kCoarse = 2,        // many pixels to a texel of the film
  kEnvironment = 4,   // there is a cube of what is all around
  kLamps = 8,         // lamps shine
  kEncoded = 16,      // the target holds sRGB
  kFilm = 32,         // there is film
  kBeads = 64,        // there are beads
  kMirror = 128,      // a mirror, seen from its wet side
  kRidges = 256,      // blades push ridges
  kEverywhere = 512,  // water may be anywhere: nobody has sorted the cells
  kApart = 1024,      // beads alone, by what they cover, to be blurred before they lie over the picture
  kSoft = 2048        // film alone, as an eye sees it that looks past it
};

// All that may be wanted of a pane whose mesh is cut into pieces, for targets of linear radiance, are made
// with it, so that no lamp, no ridge and no mirror that comes into view waits for a driver to compile (see
// gl::Building). Those for targets that hold sRGB are begun when the first is wanted, or, where a driver has
// no threads for that, made one by one.
class LookPrograms {
 public:
  explicit LookPrograms(const GladGLContext& gl);
  const gl::Program& use(LookStage stage, uint32_t variant = kPlain);
  void forget();  // the context is gone

 private:
  void makeAll(uint32_t encoded);
  const gl::Program& made(LookStage stage, uint32_t variant);

  const GladGLContext* gl_;
  std::map<std::pair<LookStage, uint32_t>, gl::Program> programs_;  // by what of a variant makes a difference
};

}  // namespace rg::glass
