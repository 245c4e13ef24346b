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
RG_CONST int kMostBeads = 64;  // of a texel: the look finds one in 8 x 8 cells
RG_FN Beads beadsOf(uint code) {
  Beads beads;
  beads.volume_pl = int(code & 0xffffffu);
  beads.number = int(code >> 24u);
  return beads;
}
RG_FN Beads noBeads() { return beadsOf(0u); }
RG_FN uint packedBeads(RG_IN(Beads) beads) { return uint(beads.volume_pl) | (uint(beads.number) << 24u); }

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

// Radius of the base of beads of the same volume each, in whole picolitres: a quotient of numbers below 2^24 is rounded up to no next one, and software GL
// divides floats eight at a time. `mm3_per_pl`: the cube of that of a picolitre, by the contact angle: V = R^3 capShape
// (glass/water.h).
RG_FN float beadRadius_mm(RG_IN(Beads) beads, float mm3_per_pl) {
  return cubeRoot(floor(float(beads.volume_pl) / float(max(beads.number, 1))) * mm3_per_pl);
}

// How many beads of a volume in all cover a share of an area, `per_m2` being 1 / area: share = n pi R^2 / area and V = n R^3 capShape, so
// n = (share area / pi)^3 (capShape / V)^2. Millimetres, for the range of floats.
RG_FN float beadsCovering(int volume_pl, float share, float mm3_per_pl, float per_m2) {
  float covered_mm2 = share * 1.0e6f / (per_m2 * 3.1415927f);
  float base_mm3 = float(max(volume_pl, 1)) * mm3_per_pl;
  return covered_mm2 * covered_mm2 * covered_mm2 / (base_mm3 * base_mm3);
}

// As they come to others. What is too much for the store goes to the film.
RG_FN Beads joinedBy(RG_IN(Beads) beads, int volume_pl, int number, RG_INOUT(int) film_pl) {
  int kept_pl = min(volume_pl, kMostBeads_pl - beads.volume_pl);
  film_pl += volume_pl - kept_pl;
  Beads both;
  both.volume_pl = beads.volume_pl + kept_pl;
  both.number = min(beads.number + (kept_pl > 0 ? max(number, 1) : 0), kMostBeads);
  return both;
}

// What stays of them when a part of their volume is taken: whole beads as far as there are any.
RG_FN Beads withoutPart(RG_IN(Beads) beads, int taken_pl) {
  Beads rest;
  rest.volume_pl = beads.volume_pl - taken_pl;
  int whole_pl = max(beads.volume_pl, 1);  // numbers up to 2^6 times volumes below 2^24
  rest.number = rest.volume_pl <= 0 ? 0 : max(1, (beads.number * rest.volume_pl + whole_pl / 2) / whole_pl);
  return rest;
}

// A film breaks at holes; between them it gathers into ridges, half cylinders of radius a that pinch off every nine radii (Rayleigh & Plateau's
// fastest wave, 2 pi sqrt(2) a = 8.9 a). Holes a distance s apart, in squares: a ridge of length 2 s for each s^2, so pi a^2 / 2 = h s / 2.
// A hole opens only where a speck is wider than the film's rim would close over, some tenths of a millimetre for films of 20 um on glass that
// water leaves at 10 degrees: such specks lie millimetres apart, and unevenly (by eye).
RG_CONST float kHoles_m = 4.0e-3f;  // (unsourced)
RG_FN int beadsOfBrokenFilm(float h_m, uint place, float per_m2) {
  float u = unitFloat(pcg(place + 0x51ed270bu));
  float holes_m = kHoles_m * (0.5f + 1.5f * u * u);
  float ridge_m = sqrt(h_m * holes_m / 3.1415927f);
  float number = 2.0f / (9.0f * holes_m * ridge_m * per_m2);
  return int(min(max(number + unitFloat(pcg(place + 0x2545f491u)), 1.0f), float(kMostBeads)));
}

// --- where they lie, in texels ---

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

