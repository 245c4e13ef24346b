// A film step: every texel gathers what its neighbours give and gives what they gather, takes in beads that it flows over, and may offer water to
// the drops. It reads the film in one buffer and writes it to another, so that all see it as it was; beads it changes where they are. The
// law is in shared/glass_film.glsl.
// Invocations walk over kColumns columns of a tile that is awake, kWalkRows rows from its lower or upper edge towards its middle, and keep what they
// know of a texel for the next. Software GL, too, reads buffers as images fast, but as storage slowly, and runs through branches that nobody takes.
#include "glass/film_buffers.glsl"
layout(local_size_x = kGroup) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // strips of texels side by side
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles
layout(rgba32f, binding = 2) readonly uniform imageBuffer drive;
layout(rgba32ui, binding = 3) readonly uniform uimageBuffer lying; // beads: the buffer below
layout(r32ui, binding = 4) readonly uniform uimageBuffer glass;    // a code for each strip
layout(std430, binding = 3) buffer After { ivec4 after[]; };
layout(std430, binding = 6) buffer Lying { uvec4 beads[]; };
layout(std430, binding = 2) writeonly buffer Report { int tiles[]; }; // FilmTile
layout(std430, binding = 4) readonly buffer Awake {
  AwakeTiles awake[2], drying[2];
  int listed[];
};

const int kColumns = kWalkStrips * kStripSize;

// What an invocation saw on its way.
struct Walk {
  FilmTile sums; // its part of the tile's report; the event is its greatest offer
  int stirs;
};
// What the walks of a group tell each other: fields of FilmTile, then whether it stirs and the offering texel's film and beads.
const int kFields = 8, kStirs = 8, kFilm = 9, kBeads = 10, kTold = 11;
shared int told[kTold * kGroup];

// Fields at a corner of tiles, and along a column of a tile: at its lower and its upper edge.
struct Corner { vec4 metric, drive; };
struct Column { Corner low, high; };

Corner cornerOf(int tile_x, int tile_y) {
  int at = tile_y * (tilesAcross() + 1) + tile_x;
  return Corner(imageLoad(metric, at), imageLoad(drive, at));
}
Corner between(Corner a, Corner b, float f) { return Corner(between(a.metric, b.metric, f), between(a.drive, b.drive, f)); }
Corner chosen(bool first, Corner a, Corner b) { return Corner(first ? a.metric : b.metric, first ? a.drive : b.drive); }

// A texel's place between the edges of its tile.
float fraction(int at) { return (float(at & (kTileSize - 1)) + 0.5) / float(kTileSize); }

FilmCell cellOf(Column column, int y, int volume_pl, FilmAround around, int level, FilmStepInfo step) {
  Corner here = between(column.low, column.high, fraction(y));
  return filmCell(volume_pl, around, level, here.drive, here.metric, step);
}

// A row of an invocation's texels, with the two on either side of them that its law asks for: texel k is the k + 2nd.
struct Row { int at[kColumns + 4]; };
Row rowOf(int strip) {
  Row row;
  ivec4 left = imageLoad(before, strip - 1), right = imageLoad(before, strip + kWalkStrips);
  row.at[0] = left.z;
  row.at[1] = left.w;
  for (int s = 0; s < kWalkStrips; ++s) {
    ivec4 own = imageLoad(before, strip + s);
    for (int k = 0; k < kStripSize; ++k) row.at[s * kStripSize + k + 2] = own[k];
  }
  row.at[kColumns + 2] = right.x;
  row.at[kColumns + 3] = right.y;
  return row;
}
FilmAround aroundOf(Row row, int k, int behind_pl, int ahead_pl) {
  return filmAround(row.at[k + 2], row.at[k + 1], row.at[k + 3], behind_pl, ahead_pl);
}

// The glass below a row of texels.
struct Glass { uint codes[kWalkStrips]; };
Glass glassOf(int strip) {
  Glass under;
  for (int s = 0; s < kWalkStrips; ++s) under.codes[s] = imageLoad(glass, strip + s).x;
  return under;
}
int levelAt(Glass under, int k) {
  int s = min(max(k, 0) / kStripSize, kWalkStrips - 1);
  return glassLevel(under.codes[s], k - s * kStripSize);
}

