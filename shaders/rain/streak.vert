// A corner of a streak, as streak.comp has put it. (One triangle about the streak in the place of two would spare a setup, but its empty parts
// cost software GL twice what that saves.)
layout(location = 0) in vec4 corner_place;
layout(location = 1) in vec4 corner_seen;
layout(location = 2) in vec4 corner_told;
layout(location = 3) in vec4 next_told;  // the next corner's: what is flat is taken from the first corner

layout(location = 0) noperspective out vec4 streak_seen;  // as of RainCorner
layout(location = 1) flat out vec4 streak_times;   // xy: of its ends, -1 .. 1 over the whole exposure; z: 1 / depth at its end, 1/m; w: half a pixel's
                                                  // width across it, px (< 1), + rainSolidCode
layout(location = 2) flat out vec4 streak_colour;  // rgb: as the target holds it; a: cover where it is densest

out vec4 fed_back;  // for transform feedback; no stage takes it, so that the linker leaves it out else

void main() {
  gl_Position = corner_place;
  streak_seen = corner_seen;
  streak_times = corner_told;
  streak_colour = next_told;
  fed_back = corner_told;
}
