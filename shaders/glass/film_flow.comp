// A film step: every texel gathers what its neighbours give and gives what they gather, takes in beads that it flows over, and may offer water to
// the drops. It reads the film in one buffer and writes it to another, so that all see it as it was; beads it changes where they are. The
// law is in shared/glass_film.glsl. This one is for software GL; glass/film_tile.comp is the same for GPUs.
// An invocation walks up a tile that is awake, all of its columns side by side, and keeps what it knows of a texel for the next. Software GL, too, reads
// buffers as images fast, but as storage slowly; it runs through branches that nobody takes, and once more through a loop whose way out is at its head.
#include "glass/film_lists.glsl"
layout(local_size_x = kGroup) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // strips of texels side by side
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles (PaneMap::nodeMetric)
layout(rgba32f, binding = 2) readonly uniform imageBuffer drive;
layout(rgba32ui, binding = 3) readonly uniform uimageBuffer lying; // beads: the buffer below
layout(rgba32ui, binding = 4) readonly uniform uimageBuffer glass; // a code for each strip of a tile's row
layout(std430, binding = 3) buffer After { ivec4 after[]; };
layout(std430, binding = 6) buffer Lying { uvec4 beads[]; };
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };
layout(std430, binding = 4) readonly buffer Awake {
  AwakeTiles awake[2], drying[2];
  int listed[];
};

// What an invocation saw on its way: its tile's report.
struct Walk {
  int offer_pl; // the most that may go from a texel to the drops
  int offer_at; // place in the tile, row by row, of the first that has so much
  int film_low_pl, film_high, drained_pl, blown_pl, beads_pl; // as in FilmTile
  int stirs;    // not to fall asleep
};

// Fields at a place, at a tile's corners, and along a column of strips: at its lower and its upper edge.
struct Field { vec4 metric, drive; };
struct Corners { Field low_left, low_right, high_left, high_right; };
struct Column { Field low, high; };

// From 0, 0 to 1, 1 the tile's own corners, about them those of the tiles beside it.
Field atCorner(ivec2 tile, int x, int y) {
  int at = (tile.y + y) * (tilesAcross() + 1) + tile.x + x;
  return Field(imageLoad(metric, at), imageLoad(drive, at));
}
Corners cornersOf(ivec2 tile) { return Corners(atCorner(tile, 0, 0), atCorner(tile, 1, 0), atCorner(tile, 0, 1), atCorner(tile, 1, 1)); }

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
struct Row { int at[kTileSize + 4]; };
Row rowOf(int strip) {
  Row row;
  ivec4 left = imageLoad(before, strip - 1), right = imageLoad(before, strip + kStrips);
  row.at[0] = left.z;
  row.at[1] = left.w;
  for (int s = 0; s < kStrips; ++s) {
    ivec4 own = imageLoad(before, strip + s);
    for (int k = 0; k < kStripSize; ++k) row.at[s * kStripSize + k + 2] = own[k];
  }
  row.at[kTileSize + 2] = right.x;
  row.at[kTileSize + 3] = right.y;
  return row;
}
FilmAround aroundOf(Row row, int k, int behind_pl, int ahead_pl) {
  return filmAround(row.at[k + 2], row.at[k + 1], row.at[k + 3], behind_pl, ahead_pl);
}

// The glass below a row of texels, of -1 .. kTileSize: a code for each strip, which knows its neighbours, too.
uvec4 glassOf(int strip) { return imageLoad(glass, strip / kStrips); }
int levelAt(uvec4 codes, int k) {
  int s = clamp(k, 0, kTileSize - 1) / kStripSize;
  return glassLevel(codes[s], k - s * kStripSize);
}

// A row's beads.
struct Beaded { uint of[kTileSize]; };
Beaded beadsIn(int strip) {
  Beaded row;
  for (int s = 0; s < kStrips; ++s) {
    uvec4 own = imageLoad(lying, strip + s);
    for (int k = 0; k < kStripSize; ++k) row.of[s * kStripSize + k] = own[k];
  }
  return row;
}
uvec4 stripOf(Beaded row, int k) { return uvec4(row.of[k], row.of[k + 1], row.of[k + 2], row.of[k + 3]); }

