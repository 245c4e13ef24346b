// The GPU's half of a pane: its film as whole picolitres in each texel of a grid, stepped at 60 Hz by compute
// shaders, and what the look needs to draw it. Law and kernels: shaders/shared/glass_film.glsl,
// shaders/glass/.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "glass/pane.h"

struct GladGLContext;

namespace rg::glass {

struct FilmState;

// GL programs that all panes of a context share. A leaky kernel loses 1 % of what passes through it: the
// ledger's tests must see that.
enum class FilmKernel { none, take, add, ridge, sweep, leave, step, bead_add, bead };
class FilmPrograms;
std::shared_ptr<FilmPrograms> makeFilmPrograms(const GladGLContext& gl, FilmKernel leaky = FilmKernel::none);
// The context is gone: forget names instead of deleting them.
void abandonFilmPrograms(FilmPrograms& programs);

// What is drawn of a pane; GL names stay the PaneGl's. Fields as in look_gl.h's LookPane.
struct PaneDrawn {
  uint32_t vertex_buffer =
      0;  // floats {x, y, z, nx, ny, nz, u, v}: uv in [0, 1] over the grid (its whole texture)
  uint32_t index_buffer = 0;  // uint32_t triangles
  int32_t index_count = 0;    // 0: all of it is behind its sill
  glm::vec4 sill{0.0f};  // n, d: glass is seen where n . p + d >= 0, p as the mesh has it; 0: all of it is
  uint32_t piece_buffer = 0;      // uint32_t: first index of each piece, see mesh_cut.h
  int32_t piece_index_count = 0;  // of all pieces, of which the first make up the mesh
  glm::dvec3 slid_m{0.0};         // how far from where the mesh and the maps have it, vehicle frame
  glm::vec3 centre_m{0.0f};
  float radius_m = 0.0f;
  uint32_t position =
      0;  // RGBA32F: middle of each texel, vehicle frame; carried on past the pane's edge, as `frame`
  bool right_handed = true;  // along u cross along v points out of the glass
  uint32_t film = 0;         // GL_TEXTURE_2D R32I, picolitres in each texel; -1 off the pane
  glm::ivec2 film_size{0};
  float film_unit_m3 = shared::kPicolitre_m3;
  uint32_t beads = 0;  // GL_TEXTURE_2D R32UI, each texel's beads as in shared/glass_beads.glsl
  double bead_contact_rad = 0.0;
  uint32_t metric = 0;       // RGBA32F: metres for a texel along u, along v, cosine between both, area in m^2
  uint32_t frame = 0;        // RGBA16F array of 2 layers: unit tangents along u and v, vehicle frame
  float texel_m = 0.0f;      // grid metres: uv = position_m / (texel_m * film_size)
  uint32_t drop_buffer = 0;  // shared::GlassDropRecord
  int32_t drop_count = 0;
  uint32_t crater_buffer = 0;  // shared::CraterRecord
  int32_t crater_count = 0;
  int64_t drop_tick = 0;                     // the tick both kinds of records are of
  uint32_t ridge_buffer = 0;                 // int picolitres of each piece of the blades' ridges
  std::span<const MovingBlade> blades = {};  // as at that tick, until the next step
  double advancing_rad = 0.0;
};

// [thread: GL, context current] GL state is not restored here (the caller's guard does): touches program,
// buffer bindings (SSBO 0..7, UBO 0, pixel unpack), image units 0..4, pixel store, textures none.
class PaneGl {
 public:
  PaneGl(const GladGLContext& gl, std::shared_ptr<FilmPrograms> programs, std::shared_ptr<PaneSim> sim);
  ~PaneGl();  // the film's water is booked as drained
  PaneGl(const PaneGl&) = delete;
  PaneGl& operator=(const PaneGl&) = delete;

  // Runs the film's steps that were ordered, of all these panes side by side, hands back reports that are
  // ready and waits for those a queued tick wants. Uploads drops. The panes share programs and context.
  static void step(std::span<PaneGl* const> panes);
  void step();  // of this one
  // As that, and waits for all: afterwards PaneSim::stats is exact.
  static void finish(std::span<PaneGl* const> panes);
  void finish();

  // The glass slid so far, and no more of it than is before the sill.
  PaneDrawn drawn(double opening_m = 0.0) const;
  // Film as it is after finish(), row by row, -1 off the pane.
  std::vector<int32_t> readFilm();
  // Beads likewise, packed as in shared/glass_beads.glsl.
  std::vector<uint32_t> readBeads();
  // All of what the film is; finishes. And its film made another one, what is under way having been finished.
  FilmState filmState();
  void setFilm(const FilmState& state);
  // Of film, beads and ridges, for the state's hash; finishes.
  uint64_t hash();

  // The context is gone: forget names instead of deleting them.
  void abandon();

 private:
  static void run(std::span<PaneGl* const> panes, bool wait_for_all);
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace rg::glass
