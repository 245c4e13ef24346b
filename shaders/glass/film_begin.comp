// For GPUs, what comes before the flow at once where no blade comes between: what drives the film is brought from the orders, which lie in the CPU's
// memory; changes as glass/film_change.comp has them; and tiles whose turn it is dry, as in glass/film_dry.comp. First groups that bring, as that takes
// longest; then groups that dry, a tile each, with the changes to it; then groups that work through the changes to others.
#include "glass/film_tile.glsl"
layout(rgba32f, binding = 1) readonly uniform imageBuffer metric; // of the corners of tiles
layout(rgba32f, binding = 2) readonly uniform imageBuffer ordered_drive;
layout(rgba32f, binding = 3) writeonly uniform imageBuffer drive;
layout(std430, binding = 0) readonly buffer Changes { FilmChange changes[]; };
layout(std430, binding = 2) writeonly buffer Report { int taken_pl[]; };
layout(std430, binding = 3) buffer Film { int film[]; };
layout(std430, binding = 4) readonly buffer Firsts { int firsts[]; }; // where a drying tile's changes begin, and where the last one's end
layout(std430, binding = 6) buffer Lying { uint beads[]; };
layout(std430, binding = 7) writeonly buffer Other { int other[]; };
layout(location = 2) uniform int drying;  // tiles
layout(location = 3) uniform int changed; // 0: the changes to those that dry have been made
layout(location = 4) uniform int nodes;   // of the drive

shared int film_here[kTileTexels];
shared uint beads_here[kTileTexels];

void take(FilmChange change, Changed now) {
  if (change.take >= 0) taken_pl[change.take] = now.taken_pl;
  wake(change.texel);
}

void changeElsewhere(int i) {
  if (i >= count) return;
  FilmChange change = changes[i];
  if (change.texel < 0) {
    atomicAdd(ridge_pl[-1 - change.texel], passed(kRidge, change.added_pl));
    return;
  }
  int place = placeOf(change.texel);
  Changed now = changedBy(change, film[place], beadsOf(beads[place]));
  film[place] = now.film_pl;
  beads[place] = packedBeads(now.beads);
  take(change, now);
}

// Of a tile that dries; no texel twice.
void changeHere(int i) {
  FilmChange change = changes[i];
  ivec2 at = ivec2(change.texel % info.columns, change.texel / info.columns) % kTileSize;
  int k = at.y * kTileSize + at.x;
  Changed now = changedBy(change, film_here[k], beadsOf(beads_here[k]));
  film_here[k] = now.film_pl;
  beads_here[k] = packedBeads(now.beads);
  take(change, now);
}

vec4 metricAt(ivec2 tile, ivec2 at) {
  int low = tile.y * (tilesAcross() + 1) + tile.x, high = low + tilesAcross() + 1;
  return betweenNodes(imageLoad(metric, low), imageLoad(metric, low + 1), imageLoad(metric, high), imageLoad(metric, high + 1),
                      vec2(fraction(at.x), fraction(at.y)));
}

// One that sleeps stays asleep, which is why the film's other copy is written too.
void dry(int k) {
  int t = int((kDryingSteps - info.step / 2u % kDryingSteps) % kDryingSteps) + k * int(kDryingSteps);
  ivec2 tile = tileAt(t), at = laneAt();
  int place = placeIn(tile, at), film_was = film[place];
  uint beads_was = beads[place];
  film_here[lane()] = film_was;
  beads_here[lane()] = beads_was;
  barrier();
  for (int i = firsts[k] + lane(); changed != 0 && i < firsts[k + 1]; i += kTileTexels) changeHere(i);
  barrier();
  FilmTexel left = dried(film_here[lane()], beadsOf(beads_here[lane()]), uint(texelOf(tile, at)), metricAt(tile, at), info);
  if (left.film_pl != film_was) {
    film[place] = left.film_pl;
    other[place] = left.film_pl;
  }
  uint lie = packedBeads(left.beads);
  if (lie != beads_was) beads[place] = lie;
  ivec4 sum = summed(ivec4(toldOf(left.film_pl, left.beads.volume_pl), left.gone_pl));
  if (lane() != 0) return;
  states[t].last[kFilmLow] = sum.x;
  states[t].last[kFilmHigh] = sum.y;
  states[t].last[kBeadsPl] = sum.z;
  states[t].dried_pl = sum.w;
}

void bring(int node) {
  if (node < nodes) imageStore(drive, node, imageLoad(ordered_drive, node));
}

void main() {
  int bringing = (nodes + kTileTexels - 1) / kTileTexels, group = int(groupInRows()) - bringing;
  if (group < 0) bring((group + bringing) * kTileTexels + lane());
  else if (group < drying) dry(group);
  else changeElsewhere((group - drying) * kTileTexels + lane());
}