struct Strips { uint of[kColumns]; };
Strips beadsIn(int strip) {
  Strips row;
  for (int s = 0; s < kWalkStrips; ++s) {
    uvec4 own = imageLoad(lying, strip + s);
    for (int k = 0; k < kStripSize; ++k) row.of[s * kStripSize + k] = own[k];
  }
  return row;
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward, inout FilmTile sums) {
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) sums.blown_pl += volume_pl;
  else sums.drained_pl += volume_pl;
}

Walk walk(ivec2 tile, int lane) {
  FilmStepInfo step = info;
  int part = lane / kWalksAcross, upward = kWalks / kWalksAcross / 2, across = tilesAcross() * kStrips;
  int up = part < upward ? 1 : -1, from = up > 0 ? part * kWalkRows : kTileSize - 1 - (part - upward) * kWalkRows;
  int column = lane % kWalksAcross * kColumns, x = tile.x * kTileSize + column, y = tile.y * kTileSize + from;
  int strip = y * across + x / kStripSize, texel = y * step.columns + x;

  // Corners of the tile, and of those beside and behind it where the way begins at its edge.
  bool at_left = column == 0, at_right = column + kColumns == kTileSize, at_edge = part % upward == 0;
  Corner low_left = cornerOf(tile.x, tile.y), low_right = cornerOf(tile.x + 1, tile.y);
  Corner high_left = cornerOf(tile.x, tile.y + 1), high_right = cornerOf(tile.x + 1, tile.y + 1);
  int beyond_left = tile.x - int(at_left), beyond_right = tile.x + 1 + int(at_right);
  float f_left = fraction(x - 1), f_right = fraction(x + kColumns);
  Column left_column = Column(between(cornerOf(beyond_left, tile.y), chosen(at_left, low_left, low_right), f_left),
                              between(cornerOf(beyond_left, tile.y + 1), chosen(at_left, high_left, high_right), f_left));
  Column right_column = Column(between(chosen(at_right, low_right, low_left), cornerOf(beyond_right, tile.y), f_right),
                               between(chosen(at_right, high_right, high_left), cornerOf(beyond_right, tile.y + 1), f_right));
  int beyond = !at_edge || up < 0 ? tile.y + 1 + int(at_edge) : tile.y - 1;
  Corner beyond_low = cornerOf(tile.x, beyond), beyond_high = cornerOf(tile.x + 1, beyond);

  Column columns[kColumns];
  FilmCell me[kColumns];
  int from_back[kColumns];
  bool back_off[kColumns];
  // The rows behind, here and ahead; of the two beyond only what lies in the own columns.
  Row farthest_back = rowOf(strip - 2 * up * across), last = rowOf(strip - up * across), here = rowOf(strip), ahead = rowOf(strip + up * across);
  Glass glass_last = glassOf(strip - up * across), glass_here = glassOf(strip);
  for (int k = 0; k < kColumns; ++k) {
    float f = fraction(x + k);
    columns[k] = Column(between(low_left, low_right, f), between(high_left, high_right, f));
    Corner there = between(beyond_low, beyond_high, f);
    Column back = Column(chosen(up > 0, there, columns[k].high), chosen(up > 0, columns[k].low, there));
    if (!at_edge) back = columns[k];
    FilmCell behind = cellOf(back, y - up, last.at[k + 2], aroundOf(last, k, farthest_back.at[k + 2], here.at[k + 2]), levelAt(glass_last, k), step);
    me[k] = cellOf(columns[k], y, here.at[k + 2], aroundOf(here, k, last.at[k + 2], ahead.at[k + 2]), levelAt(glass_here, k), step);
    from_back[k] = flowBetween_pl(behind, behind.y_pl * up, behind.y_both_pl, me[k], me[k].y_pl * up, me[k].y_both_pl, step);
    back_off[k] = behind.volume_pl < 0;
  }

  // Over the pane's edges: to the left, to the right, behind and ahead.
  int over_left = 0, over_right = 0, over_back = 0, over_ahead = 0;
  Walk seen = Walk(FilmTile(-1, 0, 0u, 0u, 0, 0, 0, 0u), 0);
  for (int row = 0; row < kWalkRows; ++row) {
    Row beyond = rowOf(strip + 2 * up * across);
    Glass glass_ahead = glassOf(strip + up * across);
    const int l = 1, r = kColumns + 2;
    FilmAround by_left = filmAround(here.at[l], here.at[l - 1], here.at[l + 1], last.at[l], ahead.at[l]);
    FilmAround by_right = filmAround(here.at[r], here.at[r - 1], here.at[r + 1], last.at[r], ahead.at[r]);
    FilmCell left = cellOf(left_column, y, here.at[l], by_left, levelAt(glass_here, -1), step);
    FilmCell right = cellOf(right_column, y, here.at[r], by_right, levelAt(glass_here, kColumns), step);
    bool left_off = left.volume_pl < 0;
    int from_left = flowBetween_pl(left, left.x_pl, left.x_both_pl, me[0], me[0].x_pl, me[0].x_both_pl, step);
    Strips lay = beadsIn(strip), lie = lay;
    int after_pl[kColumns];
    for (int k = 0; k < kColumns; ++k) {
      FilmCell beside = k + 1 < kColumns ? me[(k + 1) % kColumns] : right;
      int to_right = flowBetween_pl(me[k], me[k].x_pl, me[k].x_both_pl, beside, beside.x_pl, beside.x_both_pl, step);
      FilmCell next = cellOf(columns[k], y + up, ahead.at[k + 2], aroundOf(ahead, k, here.at[k + 2], beyond.at[k + 2]),
                             levelAt(glass_ahead, k), step);
      int to_next = flowBetween_pl(me[k], me[k].y_pl * up, me[k].y_both_pl, next, next.y_pl * up, next.y_both_pl, step);

      bool on = me[k].volume_pl >= 0;
      over_left += on && left_off ? -from_left : 0;
      over_right += on && beside.volume_pl < 0 ? to_right : 0;
      over_back += on && back_off[k] ? -from_back[k] : 0;
      over_ahead += on && next.volume_pl < 0 ? to_next : 0;

      vec4 m = between(columns[k].low.metric, columns[k].high.metric, fraction(y));
      int volume = me[k].volume_pl + passed(kFlow, from_left) - to_right + passed(kFlow, from_back[k]) - to_next;
      FilmTexel now = settled(on ? volume : -1, beadsOf(lay.of[k]), m, step);
      now.beads.volume_pl = passed(kBead, now.beads.volume_pl);
      int offered = now.gone_pl;
      // The greatest, and of those the first.
      bool better = offered > seen.sums.event_pl || (offered > 0 && offered == seen.sums.event_pl && texel + k < seen.sums.event_texel);
      seen.sums.event_texel = better ? texel + k : seen.sums.event_texel;
      seen.sums.event_pl = better ? offered : seen.sums.event_pl;
      // Asleep next time only if neighbours, too, have seen it lie still.
      seen.stirs |= now.stirs | int(me[k].h_m >= step.pin_m);
      uint whole = uint(max(now.film_pl, 0));
      seen.sums.film_low_pl += whole & 0xffffu;
      seen.sums.film_high += whole >> 16u;
      seen.sums.beads_pl += uint(now.beads.volume_pl);
      after_pl[k] = now.film_pl;
      lie.of[k] = packedBeads(now.beads);

      left_off = !on;
      back_off[k] = !on;
      from_left = to_right;
      from_back[k] = to_next;
      me[k] = next;
    }
    for (int s = 0; s < kWalkStrips; ++s) {
      int k = s * kStripSize;
      after[strip + s] = ivec4(after_pl[k], after_pl[k + 1], after_pl[k + 2], after_pl[k + 3]);
      uvec4 had = uvec4(lay.of[k], lay.of[k + 1], lay.of[k + 2], lay.of[k + 3]), has = uvec4(lie.of[k], lie.of[k + 1], lie.of[k + 2], lie.of[k + 3]);
      if (has != had) beads[strip + s] = has;
    }
    last = here;
    here = ahead;
    ahead = beyond;
    glass_here = glass_ahead;
    y += up;
    strip += up * across;
    texel += up * step.columns;
  }
  leavePane(over_left, vec2(-1.0, 0.0), seen.sums);
  leavePane(over_right, vec2(1.0, 0.0), seen.sums);
  leavePane(over_back, vec2(0.0, -up), seen.sums);
  leavePane(over_ahead, vec2(0.0, up), seen.sums);
  return seen;
}