// Beads that lie still are not stored again.
void put(int strip, int film_pl[kTileSize], Beaded before_it, Beaded now) {
  for (int s = 0; s < kStrips; ++s) {
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

Walk walk(ivec2 tile) {
  FilmStepInfo step = info;
  int across = tilesAcross() * kStrips, strip = stripAt(tile.x * kTileSize, tile.y * kTileSize), y = 0; // in the tile

  Corners own = cornersOf(tile);
  Corners below = Corners(atCorner(tile, 0, -1), atCorner(tile, 1, -1), own.low_left, own.low_right);
  Corners above = Corners(own.high_left, own.high_right, atCorner(tile, 0, 2), atCorner(tile, 1, 2));
  Column left_column = columnOf(Corners(atCorner(tile, -1, 0), own.low_left, atCorner(tile, -1, 1), own.high_left), -1);
  Column right_column = columnOf(Corners(own.low_right, atCorner(tile, 2, 0), own.high_right, atCorner(tile, 2, 1)), 0);
  Column columns[kStrips];
  vec4 metric_here[kStrips];
  FilmCell me[kTileSize];
  int from_below[kTileSize];
  // Over the pane's edges.
  int over_left = 0, over_right = 0, over_below = 0, over_above = 0;
  // The rows below, here and above; of the two beyond only what lies in the own columns.
  Row beneath = rowOf(strip - 2 * across), last = rowOf(strip - across), here = rowOf(strip), ahead = rowOf(strip + across);
  uvec4 glass_last = glassOf(strip - across), glass_here = glassOf(strip);
  // Texel by texel, though fields are a strip's: Mesa unrolls loops over these arrays that are as long as they, but no nest of them.
  for (int k = 0; k < kTileSize; ++k) {
    int s = k / kStripSize;
    columns[s] = columnOf(own, k);
    Field field = fieldAt(columns[s], y), field_last = fieldAt(columnOf(below, k), -1);
    metric_here[s] = field.metric;
    FilmCell behind = cellOf(field_last, last.at[k + 2], aroundOf(last, k, beneath.at[k + 2], here.at[k + 2]), levelAt(glass_last, k), step);
    me[k] = cellOf(field, here.at[k + 2], aroundOf(here, k, last.at[k + 2], ahead.at[k + 2]), levelAt(glass_here, k), step);
    from_below[k] = flowBetween_pl(behind, behind.y_pl, behind.y_both_pl, me[k], me[k].y_pl, me[k].y_both_pl, step);
    over_below -= last.at[k + 2] < 0 ? from_below[k] : 0;
  }

  Walk seen = Walk(0, 0, 0, 0, 0, 0, 0, 0);
  // Before the last row it changes to the columns of the row above.
  int part = 0;
  do {
    int rows = part == 0 ? kTileSize - 1 : 1;
    do {
      Row beyond = rowOf(strip + 2 * across);
      uvec4 glass_ahead = glassOf(strip + across);
      const int l = 1, r = kTileSize + 2;
      FilmAround by_left = filmAround(here.at[l], here.at[l - 1], here.at[l + 1], last.at[l], ahead.at[l]);
      FilmAround by_right = filmAround(here.at[r], here.at[r - 1], here.at[r + 1], last.at[r], ahead.at[r]);
      FilmCell left = cellOf(fieldAt(left_column, y), here.at[l], by_left, levelAt(glass_here, -1), step);
      FilmCell right = cellOf(fieldAt(right_column, y), here.at[r], by_right, levelAt(glass_here, kTileSize), step);
      // Carried on once, in the row.
      for (int k = 0; k < kTileSize; ++k) me[k].volume_pl = here.at[k + 2];
      int from_left = flowBetween_pl(left, left.x_pl, left.x_both_pl, me[0], me[0].x_pl, me[0].x_both_pl, step);
      Beaded lay = beadsIn(strip), lie = lay;
      int after_pl[kTileSize];
      for (int k = 0; k < kTileSize; ++k) {
        int s = k / kStripSize;
        FilmCell beside = k + 1 < kTileSize ? me[(k + 1) % kTileSize] : right;
        int to_right = flowBetween_pl(me[k], me[k].x_pl, me[k].x_both_pl, beside, beside.x_pl, beside.x_both_pl, step);
        Field field = fieldAt(columns[s], y + 1);
        FilmCell next = cellOf(field, ahead.at[k + 2], aroundOf(ahead, k, here.at[k + 2], beyond.at[k + 2]), levelAt(glass_ahead, k), step);
        int to_next = flowBetween_pl(me[k], me[k].y_pl, me[k].y_both_pl, next, next.y_pl, next.y_both_pl, step);

        // Nothing passes between two that are off the pane.
        over_left -= here.at[k + 1] < 0 ? from_left : 0;
        over_right += here.at[k + 3] < 0 ? to_right : 0;
        over_above += ahead.at[k + 2] < 0 ? to_next : 0;
        over_below -= here.at[k + 2] < 0 && part == 0 ? to_next : 0; // into the row above, where it is the tile's

        int volume = me[k].volume_pl + passed(kFlow, from_left) - to_right + passed(kFlow, from_below[k]) - to_next;
        FilmTexel now = settled(here.at[k + 2] < 0 ? -1 : volume, beadsOf(lay.of[k]), metric_here[s], step);
        now.beads.volume_pl = passed(kBead, now.beads.volume_pl);
        see(now, y * kTileSize + k, seen);
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
    } while (--rows > 0);
    for (int s = 0; s < kStrips; ++s) columns[s] = columnOf(above, s * kStripSize);
  } while (++part < 2);
  leavePane(over_left, vec2(-1.0, 0.0), seen);
  leavePane(over_right, vec2(1.0, 0.0), seen);
  leavePane(over_below, vec2(0.0, -1.0), seen);
  leavePane(over_above, vec2(0.0, 1.0), seen);
  return seen;
}

// After a texel has given to the drops: the one with most, the first of those.
void report(int t, ivec2 tile, Walk seen) {
  bool gives = seen.offer_pl > 0;
  int x = tile.x * kTileSize + seen.offer_at % kTileSize, y = tile.y * kTileSize + seen.offer_at / kTileSize, strip = stripAt(x, y), k = x % kStripSize;
  ivec4 film_pl = after[strip];
  uvec4 lying_there = beads[strip];
  FilmTexel had = asItIs(film_pl[k], beadsOf(lying_there[k]));
  int given_pl = gives ? offered_pl(seen.offer_pl, had.beads) : 0;
  FilmTexel left = without(had, given_pl);
  if (gives) {
    film_pl[k] = left.film_pl;
    lying_there[k] = packedBeads(left.beads);
    after[strip] = film_pl;
    beads[strip] = lying_there;
  }
  int low = seen.film_low_pl + (left.film_pl & 0xffff) - (had.film_pl & 0xffff), high = seen.film_high + (left.film_pl >> 16) - (had.film_pl >> 16);
  int beads_pl = seen.beads_pl + left.beads.volume_pl - had.beads.volume_pl;
  tiles[t] = FilmTile(gives ? y * info.columns + x : -1, given_pl, uint(low), uint(high), seen.drained_pl, seen.blown_pl, 0, uint(beads_pl));
  states[t].lies = int[3](low, high, beads_pl);
  states[t].stirs[1 - turn] = seen.stirs;
}

void main() {
  uint place = groupInRows() * uint(kTilesInGroup) + gl_LocalInvocationIndex;
  if (place >= awake[turn].number) return; // the last group has more invocations than there are tiles
  int t = listed[place];
  ivec2 tile = ivec2(t % tilesAcross(), t / tilesAcross());
  report(t, tile, walk(tile));
}
