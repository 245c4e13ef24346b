// The film step of glass/film_flow.comp for GPUs: a group is a tile, an invocation a strip of it, whose texels' laws are worked out side by side. Groups
// hear of each other's nothing and of their own through shared memory, so that a texel's law is worked out 1.25 times, a face's flow once, and what all
// do but once a group or an invocation is shared by many texels. A group finds out by itself whether its tile is awake, and one more tells of the ridges:
// nothing goes before but what changes the film.
#include "glass/film_buffers.glsl"
const int kLanes = kStrips * kTileSize;
layout(local_size_x = kLanes) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // strips of texels side by side
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles
layout(rgba32f, binding = 2) readonly uniform imageBuffer drive;
layout(rgba32ui, binding = 3) readonly uniform uimageBuffer lying; // the beads' buffer below
layout(rgba32ui, binding = 4) readonly uniform uimageBuffer glass; // a code for each strip of a tile's row
layout(std430, binding = 2) writeonly buffer Report { ivec4 report[]; }; // FilmTile of each tile, and the ridges
layout(std430, binding = 3) writeonly buffer After { ivec4 after[]; };
layout(std430, binding = 6) writeonly buffer Lying { uvec4 beads[]; };
layout(location = 2) uniform int ridges_at; // in the report

ivec2 tile() { return ivec2(gl_WorkGroupID.xy); }
int acrossTiles() { return int(gl_NumWorkGroups.x); } // the last row of groups has no tiles
int lane() { return int(gl_LocalInvocationIndex); }
int stripIn(int row, int column) { return ((tile().y * kTileSize + row) * acrossTiles() + tile().x) * kStrips + column; }

// The tile's film and what is about it: two rows, and a strip on either side.
const int kRowsAbout = 2, kSeenStrips = kStrips + 2, kSeenRows = kTileSize + 2 * kRowsAbout;
shared ivec4 film[kSeenRows * kSeenStrips];
int seenAt(int row, int column) { return (row + kRowsAbout) * kSeenStrips + column + 1; }
int filmAt(ivec2 at) { return film[seenAt(at.y, at.x >> 2)][at.x & 3]; }

// Its texels as their neighbours see them, and those beside it: strips' first, second, third and fourth each together, as invocations side by side ask
// for them.
const int kCellStrips = kStrips + 1, kCellRows = kTileSize + 2;
shared vec4 cell_states[kStripSize * kCellRows * kCellStrips];  // thickness, hollowness, slack, entry
shared ivec4 cell_wishes[kStripSize * kCellRows * kCellStrips]; // along x and y, and to both sides
int cellAt(ivec2 at) { return ((at.x & 3) * kCellRows + at.y + 1) * kCellStrips + ((at.x + 1) >> 2); }

// Fields along the columns of texels, at four edges of tiles.
const int kEdges = 4, kColumns = kTileSize + 2;
shared vec4 column_metric[kEdges * kColumns], column_drive[kEdges * kColumns];

// What passes over strips' left ends, and the last ones' right; and over texels' lower edges, and the last ones' upper.
const int kEnds = kStrips + 1;
shared int flow_x[kTileSize * kEnds];
shared ivec4 flow_y[(kTileSize + 1) * kStrips];

shared ivec4 summands[kLanes];
shared int most_pl, giver; // of what texels offer to the drops; the first that offers so much
shared int drained_pl, blown_pl;

bool stirs(ivec2 at, ivec2 last) {
  at = clamp(at, ivec2(0), last);
  return states[at.y * acrossTiles() + at.x].stirs[turn] != 0;
}

bool wakes() {
  ivec2 last = (ivec2(info.columns, info.rows) - 1) / kTileSize;
  return stirs(tile(), last) || stirs(tile() + ivec2(-1, 0), last) || stirs(tile() + ivec2(1, 0), last) || stirs(tile() + ivec2(0, -1), last) ||
         stirs(tile() + ivec2(0, 1), last);
}

void tell(int t, FilmTile told) {
  report[2 * t] = ivec4(told.event_texel, told.event_pl, int(told.film_low_pl), int(told.film_high));
  report[2 * t + 1] = ivec4(told.drained_pl, told.blown_pl, told.evaporated_pl, int(told.beads_pl));
}

