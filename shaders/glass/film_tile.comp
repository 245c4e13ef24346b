// The film step of glass/film_flow.comp for GPUs: groups of as many invocations as a tile has texels, each of which works out its own, and hears of others
// through shared memory. So all have much to do at once, with few registers each, and a texel's law is worked out 1.25 times, a face's flow once. A group
// finds out by itself whether its tile is awake, and one more tells of the ridges: nothing goes before but what changes the film.
#include "glass/film_tile.glsl"
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // strips of texels side by side
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles
layout(rgba32f, binding = 2) readonly uniform imageBuffer drive;
layout(rgba32ui, binding = 4) readonly uniform uimageBuffer glass; // a code for each strip of a tile's row
layout(std430, binding = 2) writeonly buffer Report { int report[]; }; // FilmTile of each tile, and the ridges
layout(std430, binding = 3) writeonly buffer After { int after[]; };
layout(std430, binding = 6) buffer Lying { uint beads[]; };
layout(location = 2) uniform int ridges_at; // in the report

// The tile's film and two texels about it, in whole strips; row by row from below, the two's first.
const int kAbout = 2, kSeenStrips = kStrips + 2, kSeenRows = kTileSize + 2 * kAbout, kSeenRow = kSeenStrips * kStripSize;
shared int film[kSeenRows * kSeenRow];
int seenAt(ivec2 at) { return (at.y + kAbout) * kSeenRow + at.x + kStripSize; }

// Its texels as their neighbours see them, and those beside it.
const int kCellRow = kTileSize + 2;
shared vec4 cell_states[kCellRow * kCellRow];  // thickness, hollowness, slack, entry
shared ivec4 cell_wishes[kCellRow * kCellRow]; // along x and y, and to both sides
int cellAt(ivec2 at) { return (at.y + 1) * kCellRow + at.x + 1; }

// Of the glass below these, a code for each strip of a row; fields along their columns, at four edges of tiles.
const int kEdges = 4;
shared uint codes[kCellRow * kStrips];
shared vec4 column_metric[kEdges * kCellRow], column_drive[kEdges * kCellRow];

// What passes over the left and the lower edges of texels, and over the last ones' others.
shared int flow_x[kTileSize * (kTileSize + 1)], flow_y[kTileSize * (kTileSize + 1)];

shared int most_pl, giver; // of what texels offer to the drops; the first that offers so much
shared int drained_pl, blown_pl;

bool stirs(ivec2 tile, ivec2 last) {
  tile = clamp(tile, ivec2(0), last);
  return states[tile.y * tilesAcross() + tile.x].stirs[turn] != 0;
}

bool wakes(ivec2 tile) {
  ivec2 last = ivec2(tilesAcross(), count / tilesAcross()) - 1;
  return stirs(tile, last) || stirs(tile + ivec2(-1, 0), last) || stirs(tile + ivec2(1, 0), last) || stirs(tile + ivec2(0, -1), last) ||
         stirs(tile + ivec2(0, 1), last);
}

void tell(int t, FilmTile told) {
  int at = t * kFields;
  report[at] = told.event_texel;
  report[at + 1] = told.event_pl;
  report[at + kFilmLow] = int(told.film_low_pl);
  report[at + kFilmHigh] = int(told.film_high);
  report[at + 4] = told.drained_pl;
  report[at + 5] = told.blown_pl;
  report[at + 6] = told.evaporated_pl;
  report[at + kBeadsPl] = int(told.beads_pl);
}

int driedPl(int t) { return driesNow(uint(t), info) ? states[t].dried_pl : 0; }

void sleep(int t) {
  if (lane() != 0) return;
  states[t].awake = 0;
  states[t].stirs[1 - turn] = 0;
  tell(t, FilmTile(-1, 0, uint(states[t].last[kFilmLow]), uint(states[t].last[kFilmHigh]), 0, 0, driedPl(t), uint(states[t].last[kBeadsPl])));
}

void tellRidges() {
  const int kPieces = kMaxGlassWipers * kBladeSegments;
  for (int k = lane(); k < kPieces; k += kTileTexels) {
    report[ridges_at + k] = ridge_pl[k];
    report[ridges_at + kPieces + k] = int(thrown_pl[k]);
  }
}