// -1: the last group has more walks than there are.
int listedTile() {
  uint place = groupInRows() * uint(kTilesInGroup) + gl_LocalInvocationIndex / uint(kWalks);
  return place < awake[turn].number ? listed[place] : -1;
}

int toldBy(int walk, int what) { return told[what * kGroup + walk]; }

void tell(Walk seen, int film_pl, uint beads_code) {
  int what[kTold] = int[kTold](seen.sums.event_texel, seen.sums.event_pl, int(seen.sums.film_low_pl), int(seen.sums.film_high), seen.sums.drained_pl,
                               seen.sums.blown_pl, 0, int(seen.sums.beads_pl), seen.stirs, film_pl, int(beads_code));
  for (int k = 0; k < kTold; ++k) told[k * kGroup + int(gl_LocalInvocationIndex)] = what[k];
}

// One texel of a tile gives to the drops: the one with most, the first of those. -1: none.
int giverAmong(int first) {
  int giver = -1, most_pl = 0, texel = 0;
  for (int k = first; k < first + kWalks; ++k) {
    int offered = toldBy(k, 1), by = toldBy(k, 0);
    bool better = offered > most_pl || (offered > 0 && offered == most_pl && by < texel);
    giver = better ? k : giver;
    most_pl = better ? offered : most_pl;
    texel = better ? by : texel;
  }
  return giver;
}

