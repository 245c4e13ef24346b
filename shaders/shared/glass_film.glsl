// What one film step does to a texel, from whole picolitres to whole picolitres: taken here, given there, so water is neither made nor lost in any
// order. Runs in the film's kernels, and in C++ for tests.
#ifndef RG_SHARED_GLASS_FILM_GLSL
#define RG_SHARED_GLASS_FILM_GLSL
#include "shared/compat.glsl"
#include "shared/glass_beads.glsl"
#include "shared/glass_types.glsl"
#include "shared/hash.glsl"
RG_SHARED_BEGIN

RG_CONST float kFilmStep_s = 1.0f / 60.0f;
RG_CONST float kOverfull_m = 300.0e-6f;      // a thicker film is no film: the rest goes to the drops
RG_CONST float kNusselt_per_m_s = 1000.0f / (3.0f * 1.0e-3f); // rho / (3 mu)
RG_CONST float kShear_per_pa_s = 1.0f / (2.0f * 1.0e-3f);     // 1 / (2 mu)
RG_CONST float kTension_m3 = kFilmStep_s * 0.072f / (3.0f * 1.0e-3f); // gamma / (3 mu), for a step

// What all texels of a step share.
struct FilmStepInfo {
  int columns;
  int rows;
  uint step;             // low bits of its last tick's number, two ticks a step
  uint pane;
  float up_x;            // unit, grid axes: to the upper edge
  float up_y;
  float pin_m;           // see Surface in glass/water.h
  float front_m;
  float rupture_m;
  float rupture_chance;  // of a texel in its turn to dry
  float evaporation_mps; // thickness lost per second
  int drops_allowed;     // 0: nothing is given to drops
  float bead_mm3_per_pl; // the cube of a bead's base radius, see beadRadius_mm
  float bead_drying_pl_mm; // what a bead loses in a turn to dry in still air, by its base radius
  float bead_airing;     // moving air takes 1 + this sqrt(radius in mm) times as much
  // Of setLevelling: what the weight of a metre of film drives through a face by a cubed thickness of 1 m^3; the largest cubes that a step takes stably.
  float weight_pl_m4;
  float heavy_m3;
  float tense_m3;
  float bead_by_ridge; // see ridgeBeads
  int most_bead_pl;    // a larger one is a drop
};
RG_SIZE(FilmStepInfo, 80)

// A texel as its neighbours see it.
struct FilmCell {
  int volume_pl; // -1: off the pane
  float h_m;
  int x_pl;      // what it wants to give along x: > 0 to x + 1, < 0 to x - 1
  int y_pl;
  int x_both_pl; // what it wants to give to each of its neighbours along x besides
  int y_both_pl;
  float hollowness; // times the cube of a thickness (m^3): the picolitres that surface tension draws in through a face in a step
  float slack;      // how much of a cell its waves leave; of no meaning where it is not wet
  float entry_m;    // how thick a film must be that is driven straight into it: 0 off the pane and where it is wet
};

// What a texel's law asks of its four neighbours.
struct FilmAround {
  int hollow_pl; // by how much they together stand above it: the film's curvature
  int least_pl;  // of those on the pane
  int gap_pl;    // the lesser of two that lie opposite each other, of the pair that has more
};

// Software GL's min() and max() look for NaNs besides, which is half as much again.
RG_FN float lesser(float a, float b) { return a < b ? a : b; }
RG_FN float greater(float a, float b) { return a > b ? a : b; }

// Exact, as all that a flux hangs on: both sides of a face work it out for themselves, on a GPU in other kernels' code, and must agree to the picolitre.
RG_FN float thickness_m(int volume_pl, RG_IN(vec4) metric) {
  RG_EXACT float h_m = float(volume_pl) * (kPicolitre_m3 * metric.z);
  return h_m;
}

// Field between the corners of a tile. `f` in 0..1.
RG_FN vec4 between(RG_IN(vec4) a, RG_IN(vec4) b, float f) {
  RG_EXACT vec4 value = a + (b - a) * f;
  return value;
}
RG_FN vec4 betweenNodes(RG_IN(vec4) a, RG_IN(vec4) b, RG_IN(vec4) c, RG_IN(vec4) d, vec2 f) {
  return between(between(a, b, f.x), between(c, d, f.x), f.y);
}

