// A film step: every texel gathers what its neighbours give and gives what they gather, takes in beads that it flows over, and may offer water to
// the drops. It reads the film in one buffer and writes it to another, so that all see it as it was; beads it changes where they are. The
// law is in shared/glass_film.glsl. This one is for software GL; glass/film_tile.comp is the same for GPUs.
// Invocations walk up kColumns columns of a tile that is awake, kWalkRows rows, and keep what they know of a texel for the next. Software GL, too, reads
// buffers as images fast, but as storage slowly; it runs through branches that nobody takes, and once more through a loop whose way out is at its head.
#include "glass/film_lists.glsl"
layout(local_size_x = kGroup) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // strips of texels side by side
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles
layout(rgba32f, binding = 2) readonly uniform imageBuffer drive;
layout(rgba32ui, binding = 3) readonly uniform uimageBuffer lying; // beads: the buffer below
layout(rgba32ui, binding = 4) readonly uniform uimageBuffer glass; // a code for each strip of a tile's row
layout(std430, binding = 3) buffer After { ivec4 after[]; };
layout(std430, binding = 6) buffer Lying { uvec4 beads[]; };
layout(std430, binding = 2) writeonly buffer Report { int tiles[]; }; // FilmTile
layout(std430, binding = 4) readonly buffer Awake {
  AwakeTiles awake[2], drying[2];
  int listed[];
};

const int kColumns = kWalkStrips * kStripSize;

// What an invocation saw on its way: its part of the tile's report.
struct Walk {
  int offer_pl; // the most that one has which offers some to the drops
  int offer_at; // place in the tile, row by row, of the first texel that makes it
  int film_low_pl, film_high, drained_pl, blown_pl, beads_pl; // as in FilmTile
  int stirs;    // not to fall asleep
};
// What the walks of a group tell each other: their parts of the fields of FilmTile, then whether they stir, what the offering texel has and what it gives.
const int kStirs = 8, kFilm = 9, kBeads = 10, kGives = 11, kTold = 12;
shared int told[kTold * kGroup];

// Fields at a place, at a tile's corners, and along a column of strips: at its lower and its upper edge.
struct Field { vec4 metric, drive; };
struct Corners { Field low_left, low_right, high_left, high_right; };
struct Column { Field low, high; };

Field atCorner(int at) { return Field(imageLoad(metric, at), imageLoad(drive, at)); }
// Of the tile that a texel lies in: past the grid, too, where divisions would round the wrong way.
Corners cornersOf(int x, int y) {
  int low = (y >> 4) * (tilesAcross() + 1) + (x >> 4), high = low + tilesAcross() + 1;
  return Corners(atCorner(low), atCorner(low + 1), atCorner(high), atCorner(high + 1));
}

Field between(Field a, Field b, float f) { return Field(between(a.metric, b.metric, f), between(a.drive, b.drive, f)); }
Column columnOf(Corners c, int x) {
  float f = placeAcross(x);
  return Column(between(c.low_left, c.low_right, f), between(c.high_left, c.high_right, f));
}
Field fieldAt(Column column, int y) { return between(column.low, column.high, placeUp(y)); }

FilmCell cellOf(Field field, int volume_pl, FilmAround around, int level, FilmStepInfo step) {
  return filmCell(volume_pl, around, level, field.drive, field.metric, step);
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
  uvec4 row = imageLoad(glass, strip / kStrips);
  Glass under;
  for (int s = 0; s < kWalkStrips; ++s) under.codes[s] = row[strip % kStrips + s];
  return under;
}
int levelAt(Glass under, int k) {
  int s = min(max(k, 0) / kStripSize, kWalkStrips - 1);
  return glassLevel(under.codes[s], k - s * kStripSize);
}

// A row's beads.
struct Beaded { uint of[kColumns]; };
Beaded beadsIn(int strip) {
  Beaded row;
  for (int s = 0; s < kWalkStrips; ++s) {
    uvec4 own = imageLoad(lying, strip + s);
    for (int k = 0; k < kStripSize; ++k) row.of[s * kStripSize + k] = own[k];
  }
  return row;
}
uvec4 stripOf(Beaded row, int k) { return uvec4(row.of[k], row.of[k + 1], row.of[k + 2], row.of[k + 3]); }

