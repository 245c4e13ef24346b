// A drop on its way from look_place.comp, which works it out once, to look_drop.vert, which draws it.
#ifndef RG_OPTICS_SEEN_DROP_GLSL
#define RG_OPTICS_SEEN_DROP_GLSL

struct SeenDrop {
  vec4 position_radius;  // vehicle frame, m; w: half the base's width as drawn, m
  vec4 head_stretch;     // unit, vehicle frame: towards the drop's head; w: length by width of the base
  vec4 normal_reflections;  // unit, out of the glass; w: how many internal reflections to follow
  vec4 cap_outline;      // the cap's centre and radius in base radii; irregularity; taper
  vec4 reach;            // the rectangle to be drawn, where the base is a circle of radius 1: unit vector forth, how far ahead and behind
  vec4 beside_phase;     // how far to both sides; phase of the outline; weight (0: not to be drawn); samples along a pixel
  vec4 light_small;      // its mean light; w: > 0 for a drop so small that it is drawn with that alone, 2 for an eye outside
};
#endif
