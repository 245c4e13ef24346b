// What the look's shaders know of view, target, light and the pane being drawn. Filled by plugin/src/glass/look_gl.cpp (struct FrameBlock).
#ifndef RG_OPTICS_LOOK_FRAME_GLSL
#define RG_OPTICS_LOOK_FRAME_GLSL

struct LookBlade {
  vec4 middle_length;  // xyz: vehicle frame; w: of the blade, m
  vec4 along_first;    // xyz: unit, from the first piece to the last; w: number of the first
  vec4 ahead;          // xyz: unit, across it, where its ridge is
};

layout(std140, binding = 0) uniform Frame {
  mat4 clip_from_eye;
  mat4 eye_from_vehicle;    // of the pane being drawn
  mat4 eye_from_world;      // rotation alone
  mat4 world_from_vehicle;  // rotation alone
  vec4 eye_in_vehicle;      // xyz, m
  vec4 sky_radiance;
  vec4 ground_radiance;
  vec4 viewport;            // px: x, y, width, height
  vec4 depth_rows;          // what makes depth of view: projection [2][2], [3][2], [2][3], [3][3]
  vec2 uv_per_m;            // pane's uv for a grid metre
  float drop_age_s;
  int drop_count;
  float exposure;
  float pixels_per_rad;     // at the picture's middle
  float environment_texels_per_rad;
  float cabin_share;
  float brightness;
  float blur;
  float fine_radius_px;     // drops smaller than this are sampled four times a pixel
  uint depth_seen;          // 0: the target's depth is not given; 1: it is -1 .. 1; 2: 0 .. 1
  uint internal_reflections;
  uint dry_reflection;
  float mirror;             // share of the light that the glass's silvered inner side reflects; 0: it is looked through
  float film_unit_m3;
  int blade_count;          // that push a ridge
  float ridge_tan_contact;  // tangent of the angle in which its foot meets the glass
  float bead_mm3_per_unit;  // the cube of a bead's base radius, for a unit of the film's volume
  float bead_sine;          // of the angle in which its cap meets the glass
  float pupil_m;            // how wide the circle is on the glass that a sharp point far away is seen through
  vec4 sill;                // n, d: the pane is seen where n . p + d >= 0, vehicle frame
  LookBlade blades[8];      // kMaxGlassWipers
} frame;
#endif
