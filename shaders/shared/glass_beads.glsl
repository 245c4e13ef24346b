// Beads: the small drops of a texel, kept as their volume and their number. They lie still, dry, grow together where they are crowded, join a
// film that flows over them, and are what a film that breaks up leaves. Where they lie within the texel is a hash's choice, the same for all who
// ask. Runs in shaders/glass/ and in C++.
#ifndef RG_SHARED_GLASS_BEADS_GLSL
#define RG_SHARED_GLASS_BEADS_GLSL
#include "shared/compat.glsl"
#include "shared/glass_types.glsl"
#include "shared/hash.glsl"
RG_SHARED_BEGIN

// Packed: the number in the upper 8 bits, the volume below. One is 0 where the other is.
struct Beads {
  int volume_pl;
  int number;
};
RG_CONST int kMostBeads_pl = 0xffffff;
RG_CONST int kMostBeads = 64;  // of a texel; the number has 8 bits, and products with volumes stay below 2^31
RG_FN Beads beadsOf(uint code) {
  Beads beads;
  beads.volume_pl = int(code & 0xffffffu);
  beads.number = int(code >> 24u);
  return beads;
}
RG_FN Beads noBeads() { return beadsOf(0u); }
RG_FN uint packedBeads(RG_IN(Beads) beads) { return uint(beads.volume_pl) | (uint(beads.number) << 24u); }

// Base radius of the largest: what is larger wind and weight may move, and so it is a drop. On glass that holds less it is less (mostBead_m3 in
// glass/film_order.h).
RG_CONST float kMostBead_m = 1.1e-3f;

// Share of the glass that beads cover before they touch and run together: with more there is no room between (rain on a pane, by eye; drops of
// one size that lie anywhere jam at 0.55).
RG_CONST float kCrowded = 0.4f;
// A lone bead as wide as its texel, on 0.9 of its area, is a film there: in terms of beadsCovering, (kCrowded / 0.9)^3.
RG_CONST float kFlooded = 0.088f;

// Cube root by steps that CPU and GPU do alike, without division: x times the square of x^(-1/3), which is a guess by the exponent (3 %) and three of
// Newton's steps.
RG_FN float cubeRoot(float x) {
  RG_EXACT float y = uintBitsToFloat(0x54a2fa8cu - floatBitsToUint(x) / 3u);
  for (int k = 0; k < 3; ++k) y = y * (1.3333333f - x * 0.33333333f * y * y * y);
  RG_EXACT float root = x * y * y;
  return root;
}

// a / b in whole numbers: a < 2^32, 0 < b < 2^30. Software GL divides floats eight at a time, integers one by one; floats' quotient is off by one at
// most, which is mended, where it is below 2^20, or a below 2^24. (On a GPU, whose division may be off by 2.5 ulp, there below 2^22.)
RG_FN int quotient(uint a, int b) {
  int whole = int((float(int(a >> 1u)) + 0.25f) / float(b) * 2.0f), rest = int(a - uint(whole) * uint(b));
  return whole + int(rest >= b) - int(rest < 0);
}

// By chance a whole number from 0, below `end`.
RG_FN int upTo(int end, uint chance) {
  RG_EXACT float at = unitFloat(chance) * float(end);
  return min(int(at), end - 1);
}

// Of each, if all are alike, in whole picolitres.
RG_FN int meanBead_pl(RG_IN(Beads) beads) { return quotient(uint(beads.volume_pl), max(beads.number, 1)); }

// Radius of the base of beads of the same volume each. `mm3_per_pl`: the cube of that of a picolitre, by the contact angle: V = R^3 capShape
// (glass/water.h).
RG_FN float beadRadius_mm(RG_IN(Beads) beads, float mm3_per_pl) { return cubeRoot(float(meanBead_pl(beads)) * mm3_per_pl); }

// How many beads of a volume in all cover a share of an area, `per_m2` being 1 / area: share = n pi R^2 / area and V = n R^3 capShape, so
// n = (share area / pi)^3 (capShape / V)^2. Millimetres, for the range of floats.
RG_FN float beadsCovering(int volume_pl, float share, float mm3_per_pl, float per_m2) {
  float covered = share * 1.0e6f / 3.1415927f;
  float base_per_area = float(max(volume_pl, 1)) * mm3_per_pl * per_m2;
  return covered * covered * covered / (base_per_area * base_per_area * per_m2);
}