// Where between the edges of its tile a texel's fields are asked for. Half way up it; but along a row once for a strip of texels, which differ by
// an eighth of what a tile's edges do at most.
RG_FN float placeAcross(int x) { return (float(x & (kTileSize - kStripSize)) + 0.5f * float(kStripSize)) / float(kTileSize); }
RG_FN float placeUp(int y) { return (float(y & (kTileSize - 1)) + 0.5f) / float(kTileSize); }

// Mean velocity q / h of a film: Nusselt 1916, q = rho g h^3 / (3 mu), and a wind's shear on its surface, q = tau h^2 / (2 mu).
RG_FN vec2 fallingVelocity(float h_m, RG_IN(vec4) drive) {
  RG_EXACT vec2 u = vec2(drive.x, drive.y) * (kNusselt_per_m_s * h_m * h_m);
  return u;
}
RG_FN vec2 blownVelocity(float h_m, RG_IN(vec4) drive) {
  RG_EXACT vec2 u = vec2(drive.z, drive.w) * (kShear_per_pa_s * h_m);
  return u;
}
RG_FN vec2 filmVelocity(float h_m, RG_IN(vec4) drive) { return fallingVelocity(h_m, drive) + blownVelocity(h_m, drive); }

// Where wind opposes gravity the flow q(h) turns round at one thickness and its waves, which go dq/dh = 3 fallen - 2 blown, at two thirds of that: between
// both they go against the flow, and what a texel gives by its own thickness alone makes ripples grow. So of a film that falls so fast and is blown
// so fast, the other way, each neighbour gets this much more. Ripples die where that, times h, rises with h as fast as q does there (as Engquist &
// Osher 1981, Math. Comput. 36, split q): 0.6 (3 fallen - 4/3 blown) is no less, and above it need not fall.
RG_FN float counterflow(float fallen, float blown) {
  // Against what is blown where it is the other way round and more than two thirds of that.
  RG_EXACT float rest = fallen + (2.0f / 3.0f) * blown, more = lesser(0.6f * abs(rest), 0.2f * abs(blown));
  return rest * blown < 0.0f ? more : 0.0f;
}

// Waves go three times as fast as the film, but no farther in a step than this share of a cell: what is left of one is surface tension's.
RG_CONST float kFastest_cells = 7.0f / 8.0f;

// How much of `courant`, a velocity in cells a step, a texel's water goes. Up to a third of the fastest all of it; beyond, the flux of a draining film,
// courant ~ V^2, goes on along its tangent: by i^2 (3 - 2 i), i^2 being the part that would keep waves to the fastest. Less than half a cell,
// so that with four eighths of levelling and roundings nothing gives more than it has.
RG_FN float keptToOneCell(float courant) {
  RG_EXACT float i = 1.0f / greater(sqrt((3.0f / kFastest_cells) * courant), 1.0f);
  RG_EXACT float tangent = 3.0f - 2.0f * i, share = i * i * lesser(tangent, 1.48f / kFastest_cells);
  return share;
}

// Past the pane's edge the film goes on level; onto dry glass it goes down.
RG_FN FilmAround filmAround(int volume_pl, int left_pl, int right_pl, int below_pl, int above_pl) {
  FilmAround around;
  around.hollow_pl = (left_pl < 0 ? volume_pl : left_pl) + (right_pl < 0 ? volume_pl : right_pl) + (below_pl < 0 ? volume_pl : below_pl) +
                     (above_pl < 0 ? volume_pl : above_pl) - 4 * volume_pl;
  // Without sign those off the pane are the greatest.
  around.least_pl = int(min(min(uint(left_pl), uint(right_pl)), min(uint(below_pl), uint(above_pl))) & 0x7fffffffu);
  around.gap_pl = max(min(left_pl, right_pl), min(below_pl, above_pl));
  return around;
}

// Glass is not the same everywhere: levels 0 (easily wetted) .. 30 from glass/uneven_glass.h, five bits each. A strip's code has its own texels'
// and that of the one on either side.
RG_CONST int kMostUneven = 30;
RG_FN int glassLevel(uint code, int k) { return int(code >> uint(5 * (k + 1))) & 31; }
RG_FN float unevenness(int level) { // -1 .. 1
  RG_EXACT float share = float(level) * (2.0f / float(kMostUneven)) - 1.0f;
  return share;
}

// Tangent of the largest turn that uneven glass gives a contact line's way, and so what runs there (unsourced).
RG_CONST float kMostTurn = 0.75f;

