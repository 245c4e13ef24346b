// For GPUs all that a film step does after what changes the film and blades, as glass/film_flow.comp and glass/film_dry.comp have it: a group is a tile,
// an invocation a texel of it, which works out its own law and hears of others through shared memory; so a law is worked out 1.25 times, a face's flow
// 1.06 times. A group finds out by itself whether its tile is awake or to dry, and one of a row more tells of the ridges, as a kernel that waits for
// another costs more than groups with nothing to do.
//
// How fast it is hangs on how many groups a processor holds, and that on how little shared memory one needs: of an NVIDIA H200's 228 KiB OpenGL gives 48
// to a processor (with 21 KiB a group two are held, with 11 four, in 0.7 of the time). So words are used again where they can be.
#include "glass/film_buffers.glsl"
const int kTileTexels = kTileSize * kTileSize;
layout(local_size_x = kTileTexels) in;
layout(r32ui, binding = 4) readonly uniform uimageBuffer glass; // a code for each strip of a tile's row
layout(std430, binding = 0) readonly buffer Metric { vec4 metric[]; }; // of the corners of tiles (PaneMap::nodeMetric)
layout(std430, binding = 2) writeonly buffer Report { ivec4 report[]; }; // FilmTile of each tile, and the ridges
layout(std430, binding = 3) writeonly buffer After { int after[]; };
layout(std430, binding = 4) readonly buffer Drive { vec4 drive[]; };
layout(std430, binding = 6) buffer Lying { uint beads[]; };
layout(std430, binding = 7) buffer Before { int before[]; };
layout(location = 2) uniform int ridges_at; // in the report

int lane() { return int(gl_LocalInvocationIndex); }
ivec2 laneAt() { return ivec2(gl_LocalInvocationIndex % uint(kTileSize), gl_LocalInvocationIndex / uint(kTileSize)); }
ivec2 tile() { return ivec2(gl_WorkGroupID.xy); }
ivec2 tiles() { return ivec2(gl_NumWorkGroups.x, (uint(info.rows) + uint(kTileSize) - 1u) / uint(kTileSize)); }
int texelOf(ivec2 at) { return (tile().y * kTileSize + at.y) * info.columns + tile().x * kTileSize + at.x; }
int placeIn(ivec2 at) { return ((tile().y * kTileSize + at.y) * tiles().x + tile().x) * kTileSize + at.x; }

// The tile's film and two texels about it, row by row from below.
const int kAbout = 2, kSeenRow = kTileSize + 2 * kAbout;
shared int film[kSeenRow * kSeenRow];
int seenAt(ivec2 at) { return (at.y + kAbout) * kSeenRow + at.x + kAbout; }

// Its texels as their neighbours see them, and those beside it.
const int kCellRow = kTileSize + 2, kCells = kCellRow * kCellRow;
shared float cell_h_m[kCells], cell_hollowness[kCells];
shared float cell_slack[kCells]; // of wet ones; of others, which have nothing to give, -entry_m
shared int cell_pl[4 * kCells]; // along x and y, and to both sides
const int kX = 0, kY = kCells, kXBoth = 2 * kCells, kYBoth = 3 * kCells;
int cellAt(ivec2 at) { return (at.y + 1) * kCellRow + at.x + 1; }

// At the corners of the tile and of those beside it.
const int kNodes = 4;
shared vec4 node_metric[kNodes * kNodes], node_drive[kNodes * kNodes];

shared int stirring, was_awake, stirs_next; // it or a tile beside it now, as it was in the last step, it in the next
shared int lies; // other than 0 where there is water on it, as its last report had it
shared int most_pl, giver; // of what may go from texels to the drops, then what does; the first that has so much
shared int drained_pl, blown_pl;

void tell(int t, FilmTile told) {
  report[2 * t] = ivec4(told.event_texel, told.event_pl, int(told.film_low_pl), int(told.film_high));
  report[2 * t + 1] = ivec4(told.drained_pl, told.blown_pl, told.evaporated_pl, int(told.beads_pl));
}

void sleep(int t) {
  states[t].awake = 0;
  states[t].stirs[1 - turn] = 0;
  tell(t, FilmTile(-1, 0, uint(states[t].lies[0]), uint(states[t].lies[1]), 0, 0, 0, uint(states[t].lies[2])));
}