// Beads that lie still are not stored again.
void put(int strip, int film_pl[kColumns], Beaded before_it, Beaded now) {
  for (int s = 0; s < kWalkStrips; ++s) {
    int k = s * kStripSize;
    after[strip + s] = ivec4(film_pl[k], film_pl[k + 1], film_pl[k + 2], film_pl[k + 3]);
    if (stripOf(now, k) != stripOf(before_it, k)) beads[strip + s] = stripOf(now, k);
  }
}

void see(FilmTexel now, int at, inout Walk seen) {
  bool better = now.gone_pl > seen.offer_pl;
  seen.offer_at = better ? at : seen.offer_at;
  seen.offer_pl = better ? now.gone_pl : seen.offer_pl;
  seen.stirs |= now.stirs;
  int whole = max(now.film_pl, 0);
  seen.film_low_pl += whole & 0xffff;
  seen.film_high += whole >> 16;
  seen.beads_pl += now.beads.volume_pl;
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward, inout Walk seen) {
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) seen.blown_pl += volume_pl;
  else seen.drained_pl += volume_pl;
}

Walk walk(ivec2 tile, int lane) {
  FilmStepInfo step = info;
  int column = lane % kWalksAcross * kColumns, first = lane / kWalksAcross * kWalkRows, across = tilesAcross() * kStrips;
  int x = tile.x * kTileSize + column, y = tile.y * kTileSize + first, strip = y * across + x / kStripSize, at = first * kTileSize + column;

  Corners own = cornersOf(x, y), below = cornersOf(x, y - 1), above = cornersOf(x, y + kWalkRows);
  Column left_column = columnOf(cornersOf(x - 1, y), x - 1), right_column = columnOf(cornersOf(x + kColumns, y), x + kColumns);
  Column columns[kWalkStrips];
  vec4 metric_here[kWalkStrips];
  FilmCell me[kColumns];
  int from_below[kColumns];
  // Over the pane's edges.
  int over_left = 0, over_right = 0, over_below = 0, over_above = 0;
  // The rows below, here and above; of the two beyond only what lies in the own columns.
  Row beneath = rowOf(strip - 2 * across), last = rowOf(strip - across), here = rowOf(strip), ahead = rowOf(strip + across);
  Glass glass_last = glassOf(strip - across), glass_here = glassOf(strip);
  for (int k = 0; k < kColumns; ++k) {
    FilmCell behind = cellOf(fieldAt(columnOf(below, x + k), y - 1), last.at[k + 2], aroundOf(last, k, beneath.at[k + 2], here.at[k + 2]),
                             levelAt(glass_last, k), step);
    int s = k / kStripSize;
    columns[s] = columnOf(own, x + k);
    Field field = fieldAt(columns[s], y);
    metric_here[s] = field.metric;
    me[k] = cellOf(field, here.at[k + 2], aroundOf(here, k, last.at[k + 2], ahead.at[k + 2]), levelAt(glass_here, k), step);
    from_below[k] = flowBetween_pl(behind, behind.y_pl, behind.y_both_pl, me[k], me[k].y_pl, me[k].y_both_pl, step);
    over_below -= last.at[k + 2] < 0 ? from_below[k] : 0;
  }

  Walk seen = Walk(0, 0, 0, 0, 0, 0, 0, 0);
  // Before the last row it changes to the columns of the row above.
  int part = 0;
  do {
    int rows = part == 0 ? kWalkRows - 1 : 1;
    do {
      Row beyond = rowOf(strip + 2 * across);
      Glass glass_ahead = glassOf(strip + across);
      const int l = 1, r = kColumns + 2;
      FilmAround by_left = filmAround(here.at[l], here.at[l - 1], here.at[l + 1], last.at[l], ahead.at[l]);
      FilmAround by_right = filmAround(here.at[r], here.at[r - 1], here.at[r + 1], last.at[r], ahead.at[r]);
      FilmCell left = cellOf(fieldAt(left_column, y), here.at[l], by_left, levelAt(glass_here, -1), step);
      FilmCell right = cellOf(fieldAt(right_column, y), here.at[r], by_right, levelAt(glass_here, kColumns), step);
      // Carried on once, in the row.
      for (int k = 0; k < kColumns; ++k) me[k].volume_pl = here.at[k + 2];
      int from_left = flowBetween_pl(left, left.x_pl, left.x_both_pl, me[0], me[0].x_pl, me[0].x_both_pl, step);
      Beaded lay = beadsIn(strip), lie = lay;
      int after_pl[kColumns];
      for (int k = 0; k < kColumns; ++k) {
        FilmCell beside = k + 1 < kColumns ? me[(k + 1) % kColumns] : right;
        int to_right = flowBetween_pl(me[k], me[k].x_pl, me[k].x_both_pl, beside, beside.x_pl, beside.x_both_pl, step);
        int s = k / kStripSize;
        Field field = fieldAt(columns[s], y + 1);
        FilmCell next = cellOf(field, ahead.at[k + 2], aroundOf(ahead, k, here.at[k + 2], beyond.at[k + 2]), levelAt(glass_ahead, k), step);
        int to_next = flowBetween_pl(me[k], me[k].y_pl, me[k].y_both_pl, next, next.y_pl, next.y_both_pl, step);

        // Nothing passes between two that are off the pane.
        over_left -= here.at[k + 1] < 0 ? from_left : 0;
        over_right += here.at[k + 3] < 0 ? to_right : 0;
        over_above += ahead.at[k + 2] < 0 ? to_next : 0;
        over_below -= here.at[k + 2] < 0 && part == 0 ? to_next : 0; // into the row above, where it is the walk's

        int volume = me[k].volume_pl + passed(kFlow, from_left) - to_right + passed(kFlow, from_below[k]) - to_next;
        FilmTexel now = settled(here.at[k + 2] < 0 ? -1 : volume, beadsOf(lay.of[k]), metric_here[s], step);
        now.beads.volume_pl = passed(kBead, now.beads.volume_pl);
        see(now, at + k, seen);
        // Asleep next time only if neighbours, too, have seen it lie still.
        seen.stirs |= int(me[k].h_m >= step.pin_m);
        after_pl[k] = now.film_pl;
        lie.of[k] = packedBeads(now.beads);

        from_left = to_right;
        from_below[k] = to_next;
        me[k] = next;
        if (k % kStripSize == kStripSize - 1) metric_here[s] = field.metric;
      }
      put(strip, after_pl, lay, lie);
      last = here;
      here = ahead;
      ahead = beyond;
      glass_here = glass_ahead;
      ++y;
      strip += across;
      at += kTileSize;
    } while (--rows > 0);
    for (int s = 0; s < kWalkStrips; ++s) columns[s] = columnOf(above, x + s * kStripSize);
  } while (++part < 2);
  leavePane(over_left, vec2(-1.0, 0.0), seen);
  leavePane(over_right, vec2(1.0, 0.0), seen);
  leavePane(over_below, vec2(0.0, -1.0), seen);
  leavePane(over_above, vec2(0.0, 1.0), seen);
  return seen;
}

