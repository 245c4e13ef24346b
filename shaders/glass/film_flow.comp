// A film step: every texel gathers what its neighbours give and gives what they gather, dries, and may offer water to the drops. It reads the
// film in one buffer and writes it to another, so that all see it as it was. The law is in shared/glass_film.glsl.
// A tile is a group: two invocations for four columns, from the tile's lower and upper edge to its middle. Software GL, too, reads buffers as
// images fast, but as storage slowly; and it runs through branches that nobody takes, but not through loops that nobody enters.
#include "glass/film_buffers.glsl"
layout(local_size_x = 8) in;
layout(rgba32i, binding = 0) readonly uniform iimageBuffer before; // strips of texels side by side
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric;  // of the corners of tiles
layout(rgba32f, binding = 2) readonly uniform imageBuffer drive;
layout(std430, binding = 3) writeonly buffer After { ivec4 after[]; };
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };

const int kStrips = kTileSize / kStripSize, kRows = kTileSize / 2;

// What an invocation saw on its way.
struct Walk {
  FilmTile sums;   // its part of the tile's report; the event is its greatest offer
  int offering_pl; // what is on the texel that makes it
  int stirs;
};
shared Walk walks[2 * kStrips];

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

FilmCell cellOf(Column column, int y, int volume_pl) {
  float f = fraction(y);
  return filmCell(volume_pl, between(column.drive_low, column.drive_high, f), between(column.metric_low, column.metric_high, f), info);
}

bool wakes(ivec2 tile, ivec2 tiles_across, int t) {
  if (states[t].stirs[turn] != 0 || (driesNow(uint(t), info) && (states[t].film_low_pl | states[t].film_high) != 0u)) return true;
  return (tile.x > 0 && states[t - 1].stirs[turn] != 0) || (tile.x + 1 < tiles_across.x && states[t + 1].stirs[turn] != 0) ||
         (tile.y > 0 && states[t - tiles_across.x].stirs[turn] != 0) ||
         (tile.y + 1 < tiles_across.y && states[t + tiles_across.x].stirs[turn] != 0);
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward, inout FilmTile sums) {
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) sums.blown_pl += volume_pl;
  else sums.drained_pl += volume_pl;
}

Walk walk(ivec2 tile, int t, int rows) {
  Walk seen = Walk(FilmTile(-1, 0, 0u, 0u, 0, 0, 0, 0), 0, 0);
  int lane = int(gl_LocalInvocationIndex), up = lane < kStrips ? 1 : -1, across = tilesAcross() * kStrips;
  int x = (tile.x * kStrips + lane % kStrips) * kStripSize, y = tile.y * kTileSize + (up > 0 ? 0 : kTileSize - 1);
  bool dries = driesNow(uint(t), info);

  Corners own = cornersOf(tile), back = cornersOf(tile - ivec2(0, up));
  Column left_column = columnBeside(x - 1, tile.y), right_column = columnBeside(x + kStripSize, tile.y);
  Column columns[kStripSize];
  FilmCell me[kStripSize], next[kStripSize];
  float entry_m[kStripSize];
  int from_back[kStripSize];
  bool back_off[kStripSize];
  int strip = y * across + x / kStripSize, texel = y * info.columns + x;
  ivec4 back_pl = imageLoad(before, strip - up * across), my_pl = imageLoad(before, strip);
  for (int k = 0; k < kStripSize; ++k) {
    columns[k] = columnOf(own, x + k);
    FilmCell behind = cellOf(columnOf(back, x + k), y - up, back_pl[k]);
    me[k] = cellOf(columns[k], y, my_pl[k]);
    entry_m[k] = entryThickness_m(me[k], uint(texel + k), info);
    float entry_behind_m = entryThickness_m(behind, uint(texel - up * info.columns + k), info);
    from_back[k] = flowBetween_pl(behind, behind.y_pl * up, entry_behind_m, me[k], me[k].y_pl * up, entry_m[k], info);
    back_off[k] = behind.volume_pl < 0;
  }
  for (int row = 0; row < rows; ++row) {
    ivec4 next_pl = imageLoad(before, strip + up * across);
    FilmCell left = cellOf(left_column, y, imageLoad(before, strip - 1).w), right = cellOf(right_column, y, imageLoad(before, strip + 1).x);
    int to_right = flowBetween_pl(left, left.x_pl, entryThickness_m(left, uint(texel - 1), info), me[0], me[0].x_pl, entry_m[0], info);
    bool left_off = left.volume_pl < 0;
    ivec4 out_pl = my_pl;
    for (int k = 0; k < kStripSize; ++k) {
      int from_left = to_right;
      FilmCell beside = right;
      float entry_beside_m = 0.0;
      if (k + 1 < kStripSize) {
        beside = me[k + 1];
        entry_beside_m = entry_m[k + 1];
      } else {
        entry_beside_m = entryThickness_m(right, uint(texel + kStripSize), info);
      }
      to_right = flowBetween_pl(me[k], me[k].x_pl, entry_m[k], beside, beside.x_pl, entry_beside_m, info);
      next[k] = cellOf(columns[k], y + up, next_pl[k]);
      float entry_next_m = entryThickness_m(next[k], uint(texel + up * info.columns + k), info);
      int to_next = flowBetween_pl(me[k], me[k].y_pl * up, entry_m[k], next[k], next[k].y_pl * up, entry_next_m, info);
      if (me[k].volume_pl >= 0) {
        if (left_off) leavePane(-from_left, vec2(-1.0, 0.0), seen.sums);
        if (beside.volume_pl < 0) leavePane(to_right, vec2(1.0, 0.0), seen.sums);
        if (back_off[k]) leavePane(-from_back[k], vec2(0.0, -up), seen.sums);
        if (next[k].volume_pl < 0) leavePane(to_next, vec2(0.0, up), seen.sums);
        vec4 m = between(columns[k].metric_low, columns[k].metric_high, fraction(y));
        int volume = me[k].volume_pl + passed(kFlow, from_left) - to_right + passed(kFlow, from_back[k]) - to_next;
        if (dries) {
          int dried = evaporated_pl(volume, uint(texel + k), m, info);
          volume -= dried;
          seen.sums.evaporated_pl += dried;
        }
        int offered = offered_pl(volume, uint(texel + k), m, info);
        // The greatest, and of those the first.
        if (offered > seen.sums.event_pl || (offered > 0 && offered == seen.sums.event_pl && texel + k < seen.sums.event_texel)) {
          seen.sums.event_texel = texel + k;
          seen.sums.event_pl = offered;
          seen.offering_pl = volume;
        }
        // Asleep next time only if neighbours, too, have seen it lie still.
        if (me[k].h_m >= info.pin_m || thickness_m(volume, m) >= info.pin_m) seen.stirs = 1;
        uint whole = uint(max(volume, 0));
        seen.sums.film_low_pl += whole & 0xffffu;
        seen.sums.film_high += whole >> 16u;
        out_pl[k] = volume;
      }
      left_off = me[k].volume_pl < 0;
      back_off[k] = left_off;
      from_back[k] = to_next;
      entry_m[k] = entry_next_m;
    }
    after[strip] = out_pl;
    for (int k = 0; k < kStripSize; ++k) me[k] = next[k];
    my_pl = next_pl;
    y += up;
    strip += up * across;
    texel += up * info.columns;
  }
  return seen;
}