void tellRidges() {
  const int kFours = kMaxGlassWipers * kBladeSegments / 4;
  for (int k = lane(); k < kFours; k += kTileTexels) {
    int p = 4 * k;
    report[ridges_at / 4 + k] = ivec4(ridge_pl[p], ridge_pl[p + 1], ridge_pl[p + 2], ridge_pl[p + 3]);
    report[ridges_at / 4 + kFours + k] = ivec4(thrown_pl[p], thrown_pl[p + 1], thrown_pl[p + 2], thrown_pl[p + 3]);
  }
}

// Past the grid's edge there is no film to be seen: any will do, beyond texels that are off the pane.
void loadFilm(ivec2 at) {
  ivec2 from = clamp(tile() * kTileSize + at, ivec2(0), tiles() * kTileSize - 1);
  film[seenAt(at)] = before[from.y * tiles().x * kTileSize + from.x];
}

// The two rows below and above, then two columns on either side.
ivec2 aboutTile(int k) {
  const int kInRows = 2 * kAbout * kSeenRow;
  if (k < kInRows) {
    int row = k / kSeenRow, x = k - row * kSeenRow;
    return ivec2(x - kAbout, row < kAbout ? row - kAbout : row + kTileSize - kAbout);
  }
  int column = (k - kInRows) & 3;
  return ivec2(column < kAbout ? column - kAbout : column + kTileSize - kAbout, (k - kInRows) >> 2);
}

void loadNode(int k) {
  ivec2 node = clamp(tile() + ivec2(k & 3, k >> 2) - 1, ivec2(0), tiles());
  int from = node.y * (tiles().x + 1) + node.x;
  node_metric[k] = metric[from];
  node_drive[k] = drive[from];
}

// Whether the tile or one beside it stirs.
void lookAtState(int k) {
  ivec2 at = tile() + ivec2(k == 1 ? -1 : k == 2 ? 1 : 0, k == 3 ? -1 : k == 4 ? 1 : 0);
  at = clamp(at, ivec2(0), tiles() - 1);
  if (states[at.y * tiles().x + at.x].stirs[turn] != 0) stirring = 1;
}

// Each by invocations that have the least else to load.
void load(int t) {
  const int kFilmAbout = kSeenRow * kSeenRow - kTileTexels, kNodesFrom = 160, kStatesFrom = 192, kAwakeAt = 224, kLiesAt = 225;
  loadFilm(laneAt());
  int k = lane();
  if (k < kFilmAbout) loadFilm(aboutTile(k));
  else if (k >= kNodesFrom && k < kNodesFrom + kNodes * kNodes) loadNode(k - kNodesFrom);
  else if (k >= kStatesFrom && k < kStatesFrom + 5) lookAtState(k - kStatesFrom);
  else if (k == kAwakeAt) was_awake = states[t].awake;
  else if (k == kLiesAt) lies = states[t].lies[0] | states[t].lies[1] | states[t].lies[2];
}

int nodeAt(ivec2 at) { return ((at.y >> 4) + 1) * kNodes + (at.x >> 4) + 1; }
vec2 betweenNodesAt(ivec2 at) { return vec2(placeAcross(at.x), placeUp(at.y)); }
vec4 metricAt(ivec2 at) {
  int k = nodeAt(at);
  return betweenNodes(node_metric[k], node_metric[k + 1], node_metric[k + kNodes], node_metric[k + kNodes + 1], betweenNodesAt(at));
}
vec4 driveAt(ivec2 at) {
  int k = nodeAt(at);
  return betweenNodes(node_drive[k], node_drive[k + 1], node_drive[k + kNodes], node_drive[k + kNodes + 1], betweenNodesAt(at));
}

int levelAt(ivec2 at) {
  int strip = clamp(at.x >> 2, 0, kStrips - 1);
  uint code = imageLoad(glass, ((tile().y * kTileSize + at.y) * tiles().x + tile().x) * kStrips + strip).x;
  return glassLevel(code, at.x - strip * kStripSize);
}

FilmCell workedOut(ivec2 at, int level, vec4 metric_here) {
  int seen = seenAt(at), k = cellAt(at);
  FilmAround around = filmAround(film[seen], film[seen - 1], film[seen + 1], film[seen - kSeenRow], film[seen + kSeenRow]);
  FilmCell cell = filmCell(film[seen], around, level, driveAt(at), metric_here, info);
  cell_h_m[k] = cell.h_m;
  cell_hollowness[k] = cell.hollowness;
  cell_slack[k] = cell.h_m >= info.pin_m ? cell.slack : -cell.entry_m;
  cell_pl[kX + k] = cell.x_pl;
  cell_pl[kY + k] = cell.y_pl;
  cell_pl[kXBoth + k] = cell.x_both_pl;
  cell_pl[kYBoth + k] = cell.y_both_pl;
  return cell;
}

