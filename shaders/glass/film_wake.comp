// Which tiles a step looks at, and which are to dry, as lists; the others report what they did. An invocation for each tile.
#include "glass/film_lists.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 2) writeonly buffer Report { FilmTile tiles[]; };
layout(std430, binding = 4) buffer Awake {
  AwakeTiles awake[2], drying[2]; // this step's, and the next's made ready
  int listed[];                   // those awake, and from `count` on those that dry: -1 - tile where it sleeps from now on
};

AwakeTiles groupsUpTo(uint group) { return AwakeTiles(min(group + 1u, kGroupsInRow), group / kGroupsInRow + 1u, 1u, 0u); }

bool stirs(ivec2 tile) { return states[tile.y * tilesAcross() + tile.x].stirs[turn] != 0; }

bool wakes(int t) {
  ivec2 tile = ivec2(t % tilesAcross(), t / tilesAcross()), last = ivec2(tilesAcross(), count / tilesAcross()) - 1;
  return stirs(tile) || stirs(ivec2(max(tile.x - 1, 0), tile.y)) || stirs(ivec2(min(tile.x + 1, last.x), tile.y)) ||
         stirs(ivec2(tile.x, max(tile.y - 1, 0))) || stirs(ivec2(tile.x, min(tile.y + 1, last.y)));
}

void main() {
  int t = int(gl_GlobalInvocationID.x);
  if (t == 0) awake[1 - turn] = drying[1 - turn] = AwakeTiles(0u, 1u, 1u, 0u);
  if (t >= count) return;
  bool now = wakes(t), looked_at = now || states[t].awake != 0;
  states[t].awake = int(now);
  // Of what came to it in this step its state does not know yet.
  if (driesNow(uint(t), info) && (looked_at || (states[t].lies[0] | states[t].lies[1] | states[t].lies[2]) != 0)) {
    uint place = atomicAdd(drying[turn].number, 1u);
    listed[uint(count) + place] = now ? t : -1 - t;
    AwakeTiles groups = groupsUpTo(place / uint(kTilesInDryGroup));
    atomicMax(drying[turn].groups_x, groups.groups_x);
    atomicMax(drying[turn].groups_y, groups.groups_y);
  }
  if (looked_at) {
    uint place = atomicAdd(awake[turn].number, 1u);
    listed[place] = t;
    AwakeTiles groups = groupsUpTo(place / uint(kTilesInGroup));
    atomicMax(awake[turn].groups_x, groups.groups_x);
    atomicMax(awake[turn].groups_y, groups.groups_y);
  } else {
    states[t].stirs[1 - turn] = 0;
    tiles[t] = FilmTile(-1, 0, uint(states[t].lies[0]), uint(states[t].lies[1]), 0, 0, 0, uint(states[t].lies[2]));
  }
}