// -1: the last group has more walks than there are.
int listedTile() {
  uint place = groupInRows() * uint(kTilesInGroup) + gl_LocalInvocationIndex / uint(kWalks);
  return place < awake[turn].number ? listed[place] : -1;
}

int toldBy(int walk, int what) { return told[what * kGroup + walk]; }

// A strip of the film and of the beads, a texel of it, and what it gives.
struct Offering { int strip, k; ivec4 film_pl; uvec4 beads; int gives_pl; };
Offering offeringOf(ivec2 tile, int at, bool offers) {
  Offering o = Offering(0, 0, ivec4(0), uvec4(0u), 0);
  if (!offers) return o;
  o.strip = (tile.y * kTileSize + at / kTileSize) * tilesAcross() * kStrips + tile.x * kStrips + at % kTileSize / kStripSize;
  o.k = at % kStripSize;
  o.film_pl = after[o.strip];
  o.beads = beads[o.strip];
  int x = tile.x * kTileSize + at % kTileSize, y = tile.y * kTileSize + at / kTileSize;
  float per_m2 = fieldAt(columnOf(cornersOf(x, y), x), y).metric.z;
  o.gives_pl = offered_pl(FilmTexel(o.film_pl[o.k], beadsOf(o.beads[o.k]), 0, 0), per_m2);
  return o;
}