FilmCell known(ivec2 at) {
  int k = cellAt(at), x_pl = cell_pl[kX + k], y_pl = cell_pl[kY + k];
  float slack = cell_slack[k];
  return FilmCell(film[seenAt(at)], cell_h_m[k], x_pl, y_pl, cell_pl[kXBoth + k], cell_pl[kYBoth + k], cell_hollowness[k], slack, max(-slack, 0.0));
}

int alongX(FilmCell a, FilmCell b) { return flowBetween_pl(a, a.x_pl, a.x_both_pl, b, b.x_pl, b.x_both_pl, info); }
int alongY(FilmCell a, FilmCell b) { return flowBetween_pl(a, a.y_pl, a.y_both_pl, b, b.y_pl, b.y_both_pl, info); }

// Those beside the tile, by the first invocations.
const int kBeside = 4 * kTileSize;
ivec2 besideTile() {
  int k = laneAt().x, side = laneAt().y, beyond = (side & 1) == 0 ? -1 : kTileSize;
  return side < 2 ? ivec2(beyond, k) : ivec2(k, beyond);
}

// Over texels' left and lower edges, and the last ones' others: in words that laws no longer need.
int overX(ivec2 at) { return at.y * (kTileSize + 1) + at.x; }
int overY(ivec2 at) { return at.y * kTileSize + at.x; }

// Over the tile's right and upper edges, by the last invocations.
int flowOut(ivec2 at, bool to_right) {
  FilmCell from = known(at), to = known(to_right ? at + ivec2(1, 0) : at + ivec2(0, 1));
  return to_right ? alongX(from, to) : alongY(from, to);
}

