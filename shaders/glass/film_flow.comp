// A film step's second half: every texel gathers what its neighbours give and gives what they gather, dries, and may offer water to the drops.
// Each invocation walks up one column of a tile. The law is in shared/glass_film.glsl.
#include "glass/film_buffers.glsl"
layout(local_size_x = kTileSize) in;
layout(r32i, binding = 0) coherent writeonly uniform iimage2D film;
layout(rgba32i, binding = 1) readonly uniform iimage2D wishes;
layout(std430, binding = 4) readonly buffer Metric { vec4 metric[]; };
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };

// What an invocation saw on its way.
struct Column {
  FilmTile sums;   // its part of the tile's report; the event is its greatest offer
  int offering_pl; // what is on the texel that makes it
  int stirs;
};
shared Column columns[kTileSize];

FilmCell load(ivec2 cell) {
  ivec4 wish = imageLoad(wishes, cell);
  return FilmCell(wish.x, intBitsToFloat(wish.w), wish.y, wish.z);
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward, inout FilmTile sums) {
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) sums.blown_pl += volume_pl;
  else sums.drained_pl += volume_pl;
}

int flowed(ivec2 cell, FilmCell me, FilmCell below, FilmCell above, inout FilmTile sums) {
  FilmCell left = load(cell - ivec2(1, 0)), right = load(cell + ivec2(1, 0));
  uint row = uint(info.columns), texel = uint(cell.y) * row + uint(cell.x);
  int from_left = faceFlow_pl(left, left.x_pl, texel - 1u, me, me.x_pl, texel, info);
  int to_right = faceFlow_pl(me, me.x_pl, texel, right, right.x_pl, texel + 1u, info);
  int from_below = faceFlow_pl(below, below.y_pl, texel - row, me, me.y_pl, texel, info);
  int to_above = faceFlow_pl(me, me.y_pl, texel, above, above.y_pl, texel + row, info);
  if (left.volume_pl < 0) leavePane(-from_left, vec2(-1.0, 0.0), sums);
  if (right.volume_pl < 0) leavePane(to_right, vec2(1.0, 0.0), sums);
  if (below.volume_pl < 0) leavePane(-from_below, vec2(0.0, -1.0), sums);
  if (above.volume_pl < 0) leavePane(to_above, vec2(0.0, 1.0), sums);
  return me.volume_pl + passed(from_left) - to_right + passed(from_below) - to_above;
}

Column walk(ivec2 tile, int t) {
  Column column = Column(FilmTile(-1, 0, 0u, 0u, 0, 0, 0, 0), 0, 0);
  int node = tile.y * (int(gl_NumWorkGroups.x) + 1) + tile.x, next = node + int(gl_NumWorkGroups.x) + 1;
  float fx = (float(gl_LocalInvocationID.x) + 0.5) / float(kTileSize);
  vec4 metric_low = between(metric[node], metric[node + 1], fx), metric_high = between(metric[next], metric[next + 1], fx);
  ivec2 cell = tile * kTileSize + ivec2(gl_LocalInvocationID.x, 0);
  if (cell.x >= info.columns) return column;
  bool dries = driesNow(uint(t), info);
  FilmCell below = load(cell - ivec2(0, 1)), me = load(cell);
  for (int y = 0; y < kTileSize && cell.y < info.rows; ++y, ++cell.y) {
    FilmCell above = load(cell + ivec2(0, 1));
    if (me.volume_pl >= 0) {
      vec4 m = between(metric_low, metric_high, (float(y) + 0.5) / float(kTileSize));
      int texel = cell.y * info.columns + cell.x;
      int volume = flowed(cell, me, below, above, column.sums);
      if (dries) {
        int dried = evaporated_pl(volume, uint(texel), m, info);
        volume -= dried;
        column.sums.evaporated_pl += dried;
      }
      int offered = offered_pl(volume, uint(texel), m, info);
      if (offered > column.sums.event_pl) {
        column.sums.event_texel = texel;
        column.sums.event_pl = offered;
        column.offering_pl = volume;
      }
      // Asleep next time only if neighbours, too, have seen it lie still.
      if (me.h_m >= info.pin_m || thickness_m(volume, m) >= info.pin_m) column.stirs = 1;
      uint whole = uint(max(volume, 0));
      column.sums.film_low_pl += whole & 0xffffu;
      column.sums.film_high += whole >> 16u;
      imageStore(film, cell, ivec4(volume));
    }
    below = me;
    me = above;
  }
  return column;
}

// The first of the invocations puts all columns together. One texel of a tile gives to the drops: the one with most, the first of those.
void report(int t) {
  FilmTile sum = columns[0].sums;
  int offering_pl = columns[0].offering_pl, stirs = columns[0].stirs;
  for (int k = 1; k < kTileSize; ++k) {
    FilmTile part = columns[k].sums;
    if (part.event_pl > sum.event_pl || (part.event_pl > 0 && part.event_pl == sum.event_pl && part.event_texel < sum.event_texel)) {
      sum.event_pl = part.event_pl;
      sum.event_texel = part.event_texel;
      offering_pl = columns[k].offering_pl;
    }
    sum.film_low_pl += part.film_low_pl;
    sum.film_high += part.film_high;
    sum.drained_pl += part.drained_pl;
    sum.blown_pl += part.blown_pl;
    sum.evaporated_pl += part.evaporated_pl;
    stirs |= columns[k].stirs;
  }
  if (sum.event_pl > 0) {
    int left = offering_pl - sum.event_pl;
    sum.film_low_pl += (uint(left) & 0xffffu) - (uint(offering_pl) & 0xffffu);
    sum.film_high += (uint(left) >> 16u) - (uint(offering_pl) >> 16u);
    imageStore(film, cellOf(sum.event_texel), ivec4(left));
  }
  tiles[t] = sum;
  states[t].stirs = stirs;
  states[t].film_low_pl = sum.film_low_pl;
  states[t].film_high = sum.film_high;
}

void main() {
  ivec2 tile = ivec2(gl_WorkGroupID.xy);
  int t = tile.y * int(gl_NumWorkGroups.x) + tile.x;
  bool first = gl_LocalInvocationIndex == 0u;
  if (states[t].awake == 0) {
    if (first) tiles[t] = FilmTile(-1, 0, states[t].film_low_pl, states[t].film_high, 0, 0, 0, 0);
    return;
  }
  columns[gl_LocalInvocationIndex] = walk(tile, t);
  memoryBarrierImage(); // the offering texel is stored twice
  barrier();
  if (first) report(t);
}
