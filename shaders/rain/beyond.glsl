// What both stages of the rain beyond share. VOLUMES: how many a tile of this draw knows.
#include "shared/rain_beyond.glsl"
layout(std140, binding = 0) uniform BeyondBlock { RainBeyond beyond; };
// -1: all layers at once, to the scene's depth, which is read. Else the one layer that is drawn, tested as a whole against the depth buffer.
layout(location = 0) uniform int only_layer;
