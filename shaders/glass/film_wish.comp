// A film step's first half: what every texel would give along x and y. Each invocation walks up one column of a tile.
#include "glass/film_buffers.glsl"
layout(local_size_x = kTileSize) in;
layout(r32i, binding = 0) readonly uniform iimage2D film;
layout(rgba32i, binding = 1) writeonly uniform iimage2D wishes; // FilmCell: volume, x, y, thickness's bits
layout(std430, binding = 3) readonly buffer Drive { vec4 drive[]; };
layout(std430, binding = 4) readonly buffer Metric { vec4 metric[]; };

bool wakes(ivec2 tile, ivec2 tiles) {
  int t = tile.y * tiles.x + tile.x;
  if (states[t].stirs != 0 || (driesNow(uint(t), info) && (states[t].film_low_pl | states[t].film_high) != 0u)) return true;
  return (tile.x > 0 && states[t - 1].stirs != 0) || (tile.x + 1 < tiles.x && states[t + 1].stirs != 0) ||
         (tile.y > 0 && states[t - tiles.x].stirs != 0) || (tile.y + 1 < tiles.y && states[t + tiles.x].stirs != 0);
}

void main() {
  ivec2 tile = ivec2(gl_WorkGroupID.xy), tiles = ivec2(gl_NumWorkGroups.xy);
  bool awake = wakes(tile, tiles);
  if (gl_LocalInvocationIndex == 0u) states[tile.y * tiles.x + tile.x].awake = int(awake);
  if (!awake) return;

  // Fields between the corners of the texel's own tile.
  int node = tile.y * (tiles.x + 1) + tile.x, above = node + tiles.x + 1;
  float fx = (float(gl_LocalInvocationID.x) + 0.5) / float(kTileSize);
  vec4 metric_low = between(metric[node], metric[node + 1], fx), metric_high = between(metric[above], metric[above + 1], fx);
  vec4 drive_low = between(drive[node], drive[node + 1], fx), drive_high = between(drive[above], drive[above + 1], fx);
  ivec2 cell = tile * kTileSize + ivec2(gl_LocalInvocationID.x, 0);
  if (cell.x >= info.columns) return;
  for (int y = 0; y < kTileSize && cell.y < info.rows; ++y, ++cell.y) {
    float fy = (float(y) + 0.5) / float(kTileSize);
    FilmCell c = filmCell(imageLoad(film, cell).x, between(drive_low, drive_high, fy), between(metric_low, metric_high, fy), info);
    imageStore(wishes, cell, ivec4(c.volume_pl, c.x_pl, c.y_pl, floatBitsToInt(c.h_m)));
  }
}
