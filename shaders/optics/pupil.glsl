// The pupil of an eye that looks past the glass: each of its points sees the water elsewhere before the world, and what is seen is the mean of all.
#ifndef RG_OPTICS_PUPIL_GLSL
#define RG_OPTICS_PUPIL_GLSL
#include "optics/look_frame.glsl"

// How far on the picture the pupil's rim sees a place of the glass from where its middle does.
float pupilRadius_px(vec3 from_eye) {
  float depth_m = -(mat3(frame.eye_from_vehicle) * from_eye).z;
  return 0.5 * frame.pupil_m * frame.pixels_per_rad / max(depth_m, 1e-4);
}

// The k-th of places all over a disc of radius 1 (Vogel 1979, Math. Biosci. 44).
vec2 placeOnDisc(int k, int places) {
  const float kGolden_rad = 2.3999632;
  float from_middle = sqrt((float(k) + 0.5) / float(places)), turn = kGolden_rad * float(k);
  return from_middle * vec2(cos(turn), sin(turn));
}
#endif