int driedPl(int t) { return driesNow(uint(t), info) ? states[t].dried_pl : 0; }

void sleep(int t) {
  if (lane() != 0) return;
  states[t].awake = 0;
  states[t].stirs[1 - turn] = 0;
  tell(t, FilmTile(-1, 0, uint(states[t].last[kFilmLow]), uint(states[t].last[kFilmHigh]), 0, 0, driedPl(t), uint(states[t].last[kBeadsPl])));
}

void tellRidges() {
  const int kFours = kMaxGlassWipers * kBladeSegments / 4;
  for (int k = lane(); k < kFours; k += kLanes) {
    report[ridges_at / 4 + k] = ivec4(ridge_pl[4 * k], ridge_pl[4 * k + 1], ridge_pl[4 * k + 2], ridge_pl[4 * k + 3]);
    report[ridges_at / 4 + kFours + k] = ivec4(thrown_pl[4 * k], thrown_pl[4 * k + 1], thrown_pl[4 * k + 2], thrown_pl[4 * k + 3]);
  }
}

// A texel's place between the edges of its tile.
float fraction(int at) { return (float(at & (kTileSize - 1)) + 0.5) / float(kTileSize); }

void loadColumn(int k) {
  int x = k % kColumns - 1, edge = k / kColumns;
  int left = (tile().y + edge - 1) * (acrossTiles() + 1) + tile().x + (x >> 4);
  column_metric[k] = between(imageLoad(metric, left), imageLoad(metric, left + 1), fraction(x));
  column_drive[k] = between(imageLoad(drive, left), imageLoad(drive, left + 1), fraction(x));
}

void loadStrip(int row, int column) { film[seenAt(row, column)] = imageLoad(before, stripIn(row, column)); }

// Of what is about the tile: the rows first, then the strips on both sides.
void loadAbout(int k) {
  const int kInRows = 2 * kRowsAbout * kSeenStrips;
  if (k < kInRows) {
    int row = k / kSeenStrips;
    loadStrip(row < kRowsAbout ? row - kRowsAbout : kTileSize + row - kRowsAbout, k % kSeenStrips - 1);
  } else if (k < kInRows + 2 * kTileSize) {
    loadStrip((k - kInRows) >> 1, (k & 1) == 0 ? -1 : kStrips);
  }
}

void load(int row, int column) {
  if (lane() == 0) {
    most_pl = drained_pl = blown_pl = 0;
    giver = kTileSize * kTileSize;
  }
  loadStrip(row, column);
  loadAbout(lane());
  for (int k = lane(); k < kEdges * kColumns; k += kLanes) loadColumn(k);
}

int lowerEdge(ivec2 at) { return ((at.y >> 4) + 1) * kColumns + at.x + 1; }

vec4 metricAt(ivec2 at) {
  int low = lowerEdge(at);
  return between(column_metric[low], column_metric[low + kColumns], fraction(at.y));
}

FilmCell workedOut(ivec2 at, int volume_pl, FilmAround around, uint code, vec4 metric_here) {
  int low = lowerEdge(at);
  vec4 drive_here = between(column_drive[low], column_drive[low + kColumns], fraction(at.y));
  int level = glassLevel(code, at.x - clamp(at.x >> 2, 0, kStrips - 1) * kStripSize);
  FilmCell cell = filmCell(volume_pl, around, level, drive_here, metric_here, info);
  cell_states[cellAt(at)] = vec4(cell.h_m, cell.hollowness, cell.slack, cell.entry_m);
  cell_wishes[cellAt(at)] = ivec4(cell.x_pl, cell.y_pl, cell.x_both_pl, cell.y_both_pl);
  return cell;
}

FilmCell known(ivec2 at) {
  vec4 is = cell_states[cellAt(at)];
  ivec4 wish = cell_wishes[cellAt(at)];
  return FilmCell(filmAt(at), is.x, wish.x, wish.y, wish.z, wish.w, is.y, is.z, float(max(abs(wish.x), abs(wish.y))), is.w);
}

