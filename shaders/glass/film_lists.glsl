// What the kernels share that work by lists of tiles: those for software GL, which is slow where nobody has anything to do. A GPU is not, but waits long
// between a kernel and the next: glass/film_tile.comp is for it.
#include "glass/film_buffers.glsl"

// Groups in rows, as GL promises no more than 65535 along an axis.
const uint kGroupsInRow = 32768u;
uint groupInRows() { return gl_WorkGroupID.y * kGroupsInRow + gl_WorkGroupID.x; }

// How many tiles a step looks at, and the command for as many groups as they need.
struct AwakeTiles { uint groups_x, groups_y, groups_z, number; };

// An invocation walks over a whole tile, which shares most; and software GL runs eight at once: these are a group.
const int kTilesInGroup = 8;
// Tiles dry by single columns of strips, as many in a group.
const int kTilesInDryGroup = kTilesInGroup / kStrips;
