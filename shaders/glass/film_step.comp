// One step of the film: every texel gathers what its neighbours give and gives what they gather. The law is in shared/glass_film.glsl.
#include "glass/film_buffers.glsl"
layout(local_size_x = kTileSize, local_size_y = kTileSize) in;
layout(r32i, binding = 0) readonly uniform iimage2D film;
layout(r32i, binding = 1) writeonly uniform iimage2D film_next;
layout(std430, binding = 3) readonly buffer Drive { vec4 drive[]; };
layout(std430, binding = 4) readonly buffer Metric { vec4 metric[]; };
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };

const int kHalo = kTileSize + 2;
shared FilmCell cells[kHalo * kHalo];
shared int kept_pl[kTileSize * kTileSize];
shared int lost_pl[kTileSize * kTileSize];
shared uint low_pl[kTileSize];
shared uint high[kTileSize];
shared int dried_pl[kTileSize];
shared int drained_pl;
shared int blown_pl;
shared int offer_pl;
shared int offer_texel;

// Fields between the corners of the texel's own tile, so that they are the same for whoever asks.
vec4 metricAt(ivec2 cell) {
  int node = (cell.y / kTileSize) * ((info.columns + kTileSize - 1) / kTileSize + 1) + cell.x / kTileSize;
  int next = node + (info.columns + kTileSize - 1) / kTileSize + 1;
  vec2 f = (vec2(cell % kTileSize) + 0.5) / float(kTileSize);
  return betweenNodes(metric[node], metric[node + 1], metric[next], metric[next + 1], f);
}
vec4 driveAt(ivec2 cell) {
  int node = (cell.y / kTileSize) * ((info.columns + kTileSize - 1) / kTileSize + 1) + cell.x / kTileSize;
  int next = node + (info.columns + kTileSize - 1) / kTileSize + 1;
  vec2 f = (vec2(cell % kTileSize) + 0.5) / float(kTileSize);
  return betweenNodes(drive[node], drive[node + 1], drive[next], drive[next + 1], f);
}

FilmCell load(ivec2 cell) {
  int volume = -1;
  if (all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, ivec2(info.columns, info.rows)))) volume = imageLoad(film, cell).x;
  if (volume <= 0) {
    FilmCell dry;
    dry.volume_pl = volume;
    dry.h_m = 0.0;
    dry.x_pl = 0;
    dry.y_pl = 0;
    return dry;
  }
  return filmCell(volume, driveAt(cell), metricAt(cell), info);
}

// Over an edge that looks up it is blown off, over others it drains.
void leavePane(int volume_pl, vec2 outward) {
  if (volume_pl == 0) return;
  if (dot(outward, vec2(info.up_x, info.up_y)) > 0.5) atomicAdd(blown_pl, volume_pl);
  else atomicAdd(drained_pl, volume_pl);
}

int flowed(int s, uint texel) {
  FilmCell me = cells[s];
  FilmCell left = cells[s - 1], right = cells[s + 1], below = cells[s - kHalo], above = cells[s + kHalo];
  uint row = uint(info.columns);
  int from_left = faceFlow_pl(left, left.x_pl, texel - 1u, me, me.x_pl, texel, info);
  int to_right = faceFlow_pl(me, me.x_pl, texel, right, right.x_pl, texel + 1u, info);
  int from_below = faceFlow_pl(below, below.y_pl, texel - row, me, me.y_pl, texel, info);
  int to_above = faceFlow_pl(me, me.y_pl, texel, above, above.y_pl, texel + row, info);
  if (left.volume_pl < 0) leavePane(-from_left, vec2(-1.0, 0.0));
  if (right.volume_pl < 0) leavePane(to_right, vec2(1.0, 0.0));
  if (below.volume_pl < 0) leavePane(-from_below, vec2(0.0, -1.0));
  if (above.volume_pl < 0) leavePane(to_above, vec2(0.0, 1.0));
  return me.volume_pl + passed(from_left) - to_right + passed(from_below) - to_above;
}

// Rows, then all: the tile's part of the report.
void report(int i) {
  if (i < kTileSize) {
    uint low = 0u, top = 0u;
    int dried = 0;
    for (int k = 0; k < kTileSize; ++k) {
      uint volume = uint(max(kept_pl[i * kTileSize + k], 0));
      low += volume & 0xffffu;
      top += volume >> 16u;
      dried += lost_pl[i * kTileSize + k];
    }
    low_pl[i] = low;
    high[i] = top;
    dried_pl[i] = dried;
  }
  barrier();
  if (i != 0) return;
  FilmTile tile = FilmTile(offer_pl > 0 ? offer_texel : -1, offer_pl, 0u, 0u, drained_pl, blown_pl, 0, 0);
  for (int k = 0; k < kTileSize; ++k) {
    tile.film_low_pl += low_pl[k];
    tile.film_high += high[k];
    tile.evaporated_pl += dried_pl[k];
  }
  tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = tile;
}

void main() {
  ivec2 origin = ivec2(gl_WorkGroupID.xy) * kTileSize - 1;
  int i = int(gl_LocalInvocationIndex);
  if (i == 0) {
    drained_pl = 0;
    blown_pl = 0;
    offer_pl = 0;
    offer_texel = 0x7fffffff;
  }
  for (int k = i; k < kHalo * kHalo; k += kTileSize * kTileSize) cells[k] = load(origin + ivec2(k % kHalo, k / kHalo));
  barrier();

  ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  bool inside = all(lessThan(cell, ivec2(info.columns, info.rows)));
  int s = int(gl_LocalInvocationID.y + 1u) * kHalo + int(gl_LocalInvocationID.x) + 1;
  int texel = cell.y * info.columns + cell.x;
  int volume = inside ? cells[s].volume_pl : -1;
  int offered = 0, dried = 0;
  if (volume >= 0) {
    vec4 m = metricAt(cell);
    volume = flowed(s, uint(texel));
    dried = evaporated_pl(volume, uint(texel), m, info);
    volume -= dried;
    offered = offered_pl(volume, uint(texel), m, info);
    if (offered > 0) atomicMax(offer_pl, offered);
  }
  barrier();
  // One texel of a tile gives to the drops: the one with most, the first of those.
  if (offered > 0 && offered == offer_pl) atomicMin(offer_texel, texel);
  barrier();
  if (offered > 0 && texel == offer_texel) volume -= offered;
  kept_pl[i] = volume;
  lost_pl[i] = dried;
  if (inside) imageStore(film_next, cell, ivec4(volume));
  barrier();
  report(i);
}
