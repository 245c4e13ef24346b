// What a wet surface looks like beside the same one dry. In GLSL, declare `RainShelter rain_shelter` before including this.
#ifndef RG_SHARED_WET_GLSL
#define RG_SHARED_WET_GLSL
#include "shared/hash.glsl"
#include "shared/rain_streak.glsl"
RG_SHARED_BEGIN

// One uniform block a draw.
struct WetView {
  vec4 ray_middle;  // the view ray through clip (x, y) is middle + x right + y up, as long as makes its depth 1
  vec4 ray_right;
  vec4 ray_up;
  vec4 fall_wet;  // xyz: the drops' velocity, m/s; w: how much of all this is drawn, 0 .. 1
  vec4 water;     // x: on open ground, mm; yz: the eye's place in the patches' pattern, m
};
RG_SIZE(WetView, 80)

// Whether rain that falls so reached a place in the past: what stands keeps it off all that is down-stream, what moves only what is within it.
// Surfaces lie in volumes' faces: the last of the way, `skin_m` in height, does not count.
RG_FN bool wetIsSheltered(vec3 place, vec3 fall_mps, float skin_m RG_RAIN_SHELTER) {
  float skin_s = skin_m / abs(fall_mps.z);
  for (uint i = 0u; i < rain_shelter.volume_count; ++i) {
    bool moves = rain_shelter.volumes[i].velocity.w > 0.0f;
    float from_s = moves ? -2.0f * skin_s : -60.0f / length(fall_mps);
    if (!rainMayTouch(i, place, fall_mps, from_s, 0.0f, 0.0f RG_RAIN_SHELTER_PASS)) continue;
    vec2 inside = rainTimesInside(i, place, fall_mps, 0.0f RG_RAIN_SHELTER_PASS);
    if (inside.x < inside.y && inside.x < -skin_s && (!moves || inside.y > -skin_s)) return true;
  }
  return false;
}

// Grounds are uneven: here they hold half as much again, there half as much, in patches of some decimetres (by eye). Repeats, so that it can be told
// far from the origin too.
RG_CONST float kWetPatch_m = 0.4f;
RG_CONST int kWetPatches = 1024;
RG_CONST float kWetRepeat_m = 409.6f;
RG_FN float wetPatchAt(int x, int y) { return unitFloat(pcg3d(uvec3(uint(x & (kWetPatches - 1)), uint(y & (kWetPatches - 1)), 3u)).x); }
RG_FN float wetPatch(vec2 place_m) {
  vec2 at = place_m / kWetPatch_m, cell = floor(at), in_cell = at - cell, t = in_cell * in_cell * (3.0f - 2.0f * in_cell);
  int x = int(cell.x), y = int(cell.y);
  return 0.5f + mix(mix(wetPatchAt(x, y), wetPatchAt(x + 1, y), t.x), mix(wetPatchAt(x, y + 1), wetPatchAt(x + 1, y + 1), t.x), t.y);
}

// First drops soak in and darken what they meet: the share that no drop has met falls by 1 / e with each 0.1 mm (by eye: with some 1 mm drops'
// spots of twice their width that is what their number covers).
RG_FN float wetDarkened(float water_mm) { return 1.0f - exp(-10.0f * water_mm); }

// Then water fills the texture from below; what is full lies as flat as a mirror. Asphalt's macrotexture is 0.5 to 1 mm deep (as `kMostOnGround_mm`).
RG_FN float wetFilled(float water_mm) { return smoothstep(0.1f, 1.2f, water_mm); }

// What a wet porous surface sends back of what it does dry: Lekner & Dorf 1988, eqs. for n = 1.5. Its albedo cannot be known from the picture:
// that of asphalt and earth, 0.2, is taken for all (between 0.1 and 0.3 the factor is 0.71 to 0.64).
RG_FN float wetAlbedoFactor() {
  float dry = 0.2f, taken = 1.0f - dry;
  float wet = taken * (dry * 1.068f + taken);
  return (1.0f - 0.9796f * wet / (1.0f - 0.475f * (1.0f - wet))) / dry;
}

// What water's surface mirrors at a cosine of incidence (Schlick 1994).
RG_FN float wetMirrors(float cosine) {
  float away = 1.0f - clamp(cosine, 0.0f, 1.0f), square = away * away;
  return 0.02f + 0.98f * square * square * away;
}

RG_SHARED_END
#endif