// Of how many equal beads the water of two kinds is, so that a picolitre finds itself in a bead as large as before in the mean: as many as both where
// they are alike; but a large drop's water is not shared out among the mist that it falls into. With p the second's share of the volume, 1 / number is
// p^2 / number_b + (1 - p)^2 / number_a. In whole 128ths, which come out alike everywhere.
// Both are rounded by chance, so that they are right in the mean: else a lone bead would stay one whatever small ones came to it one by one. The
// volumes choose.
RG_FN int numberOfBoth(RG_IN(Beads) a, int b_pl, int b_number) {
  uint chance = pcg(uint(a.volume_pl) ^ pcg(uint(b_pl)));
  int whole_pl = max(a.volume_pl + b_pl, 1), p = quotient((uint(b_pl) << 7u) + uint(upTo(whole_pl, chance)), whole_pl), rest = 128 - p;
  int n = max(a.number, 1), parts = p * p * n + rest * rest * b_number;
  int both = quotient(uint(((n * b_number) << 14) + upTo(parts, pcg(chance))), parts);
  return a.number == 0 ? min(b_number, kMostBeads) : clamp(both, 1, kMostBeads);
}

// As they come to others. What is too much for the store goes to the film.
RG_FN Beads joinedBy(RG_IN(Beads) beads, int volume_pl, int number, RG_INOUT(int) film_pl) {
  int kept_pl = min(volume_pl, kMostBeads_pl - beads.volume_pl);
  film_pl += volume_pl - kept_pl;
  Beads both;
  both.volume_pl = beads.volume_pl + kept_pl;
  both.number = kept_pl > 0 ? numberOfBoth(beads, kept_pl, max(number, 1)) : beads.number;
  return both;
}

// What stays of them when a part of their volume is taken: whole beads as far as there are any.
RG_FN Beads withoutPart(RG_IN(Beads) beads, int taken_pl) {
  Beads rest;
  rest.volume_pl = beads.volume_pl - taken_pl;
  int whole_pl = max(beads.volume_pl, 1);  // numbers up to 2^6 times volumes below 2^24
  rest.number = rest.volume_pl <= 0 ? 0 : max(1, quotient(uint(beads.number * rest.volume_pl + (whole_pl >> 1)), whole_pl));
  return rest;
}

// A film breaks at holes; between them it gathers into ridges, which meet the glass at its contact angle and pinch off into beads. Their fastest wave is
// some 4 times as long as they are wide: sqrt(2) times the longest that dies, 3.7 times the width of a flat ridge, 4.4 of a half cylinder (Davis
// 1980, J. Fluid Mech. 98; lines that move freely). Holes a distance s apart, in squares: a ridge of length 2 s and of a cross section h s / 2 for each
// s^2. `by_ridge`: see ridgeBeads.
// A hole opens only where a speck is wider than the film's rim would close over, some tenths of a millimetre for films of 20 um on glass that
// water leaves at 10 degrees: such specks lie millimetres apart, and unevenly (by eye).
RG_CONST float kHoles_m = 4.0e-3f;  // (unsourced)
RG_FN int beadsOfBrokenFilm(float h_m, uint place, float per_m2, float by_ridge) {
  float u = unitFloat(pcg(place + 0x51ed270bu));
  float holes_m = kHoles_m * (0.5f + 1.5f * u * u);
  float number = by_ridge / (holes_m * sqrt(h_m * holes_m) * per_m2);
  return int(min(max(number + unitFloat(pcg(place + 0x2545f491u)), 1.0f), float(kMostBeads)));
}

// Of ridges w wide, a cross section of q w^2 = h s / 2: 2 s / (4 w) on an area of s^2 is ridgeBeads / (s sqrt(h s)).
RG_FN float ridgeBeads(float contact_rad) {
  float s = sin(contact_rad), q = (contact_rad - s * cos(contact_rad)) / (4.0f * s * s);
  return 0.5f * sqrt(2.0f * q);
}

// --- where they lie, in texels ---

// Radius in pixels from which a bead is more and more seen by itself, and wholly.
RG_CONST float kHazy_px = 0.35f;
RG_CONST float kWhole_px = 0.8f;