// Where it has dry glass beside it a stream follows its edge, whose way over uneven glass is not straight down: driven by the part along it of what drives
// it, so times the square of the turn's cosine (0.64 at the largest).
RG_FN vec2 turned(vec2 along, float turn) {
  RG_EXACT float part = 1.0f - 0.64f * turn * turn;
  RG_EXACT vec2 way = (along + turn * vec2(-along.y, along.x)) * part;
  return way;
}

// Differences of a step damp what changes from texel to texel by 64 of tension's share and 8 of weight's, and waves by twice their way: beyond two in all
// it would grow. Of what waves leave of two these are for tension and for weight; the rest is there so that what alternates dies away.
RG_CONST float kTensionsPart = 0.9f;
RG_CONST float kWeightsPart = 0.5f;

// Of films on texels of these areas (1 / m^2, of the smallest), with an acceleration that presses them onto the glass, < 0 where they hang.
// Thick film on fine texels is bounded, and so slower than theory says, tension more than weight: except where it hangs, and tension is what keeps its
// weight from drawing short waves out.
RG_FN void setLevelling(RG_INOUT(FilmStepInfo) info, float pressing_mps2, float per_m2) {
  float weight = kNusselt_per_m_s * kFilmStep_s * pressing_mps2;
  info.weight_pl_m4 = weight / kPicolitre_m3;
  info.tense_m3 = (kTensionsPart / 64.0f) / (kTension_m3 * per_m2 * per_m2);
  info.heavy_m3 = (kWeightsPart / 8.0f) / max(abs(weight) * per_m2, 1.0f);
  if (weight < 0.0f) info.heavy_m3 = min(info.heavy_m3, info.tense_m3);
}

// Without branches: software GL runs through them all, and keeps what they set in memory.
RG_FN FilmCell filmCell(int volume_pl, RG_IN(FilmAround) around, int glass, RG_IN(vec4) drive, RG_IN(vec4) metric, RG_IN(FilmStepInfo) info) {
  FilmCell cell;
  cell.volume_pl = volume_pl;
  cell.h_m = thickness_m(volume_pl, metric);
  bool wet = cell.h_m >= info.pin_m;
  // Two fronts that meet over a texel take it between them.
  RG_EXACT float front_m = info.front_m * (1.0f + 0.5f * unevenness(glass));
  cell.entry_m = volume_pl < 0 || wet || 2.0f * thickness_m(around.gap_pl, metric) >= front_m ? 0.0f : front_m;
  RG_EXACT vec2 fallen = fallingVelocity(cell.h_m, drive), blown = blownVelocity(cell.h_m, drive), straight = fallen + blown;
  RG_EXACT vec2 u = thickness_m(around.least_pl, metric) < info.pin_m ? turned(straight, kMostTurn * unevenness(glass)) : straight;
  RG_EXACT float cx = u.x * metric.x, cy = u.y * metric.y;
  RG_EXACT float cx_both = counterflow(fallen.x, blown.x) * metric.x, cy_both = counterflow(fallen.y, blown.y) * metric.y;
  RG_EXACT float courant = abs(cx) + abs(cy) + 2.0f * (cx_both + cy_both);
  RG_EXACT float slack = 1.0f - lesser(3.0f * courant, kFastest_cells);
  cell.slack = slack;
  RG_EXACT float hollowness = kTension_m3 * metric.z * metric.z * float(around.hollow_pl);
  cell.hollowness = hollowness;
  // What is not wet goes nowhere.
  RG_EXACT float scale = volume_pl > 0 && wet ? float(volume_pl) * keptToOneCell(courant) : 0.0f;
  RG_EXACT float x_wish = cx * scale + 0.5f, y_wish = cy * scale + 0.5f;
  cell.x_pl = int(floor(x_wish));
  cell.y_pl = int(floor(y_wish));
  cell.x_both_pl = int(cx_both * scale);
  cell.y_both_pl = int(cy_both * scale);
  return cell;
}

// Films flow slowly: picolitres below one count as often as their share of one, for all faces in the same steps.
RG_FN float rounding(RG_IN(FilmStepInfo) info) { return unitFloat(pcg(info.step)); }

