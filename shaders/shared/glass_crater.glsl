// The crater that a raindrop throws up in a film, and how surface tension levels it. The film's grid has the drop's water and moves it; this is the
// shape of a moment in it, without volume of its own, for display. Runs in shaders/glass/look_crater.*, and in C++ for tests.
#ifndef RG_SHARED_GLASS_CRATER_GLSL
#define RG_SHARED_GLASS_CRATER_GLSL
#include "shared/compat.glsl"
RG_SHARED_BEGIN

// Grid metres as in GlassDropRecord.
struct CraterRecord {
  vec2 position_m;
  vec2 velocity_mps;     // of waves on the film, grid metres per second
  float width_m;         // s of the shape below when it was thrown up, real metres
  float film_m;          // as thick as the film was
  float levelling_m4_s;  // craterLevelling_m4_s of it
  float filling_hz;      // speed of the waves over width
  float age_s;
  float unused;
};
RG_SIZE(CraterRecord, 40)

RG_CONST float kCraterOpened = 0.8f; // share of the film that the crater's middle lacks at first (unsourced)
RG_CONST float kCraterReach = 3.5f;  // widths: beyond it nothing is seen of it

// A thin film levels by dh/dt = -B lap lap h, B = gamma h^3 / (3 mu) (Orchard 1962). Of the shape (1 - q) exp(-q), q = r^2 / 2s^2, which has no volume,
// depth times s^4 stays what it was; the depth falls to 1 / (1 + 11 B t / s^4), to a quarter of the exact integral at any time.
RG_FN float craterLevelling_m4_s(float film_m) { return 11.0f * 0.072f * film_m * film_m * film_m / (3.0f * 1.0e-3f); }

RG_FN float craterLevelled(RG_IN(CraterRecord) crater, float age_s) {
  float width4 = crater.width_m * crater.width_m * crater.width_m * crater.width_m;
  return width4 / (width4 + crater.levelling_m4_s * max(age_s, 0.0f));
}
RG_FN float craterWidth_m(RG_IN(CraterRecord) crater, float age_s) { return crater.width_m / sqrt(sqrt(craterLevelled(crater, age_s))); }

// Where the film flows it runs into the hole, in which what is left hardly moves, as a front: at [q] / [h] (Whitham 1974, Linear and Nonlinear Waves, ch. 2),
// with q = c h / 3 and c ~ h^2 that is 0.41 c; half of the hole's 2 sqrt(2) s is full when the front has gone half that way.
RG_CONST float kCraterFills = 0.29f; // of c / s
RG_FN float craterDepthLeft(RG_IN(CraterRecord) crater, float age_s) {
  return craterLevelled(crater, age_s) / (1.0f + kCraterFills * crater.filling_hz * max(age_s, 0.0f));
}

// Of the film's thickness, at a distance of r = width * sqrt(2 q): what is added to it, and what of r / width^2 its slope away from the middle is.
RG_FN float craterHeight(float q) { return -kCraterOpened * (1.0f - q) * exp(-q); }
RG_FN float craterSlope(float q) { return kCraterOpened * (2.0f - q) * exp(-q); }

RG_SHARED_END
#endif
