// What the kernels share that work by lists of tiles: those for software GL, which is slow where nobody has anything to do. A GPU is not, but waits long
// between a kernel and the next: glass/film_tile.comp is for it.
#include "glass/film_buffers.glsl"

// Groups in rows, as GL promises no more than 65535 along an axis.
const uint kGroupsInRow = 32768u;
uint groupInRows() { return gl_WorkGroupID.y * kGroupsInRow + gl_WorkGroupID.x; }

// How many tiles a step looks at, and the command for as many groups as they need.
struct AwakeTiles { uint groups_x, groups_y, groups_z, number; };

// A group takes eight tiles; its invocations walk over them, each over so many strips side by side and rows. A long way over wide rows shares most, and
// software GL runs eight at once: these are a group.
const int kWalkStrips = 4, kWalkRows = 16, kTilesInGroup = 8;
const int kWalksAcross = kStrips / kWalkStrips, kWalks = kWalksAcross * (kTileSize / kWalkRows);
const int kGroup = kTilesInGroup * kWalks;
// Tiles dry by single strips.
const int kDryWalks = kStrips * (kTileSize / kWalkRows), kTilesInDryGroup = kGroup / kDryWalks;