// Each texel is cut into cells x cells, at least 2 x 2, one bead in each or none: into rows, and each row by itself, at places of its own, so that beads
// that crowd do not stand in line. Not so 2 x 2, where a lone one finds its seat, too. Lines: rows' are kBeadRows, those in a row are its number.
RG_CONST float kUnevenCells = 0.25f; // at most: of a cell's width, either way (by eye)
RG_CONST int kBeadRows = 8;
RG_FN int beadCells(int number) { return max(int(ceil(sqrt(float(number)) - 1.0e-4f)), 2); }
// What beads of this mean radius, in texels, leave for cells to differ, all but the largest being whole.
RG_FN float unevenCells(int cells, float mean) { return cells > 2 ? clamp(0.5f - 1.1f * mean * float(cells), 0.0f, kUnevenCells) : 0.0f; }
RG_FN float beadEdge(uint texel, int line, int k, int cells, float uneven) {
  float u = unitFloat(pcg(pcg(texel ^ 0x68e31da4u) + uint(line * 16 + k)));
  return k <= 0 ? 0.0f : k >= cells ? 1.0f : (float(k) + uneven * (2.0f * u - 1.0f)) / float(cells);
}
RG_FN int beadCellAlong(uint texel, int line, float place, int cells, float uneven) {
  int k = min(int(place * float(cells)), cells - 1);
  return k + (place >= beadEdge(texel, line, k + 1, cells, uneven) ? 1 : 0) - (place < beadEdge(texel, line, k, cells, uneven) ? 1 : 0);
}
// Of `number` beads.
RG_FN ivec2 beadCellAt(uint texel, vec2 in_texel, int number, float mean) {
  int cells = beadCells(number);
  float uneven = unevenCells(cells, mean);
  int row = beadCellAlong(texel, kBeadRows, in_texel.y, cells, uneven);
  return ivec2(beadCellAlong(texel, row, in_texel.x, cells, uneven), row);
}
RG_FN vec2 beadCorner(uint texel, ivec2 cell, int number, float mean) {
  int cells = beadCells(number);
  float uneven = unevenCells(cells, mean);
  return vec2(beadEdge(texel, cell.y, cell.x, cells, uneven), beadEdge(texel, kBeadRows, cell.y, cells, uneven));
}
// The corner across from that.
RG_FN vec2 beadOpposite(uint texel, ivec2 cell, int number, float mean) {
  int cells = beadCells(number);
  float uneven = unevenCells(cells, mean);
  return vec2(beadEdge(texel, cell.y, cell.x + 1, cells, uneven), beadEdge(texel, kBeadRows, cell.y + 1, cells, uneven));
}

struct SeatedBead {
  vec2 middle; // in the texel, 0 .. 1
  float size;  // of its radius to the mean bead's; 0: the cell is empty
};

// The bead of a cell. `mean`: the mean bead's radius in texels. Beads of a pair differ, their volumes' sum does not. A lone one has the texel to
// itself, but sits where it sits when others come; it is found from every cell.
RG_FN SeatedBead seatedBead(uint texel, ivec2 seen_cell, int number, float mean) {
  SeatedBead bead;
  int cells = beadCells(number);
  uint h = pcg(texel * 7u + 0x9e3779b9u), turn = h >> 8u;
  // 11 and 13 share no factor with any number of cells up to 8 x 8, so that ranks are a permutation; of four cells each is its own inverse.
  uint step = (h & 1u) != 0u ? 11u : 13u, number_of_cells = uint(cells * cells);
  uint first = ((4u - turn % 4u) * step) % 4u;
  ivec2 cell = number == 1 ? ivec2(int(first) % 2, int(first) / 2) : seen_cell;
  int rank = int((uint(cell.y * cells + cell.x) * step + turn) % number_of_cells);
  uint pair = pcg(h ^ (uint(rank) >> 1u));
  float even = 1.0f - unitFloat(pair);
  float differ = (rank ^ 1) < number ? 0.95f * (1.0f - even * even) : 0.0f;
  float volume = 1.0f + ((rank & 1) != 0 ? differ : -differ);
  vec2 corner = beadCorner(texel, cell, number, mean), width = beadOpposite(texel, cell, number, mean) - corner;
  vec2 room = number == 1 ? vec2(1.0f, 1.0f) : width;
  float radius = min(mean * pow(volume, 1.0f / 3.0f), 0.5f * min(room.x, room.y));
  uint g = pcg(pair + uint(rank) + 17u);
  vec2 own = corner + vec2(unitFloat(g), unitFloat(pcg(g))) * width;
  vec2 low = number == 1 ? vec2(0.0f, 0.0f) : corner;
  bead.middle = clamp(own, low + vec2(radius, radius), low + room - vec2(radius, radius));
  bead.size = rank < number && mean > 0.0f ? radius / mean : 0.0f;
  return bead;
}

RG_SHARED_END
#endif
