// A splash, as splash.comp has put it.
layout(location = 0) in vec4 point_place;
layout(location = 1) in vec4 point_foot;
layout(location = 2) in vec4 point_size;
layout(location = 3) in vec4 point_look;

#define FROM out
#include "surroundings/splash_told.glsl"

void main() {
  gl_Position = vec4(point_place.xyz, 1.0);
  gl_PointSize = point_place.w;
  splash_foot = point_foot;
  splash_size = point_size;
  splash_look = floatBitsToUint(point_look);
}
