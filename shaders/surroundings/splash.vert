// A corner of a crown or droplet, as splash.comp has put it.
layout(location = 0) in vec4 corner_place;
layout(location = 1) in vec4 corner_foot;
layout(location = 2) in vec4 corner_size;
layout(location = 3) in vec4 corner_look;

#define FROM out
#include "surroundings/splash_told.glsl"

void main() {
  gl_Position = corner_place;
  splash_foot = corner_foot;
  splash_size = corner_size;
  splash_look = floatBitsToUint(corner_look);
}
