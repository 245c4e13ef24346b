// A film step: every texel gathers what its neighbours give and gives what they gather, takes in beads that it flows over, and may offer water to
// the drops. It reads the film in one buffer and writes it to another, so that all see it as it was; beads it changes where they are. The
// law is in shared/glass_film.glsl.
// A tile that is awake is a group: two invocations for four columns, from the tile's lower and upper edge to its middle. Software GL, too, reads
// buffers as images fast, but as storage slowly, and runs through branches that nobody takes.
#include "glass/film_buffers.glsl"
layout(local_size_x = 8) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // strips of texels side by side
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles
layout(rgba32f, binding = 2) readonly uniform imageBuffer drive;
layout(rgba32ui, binding = 3) readonly uniform uimageBuffer lying; // beads: the buffer below
layout(r32ui, binding = 4) readonly uniform uimageBuffer glass;    // a code for each strip
layout(std430, binding = 3) writeonly buffer After { ivec4 after[]; };
layout(std430, binding = 6) writeonly buffer Lying { uvec4 beads[]; };
layout(std430, binding = 2) writeonly buffer Report { int tiles[]; }; // FilmTile
layout(std430, binding = 4) readonly buffer Awake {
  AwakeTiles awake[2], drying[2];
  int listed[];
};

const int kStrips = kTileSize / kStripSize, kRows = kTileSize / 2, kWalks = 2 * kStrips;
const int kNone = 0x7fffffff;

// What an invocation saw on its way.
struct Walk {
  FilmTile sums;   // its part of the tile's report; the event is its greatest offer
  FilmTexel offering; // the texel that makes it
  int stirs;
};
// The greatest offer of all and the first texel that makes it; each walk's part of the fields of FilmTile.
shared int greatest_pl, first_texel, stirring, parts[kWalks * kWalks];

// Fields along a column of a tile: at its lower and its upper edge.
struct Column { vec4 metric_low, metric_high, drive_low, drive_high; };
struct Corners { vec4 metric[4], drive[4]; };

Corners cornersOf(ivec2 tile) {
  int low = tile.y * (tilesAcross() + 1) + tile.x, high = low + tilesAcross() + 1;
  return Corners(vec4[4](imageLoad(metric, low), imageLoad(metric, low + 1), imageLoad(metric, high), imageLoad(metric, high + 1)),
                 vec4[4](imageLoad(drive, low), imageLoad(drive, low + 1), imageLoad(drive, high), imageLoad(drive, high + 1)));
}

// A texel's place between the edges of its tile.
float fraction(int at) { return (float(at & (kTileSize - 1)) + 0.5) / float(kTileSize); }

Column columnOf(Corners c, int x) {
  float f = fraction(x);
  return Column(between(c.metric[0], c.metric[1], f), between(c.metric[2], c.metric[3], f),
                between(c.drive[0], c.drive[1], f), between(c.drive[2], c.drive[3], f));
}
Column columnBeside(int x, int tile_row) { return columnOf(cornersOf(ivec2(x >> 4, tile_row)), x); }

FilmCell cellOf(Column column, int y, int volume_pl, FilmAround around, int level, FilmStepInfo step) {
  float f = fraction(y);
  return filmCell(volume_pl, around, level, between(column.drive_low, column.drive_high, f), between(column.metric_low, column.metric_high, f), step);
}

// A row of strips: an invocation's own, with the two texels on either side of it that its law asks for.
struct Row { ivec4 own, left, right; };
Row rowOf(int strip) { return Row(imageLoad(before, strip), imageLoad(before, strip - 1), imageLoad(before, strip + 1)); }
int leftOf(Row row, int k) { return k > 0 ? row.own[(k + 3) % kStripSize] : row.left.w; }
int rightOf(Row row, int k) { return k + 1 < kStripSize ? row.own[(k + 1) % kStripSize] : row.right.x; }
FilmAround aroundOf(Row row, int k, int behind_pl, int ahead_pl) {
  return filmAround(row.own[k], leftOf(row, k), rightOf(row, k), behind_pl, ahead_pl);
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward, inout FilmTile sums) {
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) sums.blown_pl += volume_pl;
  else sums.drained_pl += volume_pl;
}