void passOver(ivec2 at, FilmCell me) {
  int k = lane() - (kTileTexels - 2 * kTileSize), last = kTileSize - 1;
  bool to_right = k < kTileSize;
  ivec2 at_edge = to_right ? ivec2(last, k) : ivec2(k - kTileSize, last);
  int left_pl = alongX(known(at - ivec2(1, 0)), me), below_pl = alongY(known(at - ivec2(0, 1)), me), out_pl = 0;
  if (k >= 0) out_pl = flowOut(at_edge, to_right);
  barrier();
  cell_pl[kX + overX(at)] = left_pl;
  cell_pl[kY + overY(at)] = below_pl;
  if (k >= 0 && to_right) cell_pl[kX + overX(at_edge + ivec2(1, 0))] = out_pl;
  if (k >= 0 && !to_right) cell_pl[kY + overY(at_edge + ivec2(0, 1))] = out_pl;
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(ivec4 over_pl) {
  bvec4 up = greaterThan(vec4(-info.up_x, info.up_x, -info.up_y, info.up_y), vec4(0.5));
  ivec4 up_pl = over_pl * ivec4(up);
  int blown = up_pl.x + up_pl.y + up_pl.z + up_pl.w, drained = over_pl.x + over_pl.y + over_pl.z + over_pl.w - blown;
  if (blown != 0) atomicAdd(blown_pl, blown);
  if (drained != 0) atomicAdd(drained_pl, drained);
}

FilmTexel flowed(ivec2 at, int volume_pl, uint lay, vec4 metric_here) {
  int left = cell_pl[kX + overX(at)], right = cell_pl[kX + overX(at + ivec2(1, 0))], below = cell_pl[kY + overY(at)], above = cell_pl[kY + overY(at + ivec2(0, 1))];
  int seen = seenAt(at);
  bool on = volume_pl >= 0;
  bvec4 beyond_off = lessThan(ivec4(film[seen - 1], film[seen + 1], film[seen - kSeenRow], film[seen + kSeenRow]), ivec4(0));
  if (on && any(beyond_off)) leavePane(ivec4(-left, right, -below, above) * ivec4(beyond_off));
  int volume = volume_pl + passed(kFlow, left) - right + passed(kFlow, below) - above;
  FilmTexel now = settled(on ? volume : -1, beadsOf(lay), metric_here, info);
  now.beads.volume_pl = passed(kBead, now.beads.volume_pl);
  return now;
}

// One texel of a tile gives to the drops: the one with most, the first of those.
FilmTexel given(FilmTexel now) {
  if (now.gone_pl > 0) atomicMax(most_pl, now.gone_pl);
  barrier();
  if (now.gone_pl > 0 && now.gone_pl == most_pl) atomicMin(giver, lane());
  barrier();
  if (lane() == giver) {
    most_pl = offered_pl(now.gone_pl, now.beads);
    now = without(now, most_pl);
  }
  return now;
}

// The group's sum, for its first invocation, in words that nobody else needs any more. In two stages: with atomics all would wait for one address.
ivec4 summed(ivec4 own) {
  const int kStage = 16;
  for (int c = 0; c < 4; ++c) cell_pl[c * kCells + lane()] = own[c];
  barrier();
  int sum = 0, first = lane() / kStage * kCells + lane() % kStage;
  if (lane() < 4 * kStage) {
    for (int k = 0; k < kTileTexels; k += kStage) sum += cell_pl[first + k];
    cell_pl[first] = sum;
  }
  barrier();
  ivec4 total = ivec4(0);
  if (lane() == 0) {
    for (int k = 0; k < kStage; ++k) total += ivec4(cell_pl[k], cell_pl[kCells + k], cell_pl[2 * kCells + k], cell_pl[3 * kCells + k]);
  }
  return total;
}

// What its texel's film and beads come to.
FilmTexel flow(uint lay, int level, int level_beside, vec4 metric_here) {
  ivec2 at = laneAt();
  FilmCell me = workedOut(at, level, metric_here);
  if (lane() < kBeside) workedOut(besideTile(), level_beside, metricAt(besideTile()));
  barrier();
  passOver(at, me);
  barrier();
  FilmTexel now = flowed(at, me.volume_pl, lay, metric_here);
  // Asleep next time only if neighbours, too, have seen it lie still.
  if (now.stirs != 0 || me.h_m >= info.pin_m) stirs_next = 1;
  return given(now);
}

// One that sleeps stays asleep, and nothing brings one copy of its film to the other: both are written. A group beside may be reading the one before: it
// finds a film that lies still there, dried or not, which closes no front (a test of the presets) and asks for nothing.
void put(FilmTexel now, uint lay) {
  int place = placeIn(laneAt());
  if (stirring == 0 && now.film_pl != film[seenAt(laneAt())]) before[place] = now.film_pl;
  after[place] = now.film_pl;
  uint lie = packedBeads(now.beads);
  if (lie != lay) beads[place] = lie;
}

// Low and high part of a texel's film, its beads, what of both has dried: summed for the tile's report.
void tellAll(int t, FilmTexel now, int dried_pl) {
  int whole = max(now.film_pl, 0);
  ivec4 sum = summed(ivec4(whole & 0xffff, whole >> 16, now.beads.volume_pl, dried_pl));
  if (lane() != 0) return;
  bool gives = giver < kTileTexels;
  tell(t, FilmTile(gives ? texelOf(ivec2(giver % kTileSize, giver / kTileSize)) : -1, gives ? most_pl : 0, uint(sum.x), uint(sum.y), drained_pl, blown_pl,
                   sum.w, uint(sum.z)));
  states[t].awake = stirring;
  states[t].stirs[1 - turn] = stirs_next;
  states[t].lies = int[3](sum.x, sum.y, sum.z);
}

void begin() {
  if (lane() == 0) {
    stirring = stirs_next = most_pl = drained_pl = blown_pl = 0;
    giver = kTileTexels;
  }
}

void stepTile() {
  int t = tile().y * tiles().x + tile().x;
  begin();
  barrier();
  // Asked for before it is known whether the tile is awake, so that all is waited for at once.
  uint lay = beads[placeIn(laneAt())];
  int level = levelAt(laneAt()), level_beside = lane() < kBeside ? levelAt(besideTile()) : 0;
  load(t);
  barrier();
  bool flows = stirring != 0 || was_awake != 0, dries = driesNow(uint(t), info) && (flows || lies != 0);
  if (flows || dries) {
    vec4 metric_here = metricAt(laneAt());
    FilmTexel now = asItIs(film[seenAt(laneAt())], beadsOf(lay));
    if (flows) now = flow(lay, level, level_beside, metric_here);
    int dried_pl = 0;
    if (dries) {
      now = dried(now.film_pl, now.beads, uint(texelOf(laneAt())), metric_here, info);
      dried_pl = now.gone_pl;
    }
    put(now, lay);
    tellAll(t, now, dried_pl);
  } else if (lane() == 0) {
    sleep(t);
  }
}

// Where ridges are to be told of the last row of groups has no tiles.
void main() {
  if (tile().y < tiles().y) stepTile();
  else if (tile().x == 0) tellRidges();
}