// Each invocation sums its share of the fields of FilmTile.
void report(int t, int lane) {
  int self = int(gl_LocalInvocationIndex), first = self - lane, giver = giverAmong(first), from = max(giver, first);
  int given_pl = giver < 0 ? 0 : toldBy(from, 1);
  FilmTexel had = FilmTexel(toldBy(from, kFilm), beadsOf(uint(toldBy(from, kBeads))), given_pl, 0), left = had;
  if (giver >= 0) left = without(had, given_pl);
  if (giver == self) {
    int place = placeOf(toldBy(from, 0));
    after[place / kStripSize][place % kStripSize] = left.film_pl;
    beads[place / kStripSize][place % kStripSize] = packedBeads(left.beads);
  }
  for (int field = lane; field < kFields; field += kWalks) {
    int sum = 0;
    for (int k = first; k < first + kWalks; ++k) sum += toldBy(k, field);
    if (field == 0) sum = giver < 0 ? -1 : toldBy(from, 0);
    if (field == 1) sum = given_pl;
    if (field == 2) states[t].film_low_pl = sum += (left.film_pl & 0xffff) - (had.film_pl & 0xffff);
    if (field == 3) states[t].film_high = sum += (left.film_pl >> 16) - (had.film_pl >> 16);
    if (field == 6) sum = driesNow(uint(t), info) ? states[t].dried_pl : 0;
    if (field == 7) states[t].beads_pl = uint(sum += left.beads.volume_pl - had.beads.volume_pl);
    tiles[t * kFields + field] = sum;
  }
  if (lane == 0) {
    int stirs = 0;
    for (int k = first; k < first + kWalks; ++k) stirs |= toldBy(k, kStirs);
    states[t].stirs = stirs;
  }
}

void main() {
  int lane = int(gl_LocalInvocationIndex) % kWalks, t = listedTile();
  bool here = t >= 0;
  if (here) {
    Walk seen = walk(ivec2(t % tilesAcross(), t / tilesAcross()), lane);
    int place = placeOf(max(seen.sums.event_texel, 0));
    tell(seen, after[place / kStripSize][place % kStripSize], beads[place / kStripSize][place % kStripSize]);
  }
  barrier();
  if (here) report(t, lane);
}