// Surface tension and weight between neighbours, out of a into b; the same with a minus sign from b's side. By lubrication theory's flux -h^3 / (3 mu)
// grad p, p = rho g cos a h - gamma lap h (Oron, Davis & Bankoff 1997, Rev. Mod. Phys. 69), as if texels were square and their neighbours as large as
// they. Never more than an eighth of what is there.
RG_FN int levelled_pl(RG_IN(FilmCell) a, RG_IN(FilmCell) b, RG_IN(FilmStepInfo) info) {
  RG_EXACT float cube_m3 = a.h_m * b.h_m * (0.5f * (a.h_m + b.h_m));
  float slack = lesser(a.slack, b.slack);
  RG_EXACT float by_weight = lesser(cube_m3, slack * info.heavy_m3) * (info.weight_pl_m4 * (a.h_m - b.h_m));
  RG_EXACT float flow = by_weight - lesser(cube_m3, slack * info.tense_m3) * (a.hollowness - b.hollowness);
  int size = min(int(abs(flow) + rounding(info)), (flow > 0.0f ? a.volume_pl : b.volume_pl) >> 3);
  return flow > 0.0f ? size : -size;
}

// Whether it overcomes what holds the contact line that lies between: what drives the film is as its thickness, and but a part of it goes that way.
RG_FN bool enters(RG_IN(FilmCell) from, int along_pl, RG_IN(FilmCell) to) {
  RG_EXACT float drives = from.h_m * float(abs(along_pl)), holds = to.entry_m * greater(float(abs(from.x_pl)), float(abs(from.y_pl)));
  return drives >= holds;
}

// What passes from a to its neighbour b in the direction of the axis. `a_pl`, `b_pl`: what both want to give along it; `a_both_pl`, `b_both_pl`:
// to either side besides, where there is film.
RG_FN int flowBetween_pl(RG_IN(FilmCell) a, int a_pl, int a_both_pl, RG_IN(FilmCell) b, int b_pl, int b_both_pl, RG_IN(FilmStepInfo) info) {
  int even = a.h_m < info.pin_m || b.h_m < info.pin_m ? 0 : levelled_pl(a, b, info) + a_both_pl - b_both_pl;
  return even + (enters(a, a_pl, b) ? max(a_pl, 0) : 0) + (enters(b, b_pl, a) ? min(b_pl, 0) : 0);
}

// A tile dries in every sixteenth step (a quarter of a second), for all of them: what else lies still on it need not be looked at in the steps between.
RG_CONST uint kDryingSteps = 16u;
RG_FN bool driesNow(uint tile, RG_IN(FilmStepInfo) info) { return (tile + info.step / 2u) % kDryingSteps == 0u; }

// Whole picolitres out of a rate: the rest by chance, so that the mean is right.
RG_FN int evaporated_pl(int volume_pl, uint texel, RG_IN(vec4) metric, RG_IN(FilmStepInfo) info) {
  float wish = info.evaporation_mps * (float(kDryingSteps) * kFilmStep_s) / (metric.z * kPicolitre_m3);
  int whole = int(floor(wish + unitFloat(pcg(texel + pcg(info.step ^ info.pane)))));
  return max(min(volume_pl, whole), 0);
}

// Hu & Larson 2002, as for drops (glass/water.h), each bead being of the mean size. The last of them go at once, when a bead is no more than a
// hemisphere of 0.03 mm.
RG_CONST int kLeastBead_pl = 50;
RG_FN int driedOfBeads_pl(RG_IN(Beads) beads, uint texel, RG_IN(FilmStepInfo) info) {
  float radius_mm = beadRadius_mm(beads, info.bead_mm3_per_pl);
  RG_EXACT float wish = float(beads.number) * info.bead_drying_pl_mm * radius_mm * (1.0f + info.bead_airing * sqrt(radius_mm));
  int whole = int(floor(min(wish, float(kMostBeads_pl)) + unitFloat(pcg(~texel + pcg(info.step ^ info.pane)))));
  return beads.volume_pl - whole < kLeastBead_pl * beads.number ? beads.volume_pl : whole;
}

// A texel's film and beads after what is done to them where they are.
struct FilmTexel {
  int film_pl; // -1: off the pane
  Beads beads;
  int gone_pl; // evaporated; or what may go to the drops: all over the thickest film; of beads, some too large, as much as they have (offered_pl)
  int stirs;   // 1: not to fall asleep
};

RG_CONST float kWhole_m = 0.5e-6f; // a thinner film dries before it breaks (unsourced)

// Whether a film breaks up in its turn to dry: by chance.
RG_FN bool breaksUp(float h_m, uint texel, RG_IN(FilmStepInfo) info) {
  return h_m > kWhole_m && h_m <= info.rupture_m && unitFloat(pcg(pcg(texel ^ info.pane) + info.step)) < info.rupture_chance;
}

RG_FN FilmTexel asItIs(int film_pl, RG_IN(Beads) lying) {
  FilmTexel t;
  t.film_pl = film_pl;
  t.beads = lying;
  t.gone_pl = 0;
  t.stirs = 0;
  return t;
}

