// What the kernels share that work by lists of tiles: those for software GL, which is slow where nobody has anything to do. A GPU is not, but waits long
// between a kernel and the next: glass/film_tile.comp is for it.
#include "glass/film_buffers.glsl"

// Groups in rows, as GL promises no more than 65535 along an axis.
const uint kGroupsInRow = 32768u;
uint groupInRows() { return gl_WorkGroupID.y * kGroupsInRow + gl_WorkGroupID.x; }

// How many tiles a step looks at, and the command for as many groups as they need.
struct AwakeTiles { uint groups_x, groups_y, groups_z, number; };

// Invocations in a group that walk over tiles: software GL runs eight at once.
const int kGroup = 8;
const int kTilesInGroup = kGroup;              // the flow's each over a whole one, which shares most,
const int kTilesInDryGroup = kGroup / kStrips; // drying ones each up a column of strips

// Where in the film's buffer the strip of a texel lies.
int stripAt(int x, int y) { return y * tilesAcross() * kStrips + x / kStripSize; }