void tell(Walk seen, Offering offering) {
  int what[kTold] = int[kTold](seen.offer_at, seen.offer_pl, seen.film_low_pl, seen.film_high, seen.drained_pl, seen.blown_pl, 0, seen.beads_pl,
                               seen.stirs, offering.film_pl[offering.k], int(offering.beads[offering.k]), offering.gives_pl);
  for (int k = 0; k < kTold; ++k) told[k * kGroup + int(gl_LocalInvocationIndex)] = what[k];
}

// One texel of a tile gives to the drops: the one with most, the first of those. Which walk's it is; -1: none.
int giverAmong(int first) {
  int giver = -1, most_pl = 0, earliest = 0;
  for (int k = first; k < first + kWalks; ++k) {
    int offer_pl = toldBy(k, 1), at = toldBy(k, 0);
    bool better = offer_pl > most_pl || (offer_pl > 0 && offer_pl == most_pl && at < earliest);
    giver = better ? k : giver;
    most_pl = better ? offer_pl : most_pl;
    earliest = better ? at : earliest;
  }
  return giver;
}

// Each invocation sums its share of the fields of FilmTile.
void report(int t, ivec2 tile, int lane, Offering own) {
  int self = int(gl_LocalInvocationIndex), first = self - lane, giver = giverAmong(first), from = max(giver, first);
  bool given = giver >= 0;
  int given_pl = given ? toldBy(from, kGives) : 0, at = toldBy(from, 0);
  FilmTexel had = FilmTexel(toldBy(from, kFilm), beadsOf(uint(toldBy(from, kBeads))), given_pl, 0), left = without(had, given_pl);
  if (giver == self) {
    own.film_pl[own.k] = left.film_pl;
    own.beads[own.k] = packedBeads(left.beads);
    after[own.strip] = own.film_pl;
    beads[own.strip] = own.beads;
  }
  int texel = given ? (tile.y * kTileSize + at / kTileSize) * info.columns + tile.x * kTileSize + at % kTileSize : -1;
  int known[kFields] = int[kFields](texel, given_pl, (left.film_pl & 0xffff) - (had.film_pl & 0xffff), (left.film_pl >> 16) - (had.film_pl >> 16), 0, 0,
                                    0, left.beads.volume_pl - had.beads.volume_pl);
  for (int field = lane; field < kFields; field += kWalks) {
    int sum = known[field];
    for (int k = first; field > 1 && k < first + kWalks; ++k) sum += toldBy(k, field);
    tiles[t * kFields + field] = sum;
    if (field == kFilmLow) states[t].lies[0] = sum;
    if (field == kFilmHigh) states[t].lies[1] = sum;
    if (field == kBeadsPl) states[t].lies[2] = sum;
  }
  if (lane == 0) {
    int stirs = 0;
    for (int k = first; k < first + kWalks; ++k) stirs |= toldBy(k, kStirs);
    states[t].stirs[1 - turn] = stirs;
  }
}

void main() {
  int lane = int(gl_LocalInvocationIndex) % kWalks, t = listedTile();
  ivec2 tile = ivec2(t % tilesAcross(), t / tilesAcross());
  bool here = t >= 0;
  Offering offering;
  if (here) {
    Walk seen = walk(tile, lane);
    offering = offeringOf(tile, seen.offer_at, seen.offer_pl > 0);
    tell(seen, offering);
  }
  barrier();
  if (here) report(t, tile, lane, offering);
}
