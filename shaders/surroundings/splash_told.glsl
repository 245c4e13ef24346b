// What a fragment is told of its splash: SplashPoint's a, b and c. Defines FROM: whether they go in or out.
layout(location = 0) flat FROM vec4 splash_foot;
layout(location = 1) flat FROM vec4 splash_size;
layout(location = 2) flat FROM uvec4 splash_look;