int alongX(FilmCell a, FilmCell b) { return flowBetween_pl(a, a.x_pl, a.x_both_pl, b, b.x_pl, b.x_both_pl, info); }
int alongY(FilmCell a, FilmCell b) { return flowBetween_pl(a, a.y_pl, a.y_both_pl, b, b.y_pl, b.y_both_pl, info); }

// One of the texels beside the tile for each invocation.
ivec2 beside() {
  int k = lane() % kTileSize, side = lane() / kTileSize, beyond = (side & 1) == 0 ? -1 : kTileSize;
  return side < 2 ? ivec2(beyond, k) : ivec2(k, beyond);
}

uint codeAt(ivec2 at) { return imageLoad(glass, (tile().y * kTileSize + at.y) * acrossTiles() + tile().x)[clamp(at.x >> 2, 0, kStrips - 1)]; }

void workOutBeside(ivec2 at, uint code) {
  FilmAround around = filmAround(filmAt(at), filmAt(at - ivec2(1, 0)), filmAt(at + ivec2(1, 0)), filmAt(at - ivec2(0, 1)), filmAt(at + ivec2(0, 1)));
  workedOut(at, filmAt(at), around, code, metricAt(at));
}

// Over the tile's left and lower edges, by the first invocations.
void flowIn() {
  int k = lane() % kTileSize, side = lane() / kTileSize;
  if (side == 0) flow_x[k * kEnds] = alongX(known(ivec2(-1, k)), known(ivec2(0, k)));
  if (side == 1) flow_y[k >> 2][k & 3] = alongY(known(ivec2(k, -1)), known(ivec2(k, 0)));
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward) {
  if (volume_pl == 0) return;
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) atomicAdd(blown_pl, volume_pl);
  else atomicAdd(drained_pl, volume_pl);
}

// What passes over a texel's edges, and who is beyond them.
struct Passing { int left_pl, right_pl, below_pl, above_pl; };

FilmTexel flowed(int volume_pl, Passing over, Passing beyond, uint lay, vec4 metric_here) {
  bool on = volume_pl >= 0;
  if (on) {
    if (beyond.left_pl < 0) leavePane(-over.left_pl, vec2(-1.0, 0.0));
    if (beyond.right_pl < 0) leavePane(over.right_pl, vec2(1.0, 0.0));
    if (beyond.below_pl < 0) leavePane(-over.below_pl, vec2(0.0, -1.0));
    if (beyond.above_pl < 0) leavePane(over.above_pl, vec2(0.0, 1.0));
  }
  int volume = volume_pl + passed(kFlow, over.left_pl) - over.right_pl + passed(kFlow, over.below_pl) - over.above_pl;
  FilmTexel now = settled(on ? volume : -1, beadsOf(lay), metric_here, info);
  now.beads.volume_pl = passed(kBead, now.beads.volume_pl);
  return now;
}

// One texel of a tile gives to the drops: the one with most, the first of those.
int offerOf(FilmTexel now[kStripSize]) {
  int most = 0;
  for (int i = 0; i < kStripSize; ++i) most = max(most, now[i].gone_pl);
  return most;
}

void give(inout FilmTexel now[kStripSize], int first) {
  int offer_pl = offerOf(now);
  if (offer_pl > 0) atomicMax(most_pl, offer_pl);
  barrier();
  if (most_pl == 0) return; // the same for all
  for (int i = kStripSize - 1; i >= 0; --i) {
    if (now[i].gone_pl == most_pl) atomicMin(giver, first + i);
  }
  barrier();
  for (int i = 0; i < kStripSize; ++i) {
    if (giver == first + i) now[i] = without(now[i], now[i].gone_pl);
  }
}

// As a tile tells it: low and high part of its film, its beads; and whether any stirs.
ivec4 toldOf(FilmTexel now) {
  int whole = max(now.film_pl, 0);
  return ivec4(whole & 0xffff, whole >> 16, now.beads.volume_pl, now.stirs);
}

// The group's sum, for its first invocation. In two stages: with atomics all would wait for one address.
ivec4 summed(ivec4 own) {
  const int kStage = 8;
  summands[lane()] = own;
  barrier();
  if (lane() < kStage) {
    for (int k = lane() + kStage; k < kLanes; k += kStage) own += summands[k];
    summands[lane()] = own;
  }
  barrier();
  if (lane() == 0) {
    for (int k = 1; k < kStage; ++k) own += summands[k];
  }
  return own;
}

