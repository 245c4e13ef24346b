// A corner of a streak, as streak.comp has put it. (One triangle about the streak in the place of two would spare a setup, but its empty parts
// cost software GL twice what that saves.) What is the same for all of a streak is told with its first corner, half of it by the next one.
layout(location = 0) in vec4 corner_place;
layout(location = 1) in vec4 corner_line;
layout(location = 2) in vec4 next_look;
layout(location = 3) in vec4 next_told;
layout(location = 4) in vec4 corner_told;

#define FROM out
#include "rain/streak_told.glsl"

out vec4 fed_back;  // for transform feedback; no stage takes it, so that the linker leaves it out else

void main() {
  gl_Position = corner_place;
  streak_line = corner_line;
  streak_look = floatBitsToUint(next_look);
#ifdef SOFT_DEPTH
  streak_per_depth = 1.0 / next_told.y;
#endif
#ifdef SOLIDS
  streak_solid = next_told.w;
#endif
  fed_back = corner_told;
}
