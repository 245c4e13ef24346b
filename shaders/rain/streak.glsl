// What both stages of a streak share.
#include "shared/rain_look.glsl"
layout(std140, binding = 2) uniform LookBlock { RainLook look; };
