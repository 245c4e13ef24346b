// What is the same for all draws of a view. Positions are relative to the eye, axes are the world's (z up). See FrameBlock in render/frame_block.h.
const int kMaxLamps = 64;
layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_rel;
  mat4 shadow_from_rel;
  vec4 sh[9];          // irradiance / pi of the surroundings by normal
  vec4 to_sun;         // w: 1 where there is a shadow map
  vec4 sun;            // rgb irradiance
  vec4 haze;           // rgb of the air far off, w extinction in the open, 1/m
  vec4 air;            // x wetness, y reflections' last mip, z brightness of the environment cube, w glow of emissive 1
  vec4 eye;            // xyz of the eye in the world modulo 1024 m, for patterns
  vec4 plane;          // the wet ground's plane: n . p = w
  vec4 screen;         // xy 1 / size in pixels, z 1 where there is a mirror picture, w extinction where no snow falls, 1/m
  mat4 car_from_rel;   // of the car that shades the ground below it
  vec4 car;            // xy half length and width of its footprint, z middle of it along the car, w how high it is, 0: there is none
  vec4 lamp_place[kMaxLamps];      // xyz, w 1 / range^2
  vec4 lamp_aim[kMaxLamps];        // xyz where to, w cos of the outer cone
  vec4 lamp_intensity[kMaxLamps];  // rgb, w 1 / (cos inner - cos outer), < 0: a dipped headlight
} frame;

// sRGB to linear without a power (fitted polynomial, error below 0.002).
vec3 linearFromSrgb(vec3 c) { return c * (c * (c * 0.305306 + 0.682171) + 0.012523); }

// Irradiance / pi for a normal: spherical harmonics to order 2 (Ramamoorthi & Hanrahan 2001), constants folded into the coefficients.
vec3 skyLight(vec3 n) {
  vec3 e = frame.sh[0].rgb + frame.sh[1].rgb * n.y + frame.sh[2].rgb * n.z + frame.sh[3].rgb * n.x + frame.sh[4].rgb * (n.x * n.y) +
           frame.sh[5].rgb * (n.y * n.z) + frame.sh[6].rgb * (3.0 * n.z * n.z - 1.0) + frame.sh[7].rgb * (n.x * n.z) +
           frame.sh[8].rgb * (n.x * n.x - n.y * n.y);
  return max(e, vec3(0.0));
}