// The first of the invocations puts all walks together. One texel of a tile gives to the drops: the one with most, the first of those.
void report(int t) {
  FilmTile sum = walks[0].sums;
  int offering_pl = walks[0].offering_pl, stirs = walks[0].stirs;
  for (int k = 1; k < 2 * kStrips; ++k) {
    FilmTile part = walks[k].sums;
    if (part.event_pl > sum.event_pl || (part.event_pl > 0 && part.event_pl == sum.event_pl && part.event_texel < sum.event_texel)) {
      sum.event_pl = part.event_pl;
      sum.event_texel = part.event_texel;
      offering_pl = walks[k].offering_pl;
    }
    sum.film_low_pl += part.film_low_pl;
    sum.film_high += part.film_high;
    sum.drained_pl += part.drained_pl;
    sum.blown_pl += part.blown_pl;
    sum.evaporated_pl += part.evaporated_pl;
    stirs |= walks[k].stirs;
  }
  if (sum.event_pl > 0) {
    int left = offering_pl - sum.event_pl;
    sum.film_low_pl += (uint(left) & 0xffffu) - (uint(offering_pl) & 0xffffu);
    sum.film_high += (uint(left) >> 16u) - (uint(offering_pl) >> 16u);
    int place = placeOf(sum.event_texel);
    after[place / kStripSize][place % kStripSize] = left;
  }
  tiles[t] = sum;
  states[t].stirs[1 - turn] = stirs;
  states[t].film_low_pl = sum.film_low_pl;
  states[t].film_high = sum.film_high;
}

void main() {
  ivec2 tile = ivec2(gl_WorkGroupID.xy);
  int t = tile.y * int(gl_NumWorkGroups.x) + tile.x;
  bool first = gl_LocalInvocationIndex == 0u, awake = wakes(tile, ivec2(gl_NumWorkGroups.xy), t), was_awake = states[t].awake != 0;
  barrier();
  if (first) states[t].awake = int(awake);
  if (!awake && !was_awake) {
    if (first) {
      tiles[t] = FilmTile(-1, 0, states[t].film_low_pl, states[t].film_high, 0, 0, 0, 0);
      states[t].stirs[1 - turn] = 0;
    }
    return;
  }
  walks[gl_LocalInvocationIndex] = walk(tile, t, kRows);
  memoryBarrierBuffer(); // the offering texel is stored twice
  barrier();
  if (first) report(t);
}