// A turn to dry. Off the pane there is nothing to.
RG_FN FilmTexel dried(int film_pl, RG_IN(Beads) lying, uint texel, RG_IN(vec4) metric, RG_IN(FilmStepInfo) info) {
  FilmTexel t = asItIs(film_pl, lying);
  int film_dried_pl = evaporated_pl(film_pl, texel, metric, info);
  int beads_dried_pl = driedOfBeads_pl(lying, texel, info);
  t.film_pl -= film_dried_pl;
  t.beads.volume_pl -= beads_dried_pl;
  t.beads.number = t.beads.volume_pl == 0 ? 0 : t.beads.number;
  t.gone_pl = film_dried_pl + beads_dried_pl;
  float h_m = thickness_m(t.film_pl, metric);
  int surplus_pl = 0;
  // Beads that lie there are where its ridges end: as many as those or as it leaves by itself, whichever is more, but no more than both waters make.
  int of_film = beadsOfBrokenFilm(h_m, texel ^ info.pane, metric.z, info.bead_by_ridge);
  Beads more = joinedBy(t.beads, t.film_pl, of_film, surplus_pl);
  more.number = min(more.number, max(of_film, t.beads.number));
  // None of them too large at once: what dries is left as settled() leaves it, and may sleep on.
  int most_pl = max(info.most_bead_pl, 1), least = quotient(uint(max(more.volume_pl, 0) + most_pl - 1), most_pl);
  int number = int(min(float(max(more.number, least)), beadsCovering(more.volume_pl, kCrowded, info.bead_mm3_per_pl, metric.z)));
  bool breaks = breaksUp(h_m, texel, info) && number >= max(least, 1);
  t.film_pl = breaks ? surplus_pl : t.film_pl;
  t.beads.volume_pl = breaks ? more.volume_pl : t.beads.volume_pl;
  t.beads.number = breaks ? number : t.beads.number;
  return t;
}

// After water has flowed. Off the pane nothing has, and no beads lie there.
RG_FN FilmTexel settled(int film_pl, RG_IN(Beads) lying, RG_IN(vec4) metric, RG_IN(FilmStepInfo) info) {
  FilmTexel t = asItIs(film_pl, lying);
  // Where they are crowded neighbours run together, until there are as many as have room.
  float room = beadsCovering(lying.volume_pl, kCrowded, info.bead_mm3_per_pl, metric.z);
  int number = room < float(lying.number) ? max(1, int(room)) : lying.number;
  bool alone = number == 1 && room < 1.0f;
  // A film that flows takes them along; a lone one as wide as its texel is a film.
  bool joins = thickness_m(film_pl, metric) >= info.pin_m || (alone && room < kFlooded);
  t.film_pl += joins ? lying.volume_pl : 0;
  t.beads.volume_pl = joins ? 0 : lying.volume_pl;
  t.beads.number = joins ? 0 : number;
  int too_much_pl = t.film_pl - int(kOverfull_m * metric.w);
  bool too_large = t.beads.number > 0 && (alone || t.beads.volume_pl > t.beads.number * info.most_bead_pl);
  t.stirs = int(too_large || thickness_m(t.film_pl, metric) >= info.pin_m);
  t.gone_pl = info.drops_allowed == 0 ? 0 : too_much_pl > 0 ? too_much_pl : too_large ? t.beads.volume_pl : 0;
  return t;
}
// What of gone_pl does go: a bead, or all of a film's. (For one texel of a tile, as each texel would have to divide.)
RG_FN int offered_pl(int gone_pl, RG_IN(Beads) lying) { return lying.number > 0 ? meanBead_pl(lying) : gone_pl; }
// ... and after its tile's offer has gone to the drops.
RG_FN FilmTexel without(RG_IN(FilmTexel) texel, int given_pl) {
  FilmTexel t = texel;
  if (t.beads.number > 0) t.beads = withoutPart(t.beads, given_pl);
  else t.film_pl -= given_pl;
  return t;
}

// share / 65536 of a volume, without 64-bit numbers.
RG_FN int shareOf(int volume_pl, int share_65536) {
  if (volume_pl <= 0) return 0;
  uint v = uint(volume_pl);
  uint s = uint(min(max(share_65536, 0), 65536));
  return int((v >> 16u) * s + (((v & 0xffffu) * s) >> 16u));
}

RG_SHARED_END
#endif
