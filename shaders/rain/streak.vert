// A corner of a streak, as streak.comp has put it. (One triangle about the streak in the place of two would spare a setup, but its empty parts
// cost software GL twice what that saves.)
layout(location = 0) in vec4 corner_place;
layout(location = 1) in vec4 told_line;
layout(location = 2) in vec4 told_depths;
layout(location = 3) in vec4 told_ends;
layout(location = 4) in vec4 told_colour;

layout(location = 0) flat out vec4 streak_line;    // xy: where it begins, window px; zw: its direction there
layout(location = 1) flat out vec4 streak_depths;  // x: 1 / its length, 1/px; yz: 1 / depth at its ends, 1/m; w: half a pixel's width across it, px (< 1), + rainSolidCode
layout(location = 2) flat out vec4 streak_ends;    // of its ends: xy: times, -1 .. 1 over the whole exposure; zw: 1 / radius, 1/px
layout(location = 3) flat out vec4 streak_colour;  // rgb: as the target holds it; a: cover where it is densest

out float corner_extra;  // for transform feedback; no stage takes it, so that the linker leaves it out else

void main() {
  gl_Position = vec4(corner_place.xyz, 1.0);
  streak_line = told_line;
  streak_depths = told_depths;
  streak_ends = told_ends;
  streak_colour = told_colour;
  corner_extra = corner_place.w;
}