void loadColumn(ivec2 tile, int k) {
  int x = k % kCellRow - 1, edge = k / kCellRow;
  int left = (tile.y + edge - 1) * (tilesAcross() + 1) + tile.x + (x >> 4);
  column_metric[k] = between(imageLoad(metric, left), imageLoad(metric, left + 1), fraction(x));
  column_drive[k] = between(imageLoad(drive, left), imageLoad(drive, left + 1), fraction(x));
}

void loadCodes(ivec2 tile, int row) {
  uvec4 own = imageLoad(glass, (tile.y * kTileSize + row - 1) * tilesAcross() + tile.x);
  for (int s = 0; s < kStrips; ++s) codes[row * kStrips + s] = own[s];
}

void loadStrip(ivec2 tile, int k) {
  int row = k / kSeenStrips, column = k % kSeenStrips;
  ivec4 own = imageLoad(before, (tile.y * kTileSize + row - kAbout) * tilesAcross() * kStrips + tile.x * kStrips + column - 1);
  for (int i = 0; i < kStripSize; ++i) film[row * kSeenRow + column * kStripSize + i] = own[i];
}

// Each by invocations that have nothing else to load.
void load(ivec2 tile) {
  const int kColumns = kEdges * kCellRow, kCodesFrom = 96, kStripsFrom = 128;
  if (lane() == 0) {
    most_pl = drained_pl = blown_pl = 0;
    giver = kTileTexels;
  }
  if (lane() < kColumns) loadColumn(tile, lane());
  else if (lane() >= kStripsFrom && lane() < kStripsFrom + kSeenRows * kSeenStrips) loadStrip(tile, lane() - kStripsFrom);
  else if (lane() >= kCodesFrom && lane() < kCodesFrom + kCellRow) loadCodes(tile, lane() - kCodesFrom);
}

vec4 metricAt(ivec2 at) {
  int low = ((at.y >> 4) + 1) * kCellRow + at.x + 1;
  return between(column_metric[low], column_metric[low + kCellRow], fraction(at.y));
}

FilmCell workedOut(ivec2 at, vec4 metric_here) {
  int low = ((at.y >> 4) + 1) * kCellRow + at.x + 1, s = clamp(at.x >> 2, 0, kStrips - 1), seen = seenAt(at);
  vec4 drive_here = between(column_drive[low], column_drive[low + kCellRow], fraction(at.y));
  FilmAround around = filmAround(film[seen], film[seen - 1], film[seen + 1], film[seen - kSeenRow], film[seen + kSeenRow]);
  int level = glassLevel(codes[(at.y + 1) * kStrips + s], at.x - s * kStripSize);
  FilmCell cell = filmCell(film[seen], around, level, drive_here, metric_here, info);
  cell_states[cellAt(at)] = vec4(cell.h_m, cell.hollowness, cell.slack, cell.entry_m);
  cell_wishes[cellAt(at)] = ivec4(cell.x_pl, cell.y_pl, cell.x_both_pl, cell.y_both_pl);
  return cell;
}

FilmCell known(ivec2 at) {
  vec4 is = cell_states[cellAt(at)];
  ivec4 wish = cell_wishes[cellAt(at)];
  return FilmCell(film[seenAt(at)], is.x, wish.x, wish.y, wish.z, wish.w, is.y, is.z, float(max(abs(wish.x), abs(wish.y))), is.w);
}

int alongX(FilmCell a, FilmCell b) { return flowBetween_pl(a, a.x_pl, a.x_both_pl, b, b.x_pl, b.x_both_pl, info); }
int alongY(FilmCell a, FilmCell b) { return flowBetween_pl(a, a.y_pl, a.y_both_pl, b, b.y_pl, b.y_both_pl, info); }
int edgeX(ivec2 at) { return at.y * (kTileSize + 1) + at.x; }
int edgeY(ivec2 at) { return at.y * kTileSize + at.x; }

// Those beside the tile, by the first invocations.
void workOutBeside() {
  int k = lane() % kTileSize, side = lane() / kTileSize;
  if (side >= 4) return;
  int beyond = (side & 1) == 0 ? -1 : kTileSize;
  ivec2 at = side < 2 ? ivec2(beyond, k) : ivec2(k, beyond);
  workedOut(at, metricAt(at));
}