Walk walk(ivec2 tile) {
  FilmStepInfo step = info;
  int lane = int(gl_LocalInvocationIndex), up = lane < kStrips ? 1 : -1, across = tilesAcross() * kStrips;
  int x = (tile.x * kStrips + lane % kStrips) * kStripSize, y = tile.y * kTileSize + (up > 0 ? 0 : kTileSize - 1);
  int strip = y * across + x / kStripSize, texel = y * step.columns + x;

  Corners own = cornersOf(tile), back = cornersOf(tile - ivec2(0, up));
  Column left_column = columnBeside(x - 1, tile.y), right_column = columnBeside(x + kStripSize, tile.y);
  Column columns[kStripSize];
  FilmCell me[kStripSize];
  int from_back[kStripSize];
  bool back_off[kStripSize];
  // The rows behind, here and ahead; of the two beyond only what lies in the own columns.
  Row last = rowOf(strip - up * across), here = rowOf(strip), ahead = rowOf(strip + up * across);
  ivec4 farthest_back = imageLoad(before, strip - 2 * up * across);
  uint glass_last = imageLoad(glass, strip - up * across).x, glass_here = imageLoad(glass, strip).x;
  for (int k = 0; k < kStripSize; ++k) {
    columns[k] = columnOf(own, x + k);
    FilmCell behind = cellOf(columnOf(back, x + k), y - up, last.own[k], aroundOf(last, k, farthest_back[k], here.own[k]), glassLevel(glass_last, k), step);
    me[k] = cellOf(columns[k], y, here.own[k], aroundOf(here, k, last.own[k], ahead.own[k]), glassLevel(glass_here, k), step);
    from_back[k] = flowBetween_pl(behind, behind.y_pl * up, behind.y_both_pl, me[k], me[k].y_pl * up, me[k].y_both_pl, step);
    back_off[k] = behind.volume_pl < 0;
  }

  // Over the pane's edges: to the left, to the right, behind and ahead.
  int over_left = 0, over_right = 0, over_back = 0, over_ahead = 0;
  Walk seen = Walk(FilmTile(-1, 0, 0u, 0u, 0, 0, 0, 0u), FilmTexel(0, noBeads(), 0, 0), 0);
  for (int row = 0; row < kRows; ++row) {
    Row beyond = rowOf(strip + 2 * up * across);
    ivec4 after_pl;
    uvec4 beads_of = imageLoad(lying, strip);
    uint glass_ahead = imageLoad(glass, strip + up * across).x;
    FilmAround by_left = filmAround(here.left.w, here.left.z, here.own.x, last.left.w, ahead.left.w);
    FilmAround by_right = filmAround(here.right.x, here.own.w, here.right.y, last.right.x, ahead.right.x);
    FilmCell left = cellOf(left_column, y, here.left.w, by_left, glassLevel(glass_here, -1), step);
    FilmCell right = cellOf(right_column, y, here.right.x, by_right, glassLevel(glass_here, kStripSize), step);
    bool left_off = left.volume_pl < 0;
    int from_left = flowBetween_pl(left, left.x_pl, left.x_both_pl, me[0], me[0].x_pl, me[0].x_both_pl, step);
    for (int k = 0; k < kStripSize; ++k) {
      FilmCell beside = k + 1 < kStripSize ? me[(k + 1) % kStripSize] : right;
      int to_right = flowBetween_pl(me[k], me[k].x_pl, me[k].x_both_pl, beside, beside.x_pl, beside.x_both_pl, step);
      FilmCell next = cellOf(columns[k], y + up, ahead.own[k], aroundOf(ahead, k, here.own[k], beyond.own[k]),
                             glassLevel(glass_ahead, k), step);
      int to_next = flowBetween_pl(me[k], me[k].y_pl * up, me[k].y_both_pl, next, next.y_pl * up, next.y_both_pl, step);

      bool on = me[k].volume_pl >= 0;
      over_left += on && left_off ? -from_left : 0;
      over_right += on && beside.volume_pl < 0 ? to_right : 0;
      over_back += on && back_off[k] ? -from_back[k] : 0;
      over_ahead += on && next.volume_pl < 0 ? to_next : 0;

      vec4 m = between(columns[k].metric_low, columns[k].metric_high, fraction(y));
      int volume = me[k].volume_pl + passed(kFlow, from_left) - to_right + passed(kFlow, from_back[k]) - to_next;
      FilmTexel now = settled(on ? volume : -1, beadsOf(beads_of[k]), m, step);
      now.beads.volume_pl = passed(kBead, now.beads.volume_pl);
      int offered = now.gone_pl;
      // The greatest, and of those the first.
      bool better = offered > seen.sums.event_pl || (offered > 0 && offered == seen.sums.event_pl && texel + k < seen.sums.event_texel);
      seen.sums.event_texel = better ? texel + k : seen.sums.event_texel;
      seen.sums.event_pl = better ? offered : seen.sums.event_pl;
      if (better) seen.offering = now;
      // Asleep next time only if neighbours, too, have seen it lie still.
      seen.stirs |= now.stirs | int(me[k].h_m >= step.pin_m);
      uint whole = uint(max(now.film_pl, 0));
      seen.sums.film_low_pl += whole & 0xffffu;
      seen.sums.film_high += whole >> 16u;
      seen.sums.beads_pl += uint(now.beads.volume_pl);
      after_pl[k] = now.film_pl;
      beads_of[k] = packedBeads(now.beads);

      left_off = !on;
      back_off[k] = !on;
      from_left = to_right;
      from_back[k] = to_next;
      me[k] = next;
    }
    after[strip] = after_pl;
    beads[strip] = beads_of;
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

// Each invocation sums one field of FilmTile. One texel of a tile gives to the drops: the one with most, the first of those.
void report(int t, Walk seen) {
  int lane = int(gl_LocalInvocationIndex);
  atomicMax(greatest_pl, seen.sums.event_pl);
  barrier();
  if (seen.sums.event_pl > 0 && seen.sums.event_pl == greatest_pl) atomicMin(first_texel, seen.sums.event_texel);
  barrier();
  bool gives = seen.sums.event_texel == first_texel;
  FilmTexel had = seen.offering, left = gives ? without(had, seen.sums.event_pl) : had;
  if (gives) {
    int place = placeOf(first_texel);
    after[place / kStripSize][place % kStripSize] = left.film_pl;
    beads[place / kStripSize][place % kStripSize] = packedBeads(left.beads);
  }
  int film_low_pl = int(seen.sums.film_low_pl) + (left.film_pl & 0xffff) - (had.film_pl & 0xffff);
  int film_high = int(seen.sums.film_high) + (left.film_pl >> 16) - (had.film_pl >> 16);
  int beads_pl = int(seen.sums.beads_pl) + left.beads.volume_pl - had.beads.volume_pl;
  int part[kWalks] = int[kWalks](gives ? first_texel + 1 : 0, gives ? seen.sums.event_pl : 0, film_low_pl, film_high,
                                 seen.sums.drained_pl, seen.sums.blown_pl, lane == 0 && driesNow(uint(t), info) ? states[t].dried_pl : 0, beads_pl);
  for (int field = 0; field < kWalks; ++field) parts[lane * kWalks + field] = part[field];
  atomicOr(stirring, seen.stirs);
  barrier();
  int sum = 0;
  for (int k = 0; k < kWalks; ++k) sum += parts[k * kWalks + lane];
  tiles[t * kWalks + lane] = lane == 0 ? sum - 1 : sum;
  if (lane == 0) states[t].stirs = stirring;
  if (lane == 2) states[t].film_low_pl = sum;
  if (lane == 3) states[t].film_high = sum;
  if (lane == 7) states[t].beads_pl = uint(sum);
}

void main() {
  uint place = gl_WorkGroupID.y * kTilesInRow + gl_WorkGroupID.x;
  if (place >= awake[turn].number) return;
  int t = listed[place];
  if (gl_LocalInvocationIndex == 0u) {
    greatest_pl = 0;
    first_texel = kNone;
    stirring = 0;
  }
  barrier();
  report(t, walk(ivec2(t % tilesAcross(), t / tilesAcross())));
}
