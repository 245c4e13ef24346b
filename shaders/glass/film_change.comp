// What comes to the film and to the beads and what is taken from both: rain, trails and dissolved drops; what drops ran over; drops a blade met,
// which join its ridge. No texel twice in a step.
#include "glass/film_buffers.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Changes { FilmChange changes[]; };
layout(std430, binding = 2) writeonly buffer Report { int taken_pl[]; };
layout(std430, binding = 3) buffer Film { int film[]; };
layout(std430, binding = 6) buffer Lying { uint beads[]; };

void main() {
  int i = int(gl_GlobalInvocationID.x);
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