// The look's texels are bent a little, so that nobody sees rows: a place p of the grid shows what is in the texel of beadPlace(p).
RG_FN vec2 beadPlace(vec2 p) {
  return p + vec2(0.22f * sin(1.31f * p.y + 0.7f * p.x) + 0.16f * sin(2.3f * p.y - 0.57f * p.x),
                  0.22f * sin(1.17f * p.x - 0.61f * p.y) + 0.16f * sin(2.1f * p.x + 0.83f * p.y));
}
RG_FN vec2 gridPlace(vec2 bead_place) {
  vec2 p = bead_place;
  for (int k = 0; k < 12; ++k) p = p + 0.7f * (bead_place - beadPlace(p));
  return p;
}

// A texel is cut in two, across its longer side or nearly so, its parts again, and so on, until each holds one bead: unevenly and by chance, and a part's
// beads are fewer or more than its share of the area. So no rows are seen, and beads differ as those do that uneven ridges pinch off: their diameters'
// law is gamma's of order 4 to 10 (Villermaux, Marmottant & Duplat 2004, Phys. Rev. Lett. 92, 074501), which here follows from volumes that go as
// the squares of areas. One more bead parts one of those there are; others stay where they are, and are of another size for it.
RG_CONST float kLeastPart = 0.3f;    // of what is cut (by eye)
RG_CONST float kUnevenParts = 0.2f;  // by how much a part's share of the beads is another than of the area, at most (by eye)

struct SeatedBead {
  vec2 middle; // in the texel, 0 .. 1
  float size;  // of its radius to the mean bead's; 0: there is none
  vec2 low;    // its part of the texel
  vec2 high;
};

// The bead in whose part a place of a texel lies. `mean`: the mean bead's radius in texels.
RG_FN SeatedBead seatedBead(uint texel, vec2 place, int number, float mean) {
  SeatedBead bead;
  bead.low = vec2(0.0f, 0.0f);
  bead.high = vec2(1.0f, 1.0f);
  uint h = pcg(texel * 7u + 0x9e3779b9u);
  // A lone bead's place: that of one of them, too, when others come.
  vec2 first_place = vec2(unitFloat(h), unitFloat(pcg(h)));
  float volume = float(number);
  int here = number;
  while (here > 1) {
    h = pcg(h);
    vec2 size = bead.high - bead.low;
    bool along_x = size.x * ((h & 1u) != 0u ? 1.08f : 1.0f / 1.08f) > size.y;
    float share = mix(kLeastPart, 1.0f - kLeastPart, unitFloat(h << 8u));
    float share_of_beads = share + kUnevenParts * (2.0f * unitFloat(h << 16u) - 1.0f);
    int lower = clamp(int(float(here) * share_of_beads + unitFloat(h)), 1, here - 1), upper = here - lower;
    float rest = 1.0f - share, odds = share * share * float(upper), against = rest * rest * float(lower);
    vec2 cut = bead.low + size * share;
    bool beyond = along_x ? place.x >= cut.x : place.y >= cut.y;
    volume *= (beyond ? against : odds) / (odds + against);
    here = beyond ? upper : lower;
    h += beyond ? 0x2545f491u : 0u;
    bead.low = beyond ? vec2(along_x ? cut.x : bead.low.x, along_x ? bead.low.y : cut.y) : bead.low;
    bead.high = beyond ? bead.high : vec2(along_x ? cut.x : bead.high.x, along_x ? bead.high.y : cut.y);
  }
  vec2 room = bead.high - bead.low;
  float radius = min(mean * pow(max(volume, 1e-6f), 1.0f / 3.0f), 0.5f * min(room.x, room.y));
  bool firsts = first_place.x >= bead.low.x && first_place.y >= bead.low.y && first_place.x < bead.high.x && first_place.y < bead.high.y;
  h = pcg(h + 17u);
  vec2 own = firsts ? first_place : bead.low + room * vec2(unitFloat(h), unitFloat(pcg(h)));
  vec2 half_room = max(room * 0.5f - vec2(radius, radius), vec2(0.0f, 0.0f)), centre = (bead.low + bead.high) * 0.5f;
  bead.middle = clamp(own, centre - half_room, centre + half_room);
  bead.size = number > 0 && mean > 0.0f ? radius / mean : 0.0f;
  return bead;
}

RG_SHARED_END
#endif
