// What comes to the film and to the beads and what is taken from both: rain, trails and drops that sank into it; what drops ran over; drops a blade met,
// which join its ridge. No texel twice in a step. On a GPU first groups bring what drives the film from the orders, which lie in the CPU's memory.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(rgba32f, binding = 2) readonly uniform imageBuffer ordered_drive;
layout(rgba32f, binding = 3) writeonly uniform imageBuffer drive;
layout(std430, binding = 0) readonly buffer Changes { FilmChange changes[]; };
layout(std430, binding = 2) writeonly buffer Report { int taken_pl[]; };
layout(std430, binding = 3) buffer Film { int film[]; };
layout(std430, binding = 6) buffer Lying { uint beads[]; };
layout(location = 2) uniform int nodes; // of the drive, to be brought

void make(int i) {
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
  if (change.take >= 0) taken_pl[change.take] = now.taken_pl;
  wake(change.texel);
}

void main() {
  int group = int(gl_WorkGroupSize.x), bringing = (nodes + group - 1) / group * group, i = int(gl_GlobalInvocationID.x);
  if (i >= bringing) make(i - bringing);
  else if (i < nodes) imageStore(drive, i, imageLoad(ordered_drive, i));
}