// Over the tile's left and lower edges, by the last invocations.
void flowIn() {
  int k = lane() - (kTileTexels - 2 * kTileSize);
  if (k < 0) return;
  bool left = k < kTileSize;
  ivec2 at = left ? ivec2(0, k) : ivec2(k - kTileSize, 0);
  FilmCell from = known(left ? at - ivec2(1, 0) : at - ivec2(0, 1)), to = known(at);
  if (left) flow_x[edgeX(at)] = alongX(from, to);
  else flow_y[edgeY(at)] = alongY(from, to);
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward) {
  if (volume_pl == 0) return;
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) atomicAdd(blown_pl, volume_pl);
  else atomicAdd(drained_pl, volume_pl);
}

FilmTexel flowed(ivec2 at, FilmCell me, vec4 metric_here, Beads lying) {
  int left = flow_x[edgeX(at)], right = flow_x[edgeX(at + ivec2(1, 0))], below = flow_y[edgeY(at)], above = flow_y[edgeY(at + ivec2(0, 1))];
  bool on = me.volume_pl >= 0;
  if (on) {
    int seen = seenAt(at);
    if (film[seen - 1] < 0) leavePane(-left, vec2(-1.0, 0.0));
    if (film[seen + 1] < 0) leavePane(right, vec2(1.0, 0.0));
    if (film[seen - kSeenRow] < 0) leavePane(-below, vec2(0.0, -1.0));
    if (film[seen + kSeenRow] < 0) leavePane(above, vec2(0.0, 1.0));
  }
  int volume = me.volume_pl + passed(kFlow, left) - right + passed(kFlow, below) - above;
  FilmTexel now = settled(on ? volume : -1, lying, metric_here, info);
  now.beads.volume_pl = passed(kBead, now.beads.volume_pl);
  return now;
}

// One texel of a tile gives to the drops: the one with most, the first of those.
FilmTexel given(FilmTexel now) {
  if (now.gone_pl > 0) atomicMax(most_pl, now.gone_pl);
  barrier();
  if (now.gone_pl > 0 && now.gone_pl == most_pl) atomicMin(giver, lane());
  barrier();
  if (lane() == giver) now = without(now, now.gone_pl);
  return now;
}

void flow(int t, ivec2 tile, bool awake) {
  ivec2 at = laneAt();
  int place = placeIn(tile, at);
  uint lay = beads[place];
  load(tile);
  barrier();
  vec4 metric_here = metricAt(at);
  FilmCell me = workedOut(at, metric_here);
  workOutBeside();
  barrier();
  flow_x[edgeX(at + ivec2(1, 0))] = alongX(me, known(at + ivec2(1, 0)));
  flow_y[edgeY(at + ivec2(0, 1))] = alongY(me, known(at + ivec2(0, 1)));
  flowIn();
  barrier();
  FilmTexel now = flowed(at, me, metric_here, beadsOf(lay));
  // Asleep next time only if neighbours, too, have seen it lie still.
  int stirs = now.stirs | int(me.h_m >= info.pin_m);
  now = given(now);
  after[place] = now.film_pl;
  uint lie = packedBeads(now.beads);
  if (lie != lay) beads[place] = lie;
  ivec4 sum = summed(ivec4(toldOf(now.film_pl, now.beads.volume_pl), stirs));
  if (lane() != 0) return;
  bool gives = giver < kTileTexels;
  tell(t, FilmTile(gives ? texelOf(tile, ivec2(giver % kTileSize, giver / kTileSize)) : -1, gives ? most_pl : 0, uint(sum.x), uint(sum.y), drained_pl,
                   blown_pl, driedPl(t), uint(sum.z)));
  states[t].awake = int(awake);
  states[t].stirs[1 - turn] = int(sum.w != 0);
  states[t].last[kFilmLow] = sum.x;
  states[t].last[kFilmHigh] = sum.y;
  states[t].last[kBeadsPl] = sum.z;
}

void main() {
  int t = int(groupInRows());
  if (t > count) return;
  if (t == count) {
    tellRidges();
    return;
  }
  ivec2 tile = tileAt(t);
  bool awake = wakes(tile);
  if (awake || states[t].awake != 0) flow(t, tile, awake);
  else sleep(t);
}
