// A drop on its way from look_place.comp, which works it out once, to those that draw it.
#ifndef RG_OPTICS_SEEN_DROP_GLSL
#define RG_OPTICS_SEEN_DROP_GLSL

struct SeenDrop {
  vec4 position_radius;  // vehicle frame, m: of the head's circle; w: half the base's width as drawn, m
  vec4 head_stretch;     // unit, vehicle frame: towards the drop's head; w: length by width of the base, or of its head if it has a tail
  vec4 normal_reflections;  // unit, out of the glass; w: how many internal reflections to follow
  vec4 cap_outline;      // the cap's centre and radius in base radii; irregularity; its tail (Cap), < 0 if the record's heading leads there
  vec4 reach;            // the rectangle to be drawn, where the base is a circle of radius 1: unit vector forth, how far ahead and behind
  vec4 beside_phase;     // how far to both sides; phase of the outline; weight; samples along a pixel
  vec4 light_weight;     // of a small drop: its mean light; weight, negative for an eye outside
  // Clip space: the base's middle, and what a base radius along the head and across adds; of a small drop the ellipse's middle and half axes.
  vec4 clip_middle;
  vec4 clip_along;
  vec4 clip_across;
};

// What is drawn of a drop. A small one shows no more than its mean light.
const uint kUnseenDrop = 0u, kSmallDrop = 1u, kLargeDrop = 2u;

#endif
