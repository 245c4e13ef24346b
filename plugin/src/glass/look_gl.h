// What a driver sees of a pane: the world refracted by its film, blurred by unresolved droplets, and each
// drop traced as the lens it is.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "shared/glass_crater.glsl"
#include "shared/glass_types.glsl"

struct GladGLContext;

namespace rg::glass {

// Whose picture it is. Matrices are named destinationFromSource; world coordinates may be large, so they stay
// double up to here.
struct LookView {
  glm::dmat4 eyeFromWorld{1.0};
  glm::dmat4 clipFromEye{1.0};
  glm::ivec4 viewport_px{0};  // x, y, width, height in the target
  bool clip_zero_to_one = false;
  bool reversed_depth = false;
};

// Where it is drawn. `color_texture` is what the framebuffer's colour 0 shows, or 0: then the picture is
// fetched from the framebuffer.
struct LookTarget {
  uint32_t framebuffer = 0;
  uint32_t color_texture = 0;
  int32_t width_px = 0;
  int32_t height_px = 0;
  bool srgb = false;           // what is in the target is encoded in sRGB; else linear radiance
  float exposure = 1.0f;       // what radiance was multiplied with before it was written
  uint32_t depth_texture = 0;  // what the framebuffer tests depth against, or 0; then things close behind the
                               // glass (a wiper's arm) are not told from those far away
};

// A lamp that shines from a point, brightest within a cone of cos_inner about its direction and dark beyond
// cos_outer; cos_outer -1: to all sides alike.
struct LookLamp {
  glm::dvec3 position_m{0.0};  // world
  glm::vec3 direction{0.0f};
  glm::vec3 intensity{0.0f};  // radiant, in the host's unit times m^2
  float cos_inner = -1.0f;
  float cos_outer = -1.0f;
};

// Light that water and glass show besides the visible picture. Radiance in the host's unit.
struct LookLight {
  uint32_t environment_cube =
      0;  // linear radiance with mips, world axes (+Z face up), or 0; used where no capture was made
  glm::vec3 sky_radiance{0.0f};
  glm::vec3 ground_radiance{0.0f};
  float cabin_share = 1.0f;  // how much of the environment's light comes from the side of the glass the cabin
                             // is on: 1 = no cabin there
  std::vector<LookLamp> lamps;  // that the environment does not show; the kMostLookLamps brightest count
};

// A blade that pushes a ridge of water over the pane, vehicle frame.
struct LookBlade {
  glm::vec3 middle_m{0.0f};
  glm::vec3 along{0.0f};  // unit, from the blade's first piece to its last
  glm::vec3 ahead{0.0f};  // unit, across it, where the ridge is
  float blade_m = 0.0f;
  int32_t first_piece = 0;  // of `ridge_buffer`, of shared::kBladeSegments
};

// What a pane's fogged inside covers of it.
struct LookFog {
  std::vector<float> covered;  // 0 .. 1 by cell, rows of `cells` over the grid; empty: it is clear
  glm::ivec2 cells{0};
};

// A pane as it is to be seen. GL names are borrowed for the call.
struct LookPane {
  glm::dmat4 worldFromVehicle{1.0};
  // Mesh: floats {x, y, z, nx, ny, nz, u, v} in the vehicle's frame, normals outward (the wet side), uv those
  // of `film`.
  uint32_t vertex_buffer = 0;
  uint32_t index_buffer = 0;  // uint32_t triangles
  int32_t index_count = 0;
  // Of a mesh cut into pieces, see mesh_cut.h: uint32_t: the first index of each, and their number;
  // `index_count` counts those of the tiles. 0: not cut, and all is drawn as if film and beads lay
  // everywhere.
  uint32_t piece_buffer = 0;
  int32_t piece_index_count = 0;  // of all pieces
  glm::vec4 sill{0.0f};           // n, d: the mesh is seen where n . p + d >= 0; 0: all of it is
  glm::vec3 centre_m{0.0f};  // of the pane's bounding sphere, vehicle frame: panes are drawn from far to near
  float radius_m = 0.0f;
  // The grid's maps, all of `film_size`: uv 0..1 spans the grid.
  glm::ivec2 film_size{0};
  float texel_m = 3e-3f;  // a cell in grid metres: uv = position_m / (texel_m * film_size)
  uint32_t position =
      0;  // RGBA32F: the middle of each texel in the vehicle's frame, m; carried on past the pane's edge
  uint32_t metric =
      0;  // RGBA32F: metres of glass for one texel along u, along v, cosine between both, area in m^2
  uint32_t frame = 0;  // RGBA16F array of 2 layers: unit tangents along u and along v in the vehicle's frame,
                       // likewise carried on
  uint32_t film = 0;   // R32I volume in each texel in units of film_unit_m3, < 0 off the pane; 0: no film
  float film_unit_m3 = shared::kPicolitre_m3;
  // R32UI beads of each texel, packed as in shared/glass_beads.glsl, of the film's unit; 0: none
  uint32_t beads = 0;
  float bead_contact_rad = 0.44f;
  std::vector<LookBlade> blades;  // at most shared::kMaxGlassWipers
  uint32_t ridge_buffer = 0;      // int32_t volume of each piece, in units of film_unit_m3
  float ridge_contact_rad = 0.7f;
  LookFog fog;
  float mirror =
      0.0f;  // of a mirror, whose dry picture the target shows: share of the light that it reflects
  // Drops: shared::GlassDropRecord in an SSBO. A record of seed 0 has a perfectly round outline (placed
  // drops), others their own.
  uint32_t drop_buffer = 0;
  int32_t drop_count = 0;
  // Craters in the film: shared::CraterRecord in an SSBO, of the same time.
  uint32_t crater_buffer = 0;
  int32_t crater_count = 0;
  float drop_age_s = 0.0f;  // the picture's time minus the records': drops are drawn moved on by so much
};

// As it is now; where it is and which time it is seen at are left to the caller, as are blades and fog.
struct PaneDrawn;
LookPane lookPaneOf(const PaneDrawn& drawn);

struct LookSettings {
  int internal_reflections = 6;  // of a ray in a drop, 0 .. 6
  int capture_size_px = 256;     // of one face of the captured cube
  float brightness = 1.0f;       // of what is seen through water
  float blur = 1.0f;             // of what is seen through unresolved droplets
  float pupil_m = 0.0f;          // how wide the pupil is that looks at what is far: water that an eye within
                                 // sees is blurred by as much, where the target's depth is given
  bool dry_reflection = true;    // dry glass reflects its surroundings when looked at from outside
};

// What a host's depth means: GL's -1 .. 1 or 0 .. 1, and whether it falls with distance.
struct DepthUse {
  bool zero_to_one = false;
  bool reversed = false;
};

// Draws scene and sky (no rain, panes, cabin) into `framebuffer`, whole viewport `size_px`, with these
// matrices.
using DrawScene = std::function<void(uint32_t framebuffer, int size_px, const glm::dmat4& eyeFromWorld,
                                     const glm::dmat4& clipFromEye)>;

class GlassLook {
 public:
  explicit GlassLook(const GladGLContext& gl);
  ~GlassLook();
  GlassLook(const GlassLook&) = delete;
  GlassLook& operator=(const GlassLook&) = delete;

  LookSettings settings;

  // Draws panes with their water over the target's picture, far ones first. Needs the world behind them drawn
  // and changes only colour: depth is tested, not written. Clean glass looked at from inside leaves the
  // picture as it was, to the bit. GL state is not restored here (the caller's guard does): touches program,
  // vertex array, textures 0..7, buffer binding points, framebuffer, viewport, blend, depth, raster.
  void drawPanes(std::span<const LookPane> panes, const LookView& view, const LookTarget& target,
                 const LookLight& light);

  // Renews the captured surroundings of the eye: at most `max_faces` pictures in this call, the forward one
  // most often. `depth`: what the pictures' matrices make of distance; as the host's own views do.
  void capture(const glm::dmat4& eyeFromWorld, int max_faces, const DrawScene& draw, DepthUse depth = {});
  // What was captured: a cube of linear radiance with mips, world axes (+Z face up); 0 while there is none.
  uint32_t captured() const;
  // Captured pictures are no longer used (the host stopped giving them, or the eye was put elsewhere).
  void dropCapture();

  // The context is gone: forget names instead of deleting them.
  void abandon();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rg::glass
