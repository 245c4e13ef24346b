// A lamp for the look's shaders, as plugin/src/glass/look_lamps_gl.cpp fills it in.
#ifndef RG_OPTICS_LOOK_LAMP_GLSL
#define RG_OPTICS_LOOK_LAMP_GLSL

struct LookLamp {
  vec4 place_inner;      // xyz: from the eye, world axes, m; w: cosine of the inner cone
  vec4 direction_outer;  // xyz: where it shines; w: cosine of the outer cone, -1: to all sides
  vec4 intensity;        // rgb: radiant intensity
};
const int kMostLookLamps = 16;
#endif