void flow(int t, bool awake) {
  int row = lane() / kStrips, column = lane() % kStrips, strip = stripIn(row, column);
  ivec2 at = ivec2(column * kStripSize, row), next_to = beside();
  uint code = codeAt(at), code_beside = codeAt(next_to);
  uvec4 lay = imageLoad(lying, strip);
  load(row, column);
  barrier();

  int seen = seenAt(row, column);
  ivec4 own = film[seen], below = film[seen - kSeenStrips], above = film[seen + kSeenStrips];
  int left = film[seen - 1].w, right = film[seen + 1].x;
  vec4 metric_here[kStripSize];
  FilmCell me[kStripSize];
  for (int i = 0; i < kStripSize; ++i) {
    ivec2 here = at + ivec2(i, 0);
    metric_here[i] = metricAt(here);
    FilmAround around = filmAround(own[i], i > 0 ? own[max(i - 1, 0)] : left, i < 3 ? own[min(i + 1, 3)] : right, below[i], above[i]);
    me[i] = workedOut(here, own[i], around, code, metric_here[i]);
  }
  workOutBeside(next_to, code_beside);
  barrier();

  ivec4 to_right, to_above;
  for (int i = 0; i < kStripSize; ++i) {
    if (i + 1 < kStripSize) to_right[i] = alongX(me[i], me[min(i + 1, 3)]);
    else to_right[i] = alongX(me[i], known(at + ivec2(kStripSize, 0)));
    to_above[i] = alongY(me[i], known(at + ivec2(i, 1)));
  }
  flow_x[row * kEnds + column + 1] = to_right.w;
  flow_y[(row + 1) * kStrips + column] = to_above;
  flowIn();
  barrier();

  ivec4 from_below = flow_y[row * kStrips + column], from_left = ivec4(flow_x[row * kEnds + column], to_right.xyz);
  ivec4 beyond_left = ivec4(left, own.xyz), beyond_right = ivec4(own.yzw, right);
  FilmTexel now[kStripSize];
  // Asleep next time only if neighbours, too, have seen it lie still.
  int stirred = 0;
  for (int i = 0; i < kStripSize; ++i) {
    now[i] = flowed(own[i], Passing(from_left[i], to_right[i], from_below[i], to_above[i]), Passing(beyond_left[i], beyond_right[i], below[i], above[i]),
                    lay[i], metric_here[i]);
    stirred |= int(me[i].h_m >= info.pin_m);
  }
  give(now, row * kTileSize + at.x);
  after[strip] = ivec4(now[0].film_pl, now[1].film_pl, now[2].film_pl, now[3].film_pl);
  uvec4 lie = uvec4(packedBeads(now[0].beads), packedBeads(now[1].beads), packedBeads(now[2].beads), packedBeads(now[3].beads));
  if (lie != lay) beads[strip] = lie;
  ivec4 sum = summed(toldOf(now[0]) + toldOf(now[1]) + toldOf(now[2]) + toldOf(now[3]) + ivec4(0, 0, 0, stirred));
  if (lane() != 0) return;
  bool gives = most_pl > 0;
  ivec2 given_at = tile() * kTileSize + ivec2(giver % kTileSize, giver / kTileSize);
  tell(t, FilmTile(gives ? given_at.y * info.columns + given_at.x : -1, most_pl, uint(sum.x), uint(sum.y), drained_pl, blown_pl, driedPl(t), uint(sum.z)));
  states[t].awake = int(awake);
  states[t].stirs[1 - turn] = int(sum.w != 0);
  states[t].last[kFilmLow] = sum.x;
  states[t].last[kFilmHigh] = sum.y;
  states[t].last[kBeadsPl] = sum.z;
}

void main() {
  int t = tile().y * acrossTiles() + tile().x;
  if (tile().y * kTileSize >= info.rows) {
    if (tile().x == 0) tellRidges();
    return;
  }
  bool awake = wakes();
  if (awake || states[t].awake != 0) flow(t, awake);
  else sleep(t);
}
