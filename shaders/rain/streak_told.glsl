// What a fragment is told of its streak. Defines FROM: whether they go in or out.
layout(location = 0) flat FROM vec4 streak_line;  // px (x, y) on the target lies x * streak_line.x + y * streak_line.y + streak_line.z along the streak,
                                                  // 0 .. 1; and, with its direction for the first two, y * .x - x * .y + streak_line.w px beside it
// Packed: x the light as the target holds it. The rest as pairs of halves: y and z: along it, the drop passes at the time
// (y.x + y.y * along) / (1 + z.x * along), -1 .. 1 over the whole exposure, and z.y is the root of the cover where it is densest; w: 1 / softened
// radius at its ends, 1/px.
layout(location = 1) flat FROM uvec4 streak_look;
#ifdef SOFT_DEPTH
layout(location = 2) flat FROM float streak_per_depth;  // 1 / depth along the view where it begins, 1/m
#endif
#ifdef SOLIDS
layout(location = 3) flat FROM float streak_solid;  // rainSolidCode
#endif
