// Which tiles a step looks at, and which are to dry, as lists; the others report what they did. An invocation for each tile.
#include "glass/film_lists.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };
layout(std430, binding = 4) buffer Awake {
  AwakeTiles awake[2], drying[2]; // this step's, and the next's made ready
  int listed[];                   // those awake, and from `count` on those that dry: -1 - tile where it sleeps from now on
};

// Of the group's tiles: how many go into each list, and where its part of that begins. Threads that all count in one place wait for each other.
const int kAwake = 0, kDries = 1;
shared uint number[2], first[2];

bool stirs(ivec2 tile) { return states[tile.y * tilesAcross() + tile.x].stirs[turn] != 0; }

bool wakes(int t) {
  ivec2 tile = ivec2(t % tilesAcross(), t / tilesAcross()), last = ivec2(tilesAcross(), count / tilesAcross()) - 1;
  return stirs(tile) || stirs(ivec2(max(tile.x - 1, 0), tile.y)) || stirs(ivec2(min(tile.x + 1, last.x), tile.y)) ||
         stirs(ivec2(tile.x, max(tile.y - 1, 0))) || stirs(ivec2(tile.x, min(tile.y + 1, last.y)));
}

uint groupsOf(uint items, uint each) { return (items + each - 1u) / each; }

void claim() {
  first[kAwake] = atomicAdd(awake[turn].number, number[kAwake]);
  first[kDries] = atomicAdd(drying[turn].number, number[kDries]);
  uint awake_groups = groupsOf(first[kAwake] + number[kAwake], uint(kTilesInGroup)), drying_groups = groupsOf(first[kDries] + number[kDries], uint(kTilesInDryGroup));
  atomicMax(awake[turn].groups_x, min(awake_groups, kGroupsInRow));
  atomicMax(awake[turn].groups_y, groupsOf(awake_groups, kGroupsInRow));
  atomicMax(drying[turn].groups_x, min(drying_groups, kGroupsInRow));
  atomicMax(drying[turn].groups_y, groupsOf(drying_groups, kGroupsInRow));
}

void main() {
  int t = int(gl_GlobalInvocationID.x);
  bool leads = gl_LocalInvocationIndex == 0u;
  if (t == 0) awake[1 - turn] = drying[1 - turn] = AwakeTiles(0u, 1u, 1u, 0u);
  if (leads) number = uint[2](0u, 0u);
  barrier();
  bool here = t < count, now = here && wakes(t), looked_at = now || (here && states[t].awake != 0);
  // Of what came to it in this step its state does not know yet.
  bool dries = here && driesNow(uint(t), info) && (looked_at || (states[t].lies[0] | states[t].lies[1] | states[t].lies[2]) != 0);
  uint place = 0u, place_dries = 0u;
  if (looked_at) place = atomicAdd(number[kAwake], 1u);
  if (dries) place_dries = atomicAdd(number[kDries], 1u);
  barrier();
  if (leads) claim();
  barrier();
  if (!here) return;
  states[t].awake = int(now);
  if (dries) listed[uint(count) + first[kDries] + place_dries] = now ? t : -1 - t;
  if (looked_at) {
    listed[first[kAwake] + place] = t;
  } else {
    states[t].stirs[1 - turn] = 0;
    tiles[t] = FilmTile(-1, 0, uint(states[t].lies[0]), uint(states[t].lies[1]), 0, 0, 0, uint(states[t].lies[2]));
  }
}
